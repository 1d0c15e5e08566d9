#include "walker.h"

#include <abut/vector.h>

#include <algorithm>
#include <cmath>

namespace walker {

Walker::Walker(abut::Walk& walk, const abut::Vec3& start, const Settings& settings)
    : walk_(walk), settings_(settings), body_(abut::Capsule{{{0, -0.6, 0}, {0, 0.6, 0}}, 0.3}),
      position_(start) {}

Frame Walker::step_towards(const abut::Vec3& goal) {
    const abut::Vec3 way = goal - position_;
    const double left = length(way);
    abut::Vec3 velocity;
    if (left > 0)
        velocity = (std::min(settings_.speed, left / settings_.frame) / left) * way;
    // The velocity component towards a near part is removed.
    const abut::NearParts near = walk_.within(body_, abut::Pose{position_}, settings_.skin);
    constexpr int kCorners = 8; // one part may deflect the velocity towards another
    for (int i = 0; i < kCorners; ++i)
        for (const abut::WalkGap& gap : near.parts)
            if (const double inward = dot(velocity, gap.normal); inward < 0)
                velocity = velocity - inward * gap.normal;
    for (const abut::WalkGap& gap : near.parts)
        if (dot(velocity, gap.normal) < -1e-9)
            velocity = {}; // stuck between parts
    position_ = position_ + settings_.frame * velocity;
    walk_.move_to(position_, velocity);
    return {position_, walk_.distance(body_, abut::Pose{position_})};
}

double Walker::way_to(const abut::Vec3& goal) const {
    return length(goal - position_);
}

} // namespace walker
