#include "io/process/decode_geometry.h"

#include <abut/error.h>

#include "io/file/fault.h"
#include "io/file/read_watch.h"
#include "io/process/child_process.h"
#include "io/process/reader_end.h"
#include "io/process/reader_program.h"

#include <algorithm>
#include <cstring>

namespace abut {

namespace {

/// Rounds up, because decoders and filters work on whole words.
constexpr std::uint64_t aligned(std::uint64_t bytes) {
    return (bytes + 15) / 16 * 16;
}

template <typename Value>
std::span<const std::byte> bytes_of(const Value& value) {
    return std::as_bytes(std::span(&value, 1));
}

void copy_input(const DecodeJobs::Input& input, const decode_request::Job& job,
                TemporaryFile& file) {
    constexpr std::uint64_t kPiece = std::uint64_t{1} << 18;
    std::vector<std::byte> piece;
    for (std::uint64_t i = 0; i < job.input_bytes; i += kPiece) {
        piece.resize(std::min(kPiece, job.input_bytes - i));
        input(i, piece);
        file.write(job.input + i, piece);
    }
}

} // namespace

std::size_t DecodeJobs::add(const decode_request::Job& job, std::uint64_t input_bytes,
                            Input input) {
    jobs_.push_back(job);
    jobs_.back().input_bytes = input_bytes;
    inputs_.push_back(std::move(input));
    return jobs_.size() - 1;
}

std::unique_ptr<TemporaryFile> DecodeJobs::run(const std::string& model,
                                               const SourceOptions& options) {
    decode_request::RequestHeader header{};
    std::memcpy(header.magic, decode_request::kMagic, sizeof header.magic);
    header.jobs = jobs_.size();
    std::uint64_t end = aligned(sizeof header + jobs_.size() * sizeof(decode_request::Job));
    for (decode_request::Job& job : jobs_) {
        job.input = end;
        end += aligned(job.input_bytes);
    }
    for (decode_request::Job& job : jobs_) {
        job.output = end;
        end += aligned(job.count * job.stride);
        job.corners_output = end;
        end += aligned(job.corners * sizeof(std::uint32_t));
    }
    auto file = std::make_unique<TemporaryFile>(options.folder);
    file->write(0, bytes_of(header));
    file->write(sizeof header, std::as_bytes(std::span(jobs_)));
    for (std::size_t i = 0; i < jobs_.size(); ++i)
        copy_input(inputs_[i], jobs_[i], *file);

    const ChildLimits limits{options.read.time_limit, options.read.memory_limit};
    ChildReport report;
    try {
        report = run_child(
            decoder_command(model, options.read.memory_limit), limits,
            [&] { return options.watch != nullptr && options.watch->should_stop(); },
            file->descriptor());
    } catch (const Error& error) {
        if (!error.file().empty())
            throw;
        throw Error(error.code(), model, error.what());
    }
    check_end(report, model, limits);
    if (file->read_some(0, std::as_writable_bytes(std::span(&header, 1))) != sizeof header)
        throw Error(ErrorCode::reader_failed, model, "its reader returned a damaged result");
    if (header.done != jobs_.size())
        malformed("its compressed geometry is damaged" +
                  (header.done < jobs_.size()
                       ? " (" +
                             std::string(jobs_[header.done].kind == decode_request::Kind::draco
                                             ? "Draco"
                                             : "meshoptimizer") +
                             ", item " + std::to_string(header.done + 1) + " of " +
                             std::to_string(jobs_.size()) + ")"
                       : ""));
    return file;
}

} // namespace abut
