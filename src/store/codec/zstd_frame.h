#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Bytes as one zstd frame, which records their length.
namespace abut {

/// Errors      Fault cannot_write, for lack of memory.
std::vector<std::byte> compress(std::span<const std::byte> raw);

/// The content's length as recorded in a frame; a number beyond all lengths if the bytes are no
/// frame.
std::uint64_t content_bytes(std::span<const std::byte> frame);

/// In          raw_bytes: upper bound on the content's length.
/// Returns     the content; empty if the frame is damaged or its content is longer.
std::vector<std::byte> decompress(std::span<const std::byte> frame, std::uint64_t raw_bytes);

} // namespace abut
