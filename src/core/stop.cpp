#include "core/stop.h"

#include <abut/error.h>

#include <algorithm>

namespace abut {

constinit thread_local const std::atomic<bool>* t_stop_flag = nullptr;

void poll_stop() {
    if (t_stop_flag != nullptr && t_stop_flag->load(std::memory_order_relaxed))
        throw Error(ErrorCode::interrupted, "interrupted");
}

void StopScope::begin(const std::atomic<bool>* flag) {
    if (flag->load(std::memory_order_relaxed))
        throw Error(ErrorCode::interrupted, "interrupted");
    t_stop_flag = flag;
}

bool SearchSteps::look() {
    constexpr std::uint64_t kSteps = 256;
    left_ = 1;
    poll_stop();
    const std::uint64_t more = std::min(kSteps, most_ - granted_);
    if (more == 0) {
        ran_out_ = true;
        return false;
    }
    granted_ += more;
    left_ = static_cast<std::uint32_t>(more);
    return true;
}

} // namespace abut
