#pragma once

#include <abut/helper_programs.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace abut {

/// Processes that do one job together, on one machine or on several. Rank 0 is the leader; the
/// others are helpers. Messages go between the leader and a helper. Messages between the same two
/// processes arrive in the order in which they were sent.
///
/// All members may be called from any thread. The destructor leaves the crew: it waits until the
/// processes that it exchanges messages with have left, too. A helper leaves when the leader has
/// left.
class Crew {
public:
    struct Message {
        std::size_t from = 0;
        std::vector<std::byte> bytes; ///< empty: that process has left and sends no more messages
    };

    Crew() = default;
    virtual ~Crew() = default;
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    [[nodiscard]] virtual std::size_t rank() const = 0;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Number of threads for this process, so that the processes of one machine use each of its
    /// cores once; at least 1.
    [[nodiscard]] virtual int threads() const = 0;

    /// Sends at least one byte. Does not wait.
    virtual void send(std::size_t to, std::vector<std::byte> bytes) = 0;
    /// Returns the next message, or nothing if none arrives within `patience`.
    virtual std::optional<Message> receive(std::chrono::milliseconds patience) = 0;
};

/// Returns the crew in which `mpirun` started this process, connected by MPI. Returns null, at no
/// cost, if the process was started alone.
///
/// Errors      Error{unsupported} if the process was started as one of several, but this build has
///             no MPI, or a different MPI than the one that started it.
std::unique_ptr<Crew> join_crew();

/// Returns whether this process was started as one of several and is not the first of them.
bool is_helper();

} // namespace abut
