#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"
#include "convex/search/voronoi_marching.h"

namespace abut {

/// The vertices of two hulls that are farthest along a direction and against it, up to rounding.
///
/// In          `along`: not zero. `reach_a`, `reach_b`: no vertex has a larger coordinate.
/// Accuracy    proven: all vertices of small hulls are looked at. In larger ones a climb ends at a
///             vertex; its neighbours are looked at, and theirs, as long as rounding may hide that they
///             are farther. (The vertices of a polytope above any height are connected by its edges.)
VertexPair proven_farthest(const PolytopePair& pair, const Vec3& along, double reach_a,
                           double reach_b);

/// How far apart two hulls are along a direction: no two of their points are closer, if it is
/// positive.
///
/// In          as above. `margin`: what the hulls may leave out and rounding may hide.
double proven_room(const PolytopePair& pair, const Vec3& along, double reach_a, double reach_b,
                   double margin);

/// The largest proven room of two hulls along the directions in which the features at their closest
/// points face: the normals of faces and of the planes of two edges. These keep their digits where
/// the gap itself has lost them, because it is short.
///
/// In          as above; the search ends once the room is `enough`.
double proven_room_at(const PolytopePair& pair, const WalkState& at, double reach_a, double reach_b,
                      double margin, double enough);

} // namespace abut
