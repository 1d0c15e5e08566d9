#pragma once

#include <abut/convex.h>

#include "convex/hull/placed_polytope.h"
#include "convex/search/voronoi_marching.h"

namespace abut {

/// The vertices of two hulls that are farthest along a direction (of a) and against it (of b), to
/// rounding.
///
/// In          `along`: not zero. `reach_a`, `reach_b`: bounds on the vertices' coordinates.
/// Accuracy    proven. In small hulls all vertices are compared. In larger ones a climb ends at a
///             vertex; from there, neighbours are searched as long as rounding may hide that they
///             are farther. (The vertices of a polytope above any height are connected by its
///             edges.)
VertexPair proven_farthest(const PolytopePair& pair, const Vec3& along, double reach_a,
                           double reach_b);

/// How far apart two hulls are along a direction. If positive, a lower bound of their distance.
///
/// In          as above. `margin`: what the hulls may leave out, and rounding.
double proven_room(const PolytopePair& pair, const Vec3& along, double reach_a, double reach_b,
                   double margin);

/// The largest proven room of two hulls along the directions that the features at their closest
/// points face: the normals of faces, and of the planes of two edges. These keep their digits where
/// a short gap has lost its own.
///
/// In          as above. The search ends once the room is `enough`.
double proven_room_at(const PolytopePair& pair, const WalkState& at, double reach_a, double reach_b,
                      double margin, double enough);

} // namespace abut
