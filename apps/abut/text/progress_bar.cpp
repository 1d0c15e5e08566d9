#include "text/progress_bar.h"

#include "arguments/interrupt.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace abut::command {

namespace {

constexpr std::size_t kBarWidth = 40;
constexpr std::chrono::milliseconds kRedraw{50};

} // namespace

Progress ProgressBar::progress() {
    Progress result;
    result.stop = &interrupt_flag();
    if (style_ != Style::none)
        result.report = [this](std::string_view stage, double fraction) { show(stage, fraction); };
    return result;
}

void ProgressBar::show(std::string_view stage, double fraction) {
    if (style_ == Style::none)
        return;
    const Clock::time_point now = Clock::now();
    if (stage != stage_) {
        end_stage();
        stage_ = stage;
        stage_start_ = now;
        last_shown_ = {};
        if (style_ == Style::lines) {
            fmt::print(stderr, "{:<12}", stage_); // end_stage() ends the line
            std::fflush(stderr);
        }
    }
    if (style_ != Style::bar || (fraction < 1 && now - last_shown_ < kRedraw))
        return;
    last_shown_ = now;
    const double share = std::clamp(fraction, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(share * kBarWidth);
    fmt::print(stderr, "\r\x1b[K{:<12} [{:#<{}}{:.<{}}] {:3.0f} %", stage_, "", filled, "",
               kBarWidth - filled, 100 * share);
    std::fflush(stderr);
}

void ProgressBar::hide() {
    if (style_ != Style::bar || stage_.empty())
        return;
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
    last_shown_ = {};
}

void ProgressBar::finish() {
    end_stage();
    stage_.clear();
}

void ProgressBar::end_stage() {
    if (stage_.empty())
        return;
    hide();
    if (style_ == Style::lines)
        fmt::print(stderr, " {:8.2f} s\n",
                   std::chrono::duration<double>(Clock::now() - stage_start_).count());
    std::fflush(stderr);
}

} // namespace abut::command
