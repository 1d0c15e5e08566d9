#pragma once

#include "rigid/model/placed_model.h"
#include "world/schedule/turning_solids.h"

namespace abut {

/// A model's surface at one time, and its motion from then on, as of a TurningSolid.
struct TurningSurface {
    const PlacedModel& model;
    Vec3 centre, velocity, angular_velocity;
};

/// A time up to which more than `margin` of room is left between a surface and a solid, at most `horizon`.
/// 0 if none is proven.
///
/// In          free: a time that is known to be free, above 0. fastest: bounds the speed at which points
///             of the two approach each other.
/// Source      each triangle that the solid can meet within the time is convex, and has a direction of
///             its own along which it is apart from the solid.
/// Cost        a distance for each triangle that the solid can meet soon, at most 256 for each of a
///             few growing times.
double time_with_room(const TurningSurface& surface, const TurningSolid& solid, double free,
                      double fastest, double margin, double horizon);

} // namespace abut
