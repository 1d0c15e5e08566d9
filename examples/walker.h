#pragma once

#include <abut/walk.h>

#include <vector>

/// A person who walks through the parts of a store and stops at walls.
namespace walker {

struct Settings {
    double speed = 1.4; ///< m/s
    double skin = 0.05; ///< m; minimum distance to parts
    double frame = 1.0 / 60;
};

/// The position of the person after a frame, and the nearest part.
struct Frame {
    abut::Vec3 position; ///< of the capsule's centre
    abut::NearestPart nearest;
};

class Walker {
public:
    /// A capsule 1.8 m tall, y up.
    Walker(abut::Walk& walk, const abut::Vec3& start, const Settings& settings = {});

    /// Moves for one frame towards a place. The person slides along parts that are in the way.
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
