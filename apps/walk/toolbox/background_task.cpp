#include "toolbox/background_task.h"

#include <abut/error.h>

#include <exception>
#include <utility>

namespace abut::viewer {

BackgroundTask::~BackgroundTask() {
    stop_ = true;
    if (thread_.joinable())
        thread_.join();
}

void BackgroundTask::start(std::function<void(const Progress&)> work) {
    if (is_running())
        return;
    stop_ = is_over_ = was_interrupted_ = false;
    error_.clear();
    {
        const std::scoped_lock lock(guard_);
        stage_.clear();
        fraction_ = 0;
    }
    thread_ = std::thread([this, work = std::move(work)] {
        const auto report = [this](std::string_view stage, double fraction) {
            const std::scoped_lock lock(guard_);
            stage_ = stage;
            fraction_ = fraction;
        };
        try {
            work({report, &stop_});
        } catch (const Error& error) {
            error_ = error.what();
            was_interrupted_ = error.code() == ErrorCode::interrupted;
        } catch (const std::exception& error) {
            error_ = error.what();
        }
        is_over_ = true;
    });
}

bool BackgroundTask::has_ended() {
    if (!is_running() || !is_over_)
        return false;
    thread_.join();
    return true;
}

std::string BackgroundTask::stage() const {
    const std::scoped_lock lock(guard_);
    return stage_;
}

double BackgroundTask::fraction() const {
    const std::scoped_lock lock(guard_);
    return fraction_;
}

} // namespace abut::viewer
