#pragma once

#include "view/selection/level_cut.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

/// How the camera moves.
struct CameraMotion {
    Camera camera;
    Vec3 velocity;
    Vec3 turning; ///< of the viewing direction: axis times radians a second
    /// Whether a plan for `other` no longer serves: the paths differ by more than an eighth of the
    /// way, or the directions by more than a sixteenth of the field of view.
    [[nodiscard]] bool differs(const CameraMotion& other, double seconds) const;
};

/// Returns the camera after a time, if the motion goes on.
Camera predicted(const CameraMotion& motion, double seconds);

/// The chunks that a camera needs now and soon, in the order to load them: first those that are
/// seen from now on along the predicted path, then those around. Of either group those come first
/// for which the coarser stand-in shows the largest error in pixels.
class LoadPlan {
public:
    /// In          tree: must outlive the plan; bytes: the plan ends before it exceeds them.
    LoadPlan(const LevelTree& tree, const CameraMotion& motion, double look_ahead,
             double pixel_error, std::uint64_t bytes);

    /// Returns the next chunk. Parents come before their children.
    std::optional<std::uint32_t> next();
    /// Bytes of a plan of a tree, at most.
    static std::uint64_t most_bytes(const LevelTree& tree);

private:
    struct Step {
        ViewItem item;
        float error = 0; ///< in pixels, of what stands for the item until it is loaded
        bool is_seen = false;
        friend bool operator<(const Step& a, const Step& b) {
            if (a.is_seen != b.is_seen)
                return b.is_seen;
            if (a.error != b.error)
                return a.error < b.error;
            return a.item.node != b.item.node ? a.item.node > b.item.node
                                              : a.item.level > b.item.level;
        }
    };
    [[nodiscard]] bool is_seen(const LevelNode& node) const;
    [[nodiscard]] double error_of(ViewItem item) const;
    void push_finer(const Step& step);

    ViewItems items_;
    std::vector<ViewPoint> path_;
    double pixel_error_;
    std::uint64_t bytes_left_;
    std::vector<Step> heap_;
    std::vector<bool> is_planned_; ///< by chunk
};

} // namespace abut
