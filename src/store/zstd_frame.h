#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Bytes as one zstd frame that says how long they are.
namespace abut {

/// Errors      Fault cannot_write, for lack of memory.
std::vector<std::byte> compress(std::span<const std::byte> raw);

/// What a frame says of the length of its content; a number beyond all lengths if it is no frame.
std::uint64_t content_bytes(std::span<const std::byte> frame);

/// In          raw_bytes: of the content, at most.
/// Returns     the content; nothing if the frame is damaged or its content is longer.
std::vector<std::byte> decompress(std::span<const std::byte> frame, std::uint64_t raw_bytes);

} // namespace abut
