#pragma once

#include <abut/progress.h>

#include <atomic>
#include <cstdint>
#include <limits>

namespace abut {

/// The stop flag that the work of this thread is for; null: none. `parallel_for` hands it on to the
/// threads that help.
extern constinit thread_local const std::atomic<bool>* t_stop_flag;

/// Errors      Error{interrupted} if the flag of this thread's work is set.
void poll_stop();

/// Until the end of the scope, work of this thread polls a flag.
class StopScope {
public:
    /// Of a query: without a flag, that of the work around it stays.
    ///
    /// Errors      Error{interrupted} if the flag is set already.
    explicit StopScope(const Progress& progress) : before_(t_stop_flag) {
        if (progress.stop != nullptr)
            begin(progress.stop);
    }
    /// Of a thread that helps, whose flag is given; null: none.
    explicit StopScope(const std::atomic<bool>* flag) : before_(t_stop_flag) { t_stop_flag = flag; }
    ~StopScope() { t_stop_flag = before_; }
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

private:
    static void begin(const std::atomic<bool>* flag);

    const std::atomic<bool>* before_;
};

/// Counts the steps of a search, up to a limit. Polls the stop flag at the first step and then every
/// 256 steps.
class SearchSteps {
public:
    explicit SearchSteps(std::uint64_t most = std::numeric_limits<std::uint64_t>::max())
        : most_(most) {}

    /// Before each step. Returns false, and counts nothing, if the limit is reached.
    ///
    /// Errors      Error{interrupted}.
    bool take() { return --left_ != 0 || look(); }
    [[nodiscard]] std::uint64_t count() const { return granted_ + 1 - left_; }
    /// Whether a step was refused.
    [[nodiscard]] bool ran_out() const { return ran_out_; }

private:
    bool look();

    std::uint64_t most_, granted_ = 0;
    std::uint32_t left_ = 1; ///< of those granted, and one more
    bool ran_out_ = false;
};

} // namespace abut
