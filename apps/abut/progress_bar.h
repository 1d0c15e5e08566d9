#pragma once

#include <abut/progress.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace abut::command {

/// Shows on standard error how far long work is: a bar on a terminal, which vanishes in the end;
/// elsewhere, where it is asked for, a line a stage.
class ProgressBar {
public:
    enum class Style : std::uint8_t { none, bar, lines };

    explicit ProgressBar(Style style) : style_(style) {}
    /// Clears what is shown.
    ~ProgressBar() { finish(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// What to hand to the library: reports here, stops on interrupt. Must not outlive the bar.
    [[nodiscard]] Progress progress();

    /// Calls must not overlap, which Progress::report promises.
    void show(std::string_view stage, double fraction);
    /// Takes a bar off the terminal until show() is called: something is to be printed there.
    void hide();
    /// Ends the last stage; may be called twice.
    void finish();

private:
    using Clock = std::chrono::steady_clock;

    void end_stage();

    Style style_;
    std::string stage_;
    Clock::time_point stage_start_;
    Clock::time_point last_shown_;
};

} // namespace abut::command
