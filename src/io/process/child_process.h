#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// How a child process ended.
enum class ChildEnd : std::uint8_t {
    exited,       ///< by itself; `status` is its exit status
    killed,       ///< by a signal; `status` is its number
    time_limit,   ///< stopped here after `seconds`
    memory_limit, ///< stopped here for its resident memory
    stopped,      ///< stopped here because should_stop said so
};

struct ChildLimits {
    double seconds = 0;      ///< 0: none
    std::uint64_t bytes = 0; ///< of resident memory; 0: none
};

/// Memory shared with a child, which writes its result to it. Closed and unmapped by the
/// destructor.
class ResultMemory {
public:
    /// Errors      Error{reader_failed} if the machine has no memory for it.
    ResultMemory();
    ~ResultMemory();
    ResultMemory(const ResultMemory&) = delete;
    ResultMemory& operator=(const ResultMemory&) = delete;

    [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
    /// The bytes written, once the child is gone. They are sealed first: nobody can change or
    /// shrink them any more.
    ///
    /// Errors      Error{reader_failed} if a process still has them open for writing through a
    ///             mapping.
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

/// Runs a program and waits for it. It finds the file for its result, descriptor `result` here, on
/// descriptor scene_stream::kResultFile.
///
/// The child gets a process group of its own, /dev/null for its standard streams, and is dead and
/// reaped, with all that it started, on return. Never forks without exec: the caller may have
/// threads.
///
/// In/out      arguments: the program's path and its arguments; should_stop: polled some 50 times a
///             second.
/// Errors      Error{unsupported} if the program cannot be started.
ChildReport run_child(const std::vector<std::string>& arguments, const ChildLimits& limits,
                      const std::function<bool()>& should_stop, int result);

} // namespace abut
