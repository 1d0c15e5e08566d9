#pragma once

#include "convex/hull/placed_polytope.h"
#include "convex/search/gjk.h"
#include "convex/search/voronoi_marching.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// The closest points of two polytopes, or a common point.
struct ClosestPointSearch {
    /// User-provided, so that the object is not zeroed first, which takes some 30 cycles.
    ClosestPointSearch() {}

    /// The features to begin with; then the closest points. At the end `at.end` is `meeting` or
    /// `closest`, and `at.proven` tells whether that is certain.
    WalkState at;
    std::optional<DifferenceSimplex> simplex; ///< holds the origin, if GJK found the meeting
    std::uint32_t simplices = 0;              ///< simplices measured
};

/// Walks from a pair of features (voronoi_marching.h), and continues with GJK (gjk.h) if the walk
/// gets stuck.
///
/// In/out      `search.at` and `rounding` as for `walk`.
void find_closest_points(const PolytopePair& pair, double rounding, ClosestPointSearch& search);

/// Searches with GJK from `search.simplex`: for polytopes that probably meet, as in the last query.
void find_closest_points_from_simplex(const PolytopePair& pair, double rounding,
                                      ClosestPointSearch& search);

/// The feature whose corners include the vertices. In a face of many corners the vertices need not
/// be neighbours; then the triangle at the first vertex that is flattest as seen along n.
HullFeature spanned_feature(const Polytope& polytope, const Vec3& n,
                            std::span<const std::uint32_t> vertices);

/// The distinct vertices of polytope a or b that a simplex uses.
std::vector<std::uint32_t> vertices_of(const DifferenceSimplex& simplex,
                                       std::uint32_t VertexPair::*side);

} // namespace abut
