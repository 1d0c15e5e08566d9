#pragma once

#include <abut/walk.h>

#include <vector>

/// A person who walks through the parts of a store, and does not walk through walls.
namespace walker {

struct Settings {
    double speed = 1.4; ///< m/s
    double skin = 0.05; ///< m: this near to a part, one does not go nearer
    double frame = 1.0 / 60;
};

/// Where the person is after a frame, and what is nearest.
struct Frame {
    abut::Vec3 position; ///< of the middle
    abut::NearestPart nearest;
};

class Walker {
public:
    /// A capsule 1.8 m tall, y up.
    Walker(abut::Walk& walk, const abut::Vec3& start, const Settings& settings = {});

    /// One frame towards a place; what is in the way is walked around, as far as sliding along it does
    /// that.
    Frame step_towards(const abut::Vec3& goal);
    [[nodiscard]] const abut::Vec3& position() const { return position_; }
    [[nodiscard]] double way_to(const abut::Vec3& goal) const;

private:
    abut::Walk& walk_;
    Settings settings_;
    abut::Probe body_;
    abut::Vec3 position_;
};

} // namespace walker
