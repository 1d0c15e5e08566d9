#pragma once

#include "core/temporary_file.h"
#include "io/process/decode_request.h"
#include "io/scene/scene_source.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Compressed geometry, decoded by third-party code in a process of its own.
class DecodeJobs {
public:
    /// Reads compressed bytes from a place in the input.
    using Input = std::function<void(std::uint64_t at, std::span<std::byte> to)>;

    /// In          job: without its places. Returns its number.
    std::size_t add(const decode_request::Job& job, std::uint64_t input_bytes, Input input);

    [[nodiscard]] bool empty() const noexcept { return jobs_.empty(); }
    [[nodiscard]] const decode_request::Job& job(std::size_t number) const { return jobs_[number]; }

    /// A temporary file with the outputs at the places that the jobs name; all of their bytes
    /// exist, and none is to be trusted.
    ///
    /// Errors      Fault malformed for data that cannot be decoded. Error, naming the model:
    ///             unsupported without the program, reader_failed, interrupted; cannot_write.
    std::unique_ptr<TemporaryFile> run(const std::string& model, const SourceOptions& options);

private:
    std::vector<decode_request::Job> jobs_;
    std::vector<Input> inputs_;
};

} // namespace abut
