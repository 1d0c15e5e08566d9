#pragma once

#include <abut/model.h>
#include <abut/rigid.h>

namespace abut {

/// Distance of two models, negative where they go into each other: a signed distance for solids.
///
/// Apart: as `distance`. Touching: 0. Else minus the local penetration depth: of the points of
/// either surface inside the other, a solid, the largest distance to its surface; so also where one
/// lies inside the other without contact. The points and triangles are those that realise it.
///
/// In/out      `apart`: for models that are; returns the gap, `distance` negative inside.
/// Degenerate  open shells contain nothing: where they cross, minus the depth of triangles as
///             Depth::depth defines it, the points being one common point; so also where solids
///             coincide. Flattened models contain nothing either.
/// Accuracy    apart: to double rounding. Inside: |distance| is reached at the points, hence a
///             lower bound of the depth (status bound_only), to the accuracy asked for unless the
///             search's budget ends.
/// Cost        a distance query where the models are apart, plus one point-in-solid test each way;
///             else that of local_penetration.
Gap signed_gap(const Model& a, const Transform& world_from_a, const Model& b,
               const Transform& world_from_b, const DistanceOptions& apart = {},
               double relative_error = 0.01);

} // namespace abut
