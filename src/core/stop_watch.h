#pragma once

#include <chrono>

namespace abut {

/// Measures elapsed wall-clock time.
class StopWatch {
public:
    /// Time since construction or the last lap.
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
    }
    /// As seconds(), and starts a new lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace abut
