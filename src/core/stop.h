#pragma once

#include <abut/progress.h>

#include <atomic>
#include <cstdint>
#include <limits>

namespace abut {

/// The stop flag that this thread polls; null if there is none. `parallel_for` passes it on to the
/// threads that help.
extern constinit thread_local const std::atomic<bool>* t_stop_flag;

/// Errors      Error{interrupted} if the flag that this thread polls is set.
void poll_stop();

/// Makes this thread poll a flag until the end of the scope.
class StopScope {
public:
    /// For a query. If its progress has no flag, the thread goes on to poll the flag of the work that
    /// asked the query.
    ///
    /// Errors      Error{interrupted} if the flag is set already.
    explicit StopScope(const Progress& progress) : before_(t_stop_flag) {
        if (progress.stop != nullptr)
            begin(progress.stop);
    }
    /// For a thread that helps with parallel work. The flag may be null: then none is polled.
    explicit StopScope(const std::atomic<bool>* flag) : before_(t_stop_flag) { t_stop_flag = flag; }
    ~StopScope() { t_stop_flag = before_; }
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

private:
    static void begin(const std::atomic<bool>* flag);

    const std::atomic<bool>* before_;
};

/// A visitor returns this in place of a bound, which is never negative, to stop its traversal.
inline constexpr double kStopTraversal = -1;

/// Counts the steps of a search, up to a limit. Polls the stop flag at the first step and then every
/// 256 steps.
class SearchSteps {
public:
    explicit SearchSteps(std::uint64_t most = std::numeric_limits<std::uint64_t>::max())
        : most_(most) {}

    /// Call it before each step. Returns false, and counts nothing, if the limit is reached.
    ///
    /// Errors      Error{interrupted}.
    bool take() { return --left_ != 0 || look(); }
    [[nodiscard]] std::uint64_t count() const { return granted_ + 1 - left_; }
    /// Whether a step was refused.
    [[nodiscard]] bool ran_out() const { return ran_out_; }

private:
    bool look();

    std::uint64_t most_, granted_ = 0;
    std::uint32_t left_ = 1; ///< steps left of those granted, plus one
    bool ran_out_ = false;
};

} // namespace abut
