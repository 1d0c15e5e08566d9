#pragma once

#include <abut/progress.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace abut::viewer {

/// Long work in a thread of its own, with its progress for a panel. One piece of work at a time.
class BackgroundTask {
public:
    BackgroundTask() = default;
    /// Stops the work, and waits until it has ended.
    ~BackgroundTask();
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;

    /// Does nothing if work is still running.
    void start(std::function<void(const Progress&)> work);
    /// Asks the work to end; it ends with Error{interrupted}.
    void stop() { stop_ = true; }
    [[nodiscard]] bool is_running() const { return thread_.joinable(); }
    /// True once for each piece of work, when it has ended.
    bool has_ended();
    /// Why the last work failed; empty if it did not.
    [[nodiscard]] const std::string& error() const { return error_; }
    [[nodiscard]] bool was_interrupted() const { return was_interrupted_; }
    [[nodiscard]] std::string stage() const;
    [[nodiscard]] double fraction() const; ///< of the stage

private:
    std::thread thread_;
    std::atomic<bool> stop_ = false, is_over_ = false;
    mutable std::mutex guard_; ///< of the next two
    std::string stage_;
    double fraction_ = 0;
    std::string error_; ///< of the thread, until it is joined
    bool was_interrupted_ = false;
};

} // namespace abut::viewer
