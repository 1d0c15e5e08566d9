#pragma once

#include <abut/progress.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace abut::command {

/// Shows the progress of long work on standard error. On a terminal it is a bar, which vanishes at
/// the end. Elsewhere it is one line per stage, if the user asked for it.
class ProgressBar {
public:
    enum class Style : std::uint8_t { none, bar, lines };

    explicit ProgressBar(Style style) : style_(style) {}
    /// Clears the bar.
    ~ProgressBar() { finish(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Returns the object to pass to the library. It reports to this bar and stops on an interrupt.
    /// It must not outlive the bar.
    [[nodiscard]] Progress progress();

    /// Shows a stage and its fraction done. Calls must not overlap; Progress::report guarantees
    /// that.
    void show(std::string_view stage, double fraction);
    /// Removes the bar from the terminal until the next show(), so that other text can be printed.
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
