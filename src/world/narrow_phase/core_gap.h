#pragma once

#include <abut/model.h>
#include <abut/shapes.h>
#include <abut/world.h>

#include "world/narrow_phase/narrow_phase.h"

// The gap of a model and a ball or a capsule, by the ball's centre or the capsule's axis.
namespace abut {

/// Bound of the rounding of a distance from a core, relative to the coordinates that it was computed from.
inline constexpr double kCoreRounding = 0x1p-48;

/// Measures the gap of a model's surface and a ball or a capsule. The model is body a.
///
/// In          upper_bound: as gap_between. depths: `yes` only for bodies that share a point.
/// Out         Depths::no: the distance of the surface from the core, less the radius. Depths::yes:
///             minus the depth. Where a part of the core lies in a closed model, that is the radius
///             and the distance of the core's deepest point from the surface. Where a capsule's
///             axis crosses an open surface, it is the depth in one of the triangles.
/// Degenerate  a core on the surface: the normal is that of a triangle there.
/// Accuracy    to rounding; the depth of an axis that crosses the surface is a lower bound
///             (bound_only).
BodyGap ball_gap(const Model& model, const Transform& world_from_model, const Sphere& ball,
                 double upper_bound, Depths depths);
BodyGap capsule_gap(const Model& model, const Transform& world_from_model, const Capsule& capsule,
                    double upper_bound, Depths depths);

} // namespace abut
