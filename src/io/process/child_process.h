#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// The way in which a child process ended.
enum class ChildEnd : std::uint8_t {
    exited,       ///< on its own; `status` is its exit status
    killed,       ///< by a signal; `status` is the signal's number
    time_limit,   ///< stopped by run_child after `seconds`
    memory_limit, ///< stopped by run_child for its resident memory
    stopped,      ///< stopped by run_child on the request of should_stop
};

struct ChildLimits {
    double seconds = 0;      ///< 0: no limit
    std::uint64_t bytes = 0; ///< of resident memory; 0: no limit
};

/// Memory shared with a child, which writes its result there. The destructor closes and unmaps it.
class ResultMemory {
public:
    /// Errors      Error{reader_failed} if the machine has no memory for it.
    ResultMemory();
    ~ResultMemory();
    ResultMemory(const ResultMemory&) = delete;
    ResultMemory& operator=(const ResultMemory&) = delete;

    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
    /// Returns the bytes written, after the child has ended. They are first sealed, so that no
    /// process can change or shrink them.
    ///
    /// Errors      Error{reader_failed} if a process still has a writable mapping of them.
    std::span<const std::byte> bytes();

private:
    int descriptor_ = -1;
    void* mapped_ = nullptr;
    std::size_t size_ = 0;
};

struct ChildReport {
    ChildEnd end = ChildEnd::exited;
    int status = 0;
};

/// Runs a program and waits for it. The child finds its result file, descriptor `result` of this
/// process, at descriptor scene_stream::kResultFile.
///
/// The child gets its own process group, and /dev/null for its standard streams. On return it and
/// all its descendants are dead and reaped. The function never forks without exec, because the
/// caller may have threads.
///
/// In/out      arguments: the program's path and its arguments. should_stop: polled about 50 times
///             a second.
/// Errors      Error{unsupported} if the program cannot be started.
ChildReport run_child(const std::vector<std::string>& arguments, const ChildLimits& limits,
                      const std::function<bool()>& should_stop, int result);

} // namespace abut
