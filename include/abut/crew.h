#pragma once

#include <abut/helper_programs.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace abut {

/// Processes that do one job together, on one machine or on many. Rank 0 leads, the others help;
/// messages go between the leader and a helper, and those from one to another arrive in order.
///
/// All members may be called from any thread. To destroy it is to leave: it waits until the others
/// on the way of messages have left too. A helper leaves when the leader has.
class Crew {
public:
    struct Message {
        std::size_t from = 0;
        std::vector<std::byte> bytes; ///< empty: that process has left, and sends no more
    };

    Crew() = default;
    virtual ~Crew() = default;
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    [[nodiscard]] virtual std::size_t rank() const = 0;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// For this process to use, so that those of one machine use each of its cores once; at least 1.
    [[nodiscard]] virtual int threads() const = 0;

    /// Does not wait. In: bytes, at least one.
    virtual void send(std::size_t to, std::vector<std::byte> bytes) = 0;
    /// The next message; none if none comes within `patience`.
    virtual std::optional<Message> receive(std::chrono::milliseconds patience) = 0;
};

/// The crew in which `mpirun` started this process, by MPI; null if it was started alone, at no cost.
///
/// Errors      Error{unsupported} if it was started as one of several, but this build has no MPI,
///             or another one than that which started it.
std::unique_ptr<Crew> join_crew();

/// Whether this process was started as one of several, and not as the first.
bool is_helper();

} // namespace abut
