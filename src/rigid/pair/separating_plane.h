#pragma once

#include <abut/types.h>

#include "rigid/model/model_data.h"

namespace abut {

/// Returns whether a plane between two models proves that they are farther apart than `gap`. False
/// proves nothing. Any transforms, also singular ones.
///
/// In          gap >= 0.
/// Accuracy    proven for world positions as abut/types.h computes them.
/// Cost        in cache: 40 ns if the first plane decides, 110 ns if a later one does, 140 to 160
///             ns if none does; 55 ns for a single call.
/// Source      [Gilbert 1966]: steps towards the nearest point of a difference of convex sets, here
///             of the models' 98-DOPs, give the directions.
bool far_apart(const ModelData& a, const Transform& world_from_a, const ModelData& b,
               const Transform& world_from_b, double gap);

/// A slab between two models: they lie on its two sides, at least `gap` apart along `normal`.
struct SeparatingSlab {
    double gap = 0; ///< 0: no slab was found
    Vec3 normal;    ///< unit vector from a to b; zero if there is no slab
};

/// Looks for a wide slab between two models, from a direction on that a similar query has found;
/// zero: none is known.
///
/// Accuracy    the gap is proven, as for `far_apart`; it need not be the widest.
/// Cost        40 to 50 ns for each direction that is tried, at most six.
SeparatingSlab separation(const ModelData& a, const Transform& world_from_a, const ModelData& b,
                          const Transform& world_from_b, const Vec3& first);

} // namespace abut
