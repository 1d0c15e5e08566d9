#include "io/file/read_watch.h"

#include <abut/error.h>
#include <abut/scene.h>

#include <unistd.h>
#include <utility>

namespace abut {

ReadWatch::ReadWatch(std::string file, const ReadOptions& options,
                     std::function<bool()> should_stop)
    : file_(std::move(file)), seconds_(options.time_limit), bytes_(options.memory_limit),
      should_stop_(std::move(should_stop)) {}

void ReadWatch::check() const {
    if (should_stop_())
        throw Error(ErrorCode::interrupted, "interrupted");
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    if (seconds_ > 0 && spent.count() > seconds_)
        throw_time_limit(file_, seconds_);
}

void ReadWatch::require_memory(std::uint64_t bytes) const {
    if (bytes_ > 0 && bytes > bytes_)
        throw_memory_limit(file_, bytes_);
    const auto machine = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    if (bytes > machine)
        throw Error(ErrorCode::reader_failed, file_,
                    "would need " + std::to_string(bytes >> 20) +
                        " MiB of memory, which this machine does not have");
}

void throw_time_limit(const std::string& file, double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    throw Error(ErrorCode::reader_failed, file, "its reader was stopped after " + text + " s");
}

void throw_memory_limit(const std::string& file, std::uint64_t limit) {
    const std::string text =
        limit > 0 ? " (limit " + std::to_string(limit >> 20) + " MiB)" : std::string();
    throw Error(ErrorCode::reader_failed, file, "its reader ran out of memory" + text);
}

} // namespace abut
