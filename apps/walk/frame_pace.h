#pragma once

#include <algorithm>
#include <cstdint>

namespace abut::viewer {

/// The triangles of a frame while the eye moves: as many as this machine draws at 15 frames a second.
class FramePace {
public:
    static constexpr double kMost = 500'000, kLeast = 100'000;
    static constexpr double kSeconds = 1.0 / 15; ///< of a frame

    /// In          seconds: that the last frame took, all in all.
    void add_frame(double seconds) {
        if (!(seconds > 0))
            return;
        // A frame much slower than the others (something else was busy) counts little.
        const double by = std::clamp(kSeconds / seconds, 0.9, 1.05);
        triangles_ = std::clamp(by * triangles_, kLeast, kMost);
    }
    [[nodiscard]] std::uint64_t triangles() const { return static_cast<std::uint64_t>(triangles_); }

private:
    double triangles_ = kMost;
};

} // namespace abut::viewer
