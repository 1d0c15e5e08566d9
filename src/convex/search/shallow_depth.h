// Penetration depth of two convex polytopes that overlap little, by walking.
//
// The depth is the distance from the origin to the boundary of the difference b - a. If b is moved
// out of a along an outward normal of the nearest face, the closest features of the two bodies are
// the corners of that face. So a walk (voronoi_marching.h) finds the face without building a
// polytope: b is moved out along a guess of the normal, and the walk's gap is the next guess.

#pragma once

#include "convex/hull/placed_polytope.h"
#include "convex/search/epa.h"
#include "convex/search/voronoi_marching.h"

#include <cstdint>

namespace abut {

/// A ball inside the difference b - a of two bodies: that between their inner balls.
struct DifferenceBall {
    Vec3 middle;
    double radius = 0; ///< less what rounding may add; not above 0 if there is none
};

struct ShallowSearch {
    /// The features to begin with; then those of the face, if `is_face`.
    HullFeature a, b;
    std::uint32_t feature_pairs = 0; ///< pairs of features measured
    bool is_face = false;            ///< a face that has the origin's foot inside was found
};

/// Searches for the face of the difference that is nearest to the origin.
///
/// In          `outward`: a unit vector, the first guess of the face's normal; `height`: how far
///             the difference reaches along it. `rounding` as for `walk`.
/// In/out      `search`: features to begin with, in any combination except two triangles.
/// Out         `nearest`: the face and its distance, if `search.is_face`. It is the answer if both
///             its bounds are proven.
void find_shallow_depth(const PolytopePair& pair, const DifferenceBall& ball, double rounding,
                        const Vec3& outward, double height, ShallowSearch& search,
                        NearestBoundary& nearest);

/// The same, from features that were those of the nearest face in another pose.
void find_shallow_depth_again(const PolytopePair& pair, const DifferenceBall& ball, double rounding,
                              ShallowSearch& search, NearestBoundary& nearest);

} // namespace abut
