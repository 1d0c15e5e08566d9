#pragma once

#include <abut/model.h>
#include <abut/rigid.h>

namespace abut {

/// The signed distance of two models: negative if they interpenetrate.
///
/// If the models are apart, the result is that of `distance`; if they only touch, it is 0.
/// Otherwise it is minus the local penetration depth: the largest distance from a solid's surface
/// that a point of the other surface has inside that solid. That includes a model that lies inside
/// the other without contact. The points and triangles are those that realise the distance.
///
/// In/out      `apart`: options for models that are apart.
/// Degenerate  open shells contain nothing: if they cross, the depth is that of triangles as
///             Depth::depth defines it, at one common point (bound_only). Solids that coincide have
///             the length of a motion that separates them (bound_only). Flattened models contain
///             nothing either.
/// Accuracy    apart: to double rounding. Inside: |distance| is reached at the points, and so is a
///             lower bound of the depth (status bound_only), to the accuracy asked for unless the
///             search's budget is used up.
/// Cost        apart: a distance query and one point-in-solid test for each model; else that of
///             local_penetration.
Gap signed_gap(const Model& a, const Transform& world_from_a, const Model& b,
               const Transform& world_from_b, const DistanceOptions& apart = {},
               double relative_error = 0.01);

} // namespace abut
