#pragma once

#include <chrono>

namespace abut {

/// A clock on the wall.
class StopWatch {
public:
    /// Since it was made, or since the last lap.
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
    }
    /// The same, and a new lap begins.
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
