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

/// Decodes compressed geometry with third-party code in a separate process.
class DecodeJobs {
public:
    /// Reads compressed bytes at a position of the input.
    using Input = std::function<void(std::uint64_t at, std::span<std::byte> to)>;

    /// Returns the job's number. In: job, without its positions in the file.
    std::size_t add(const decode_request::Job& job, std::uint64_t input_bytes, Input input);

    [[nodiscard]] bool empty() const noexcept { return jobs_.empty(); }
    [[nodiscard]] const decode_request::Job& job(std::size_t number) const { return jobs_[number]; }

    /// Returns a temporary file with the outputs at the positions that the jobs name. All of these
    /// bytes exist, but none is trusted.
    ///
    /// Errors      Fault malformed for data that cannot be decoded. Error, naming the model:
    ///             unsupported if the program is missing, reader_failed, interrupted; cannot_write.
    std::unique_ptr<TemporaryFile> run(const std::string& model, const SourceOptions& options);

private:
    std::vector<decode_request::Job> jobs_;
    std::vector<Input> inputs_;
};

} // namespace abut
