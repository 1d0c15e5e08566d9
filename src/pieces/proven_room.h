#pragma once

#include <abut/convex.h>

#include "convex/feature_walk.h"
#include "convex/placed_polytope.h"

namespace abut {

/// How far apart two hulls are along a direction: no two of their points are closer, if it is
/// positive.
///
/// In          `along`: not zero. `reach_a`, `reach_b`: no vertex has a larger coordinate. `margin`:
///             what the hulls may leave out and rounding may hide.
/// Accuracy    proven: of small hulls all vertices are looked at; else, from the one that a climb ends
///             at, its neighbours are, and theirs, as long as rounding may hide that they are farther.
///             (The vertices of a polytope above any height are connected by its edges.)
double proven_room(const PolytopePair& pair, const Vec3& along, double reach_a, double reach_b,
                   double margin);

/// The largest proven room of two hulls along the directions in which the features at their closest
/// points face: the normals of faces and of the planes of two edges. These keep their digits where
/// the gap itself has lost them, because it is short.
///
/// In          as above; the search ends once the room is `enough`.
double proven_room_at(const PolytopePair& pair, const WalkState& at, double reach_a, double reach_b,
                      double margin, double enough);

/// Returns whether rounding hides that a walk has not ended: a hull goes on beyond an edge along the gap,
/// though the triangles on both sides of the edge seem to lie behind it.
///
/// In          `error_a`, `error_b`: what the gap along an edge may be off by, over the edge's length.
bool hides_more(const PolytopePair& pair, const WalkState& at, double error_a, double error_b);

} // namespace abut
