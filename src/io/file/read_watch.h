#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace abut {

struct ReadOptions;

/// Ends a read in the caller's process: on request, at its time limit, beyond its memory limit.
class ReadWatch {
public:
    /// In          file: for messages; should_stop: may be called from any thread, must not be
    ///             empty.
    ReadWatch(std::string file, const ReadOptions& options, std::function<bool()> should_stop);

    /// To be called every few hundred kilobytes, from any thread.
    ///
    /// Errors      Error{interrupted} on request, Error{reader_failed} at the time limit.
    void check() const;
    [[nodiscard]] bool should_stop() const { return should_stop_(); }

    /// To be called before memory is taken.
    ///
    /// In          bytes: of memory that the read holds at once.
    /// Errors      Error{reader_failed} beyond the memory limit, or the machine's memory if there
    ///             is no limit: a small file may ask for more than there is.
    void require_memory(std::uint64_t bytes) const;

private:
    std::string file_;
    double seconds_;
    std::uint64_t bytes_;
    std::function<bool()> should_stop_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The errors of a reader that has reached a limit, in whatever process it runs.
[[noreturn]] void throw_time_limit(const std::string& file, double seconds);
/// In          limit: 0 for none.
[[noreturn]] void throw_memory_limit(const std::string& file, std::uint64_t limit);

} // namespace abut
