#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut::viewer {

/// Chooses how much of a frame is drawn while the eye moves: as many triangles as this machine draws
/// at 15 frames a second, with a twentieth of the time to spare; and lines, unless they cost too many
/// triangles.
class FramePace {
public:
    static constexpr double kMost = 500'000, kLeast = 100'000;
    static constexpr double kSeconds = 0.95 / 15; ///< of a frame
    /// Lines are left out once fewer triangles than this can be drawn in time. They come back after
    /// kFramesToLines frames in a row with kMost triangles.
    static constexpr double kFewWithLines = 250'000;
    static constexpr int kFramesToLines = 150;

    /// In          seconds: that the last frame took, all in all.
    void add_frame(double seconds) {
        if (!(seconds > 0))
            return;
        // A frame much slower than the others (something else was busy) counts little.
        const double by = std::clamp(kSeconds / seconds, 0.9, 1.05);
        triangles_ = std::clamp(by * triangles_, kLeast, kMost);
        full_frames_ = triangles_ < kMost ? 0 : full_frames_ + 1;
        if (triangles_ < kFewWithLines)
            with_lines_ = false;
        else if (full_frames_ >= kFramesToLines)
            with_lines_ = true;
    }
    [[nodiscard]] bool with_lines() const { return with_lines_; }
    /// The triangles to be drawn, at most.
    [[nodiscard]] std::uint64_t triangles() const { return static_cast<std::uint64_t>(triangles_); }

    /// In          triangles: of the last picture, left out by the renderer because others hide them.
    void add_hidden(std::uint64_t triangles) {
        hidden_.at(next_) = triangles;
        next_ = (next_ + 1) % hidden_.size();
    }
    /// After a jump of the eye nothing is known about what is hidden.
    void forget_hidden() { hidden_.fill(0); }
    /// The triangles that a frame may choose. They are more than triangles(), as the renderer leaves
    /// some out: three quarters of what it left out in each of the last pictures, less an eighth of
    /// triangles(), so that what hides others may go away slowly.
    [[nodiscard]] std::uint64_t chosen() const {
        const std::uint64_t least = *std::min_element(hidden_.begin(), hidden_.end());
        const std::uint64_t spare = least / 4 * 3, margin = triangles() / 8;
        return triangles() + (spare > margin ? std::min(spare - margin, triangles()) : 0);
    }

private:
    double triangles_ = kMost;
    bool with_lines_ = true;
    int full_frames_ = 0;                   ///< in a row, with kMost triangles
    std::array<std::uint64_t, 8> hidden_{}; ///< of the last pictures
    std::size_t next_ = 0;                  ///< in hidden_
};

} // namespace abut::viewer
