#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace abut {

struct ReadOptions;

/// Ends a read in the caller's process on request, at its time limit, or beyond its memory limit.
class ReadWatch {
public:
    /// In          file: for messages. should_stop: may be called from any thread; must not be
    ///             empty.
    ReadWatch(std::string file, const ReadOptions& options, std::function<bool()> should_stop);

    /// Call it every few hundred kilobytes, from any thread.
    ///
    /// Errors      Error{interrupted} on request, Error{reader_failed} at the time limit.
    void check() const;
    [[nodiscard]] bool should_stop() const { return should_stop_(); }

    /// Call it before memory is allocated.
    ///
    /// In          bytes: memory that the read holds at once.
    /// Errors      Error{reader_failed} beyond the memory limit, or without a limit beyond the
    ///             machine's memory: even a small file may ask for more than that.
    void require_memory(std::uint64_t bytes) const;

private:
    std::string file_;
    double seconds_;
    std::uint64_t bytes_;
    std::function<bool()> should_stop_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Throws the error of a reader, in any process, that has reached its time limit.
[[noreturn]] void throw_time_limit(const std::string& file, double seconds);
/// Throws the error of a reader that has reached its memory limit. In: limit, 0 for none.
[[noreturn]] void throw_memory_limit(const std::string& file, std::uint64_t limit);

} // namespace abut
