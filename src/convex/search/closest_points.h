#pragma once

#include "convex/hull/placed_polytope.h"
#include "convex/search/gjk.h"
#include "convex/search/voronoi_marching.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// The closest points of two polytopes, or a common one.
struct ClosestPointSearch {
    /// Not constant: a constant object is zeroed as a whole, which takes some 30 cycles.
    ClosestPointSearch() {}

    /// Where it begins, then the closest points. `end` is meeting or closest; `proven` says of either
    /// whether that is so without a doubt.
    WalkState at;
    std::optional<DifferenceSimplex> simplex; ///< if meeting, and found so: it proves that
    std::uint32_t simplices = 0;              ///< that were measured
};

/// Walks from a pair of features, and leaves the cases in which walking ends early to the search by
/// simplices.
///
/// In/out      `search.at` and `rounding` as for `walk`.
void find_closest_points(const PolytopePair& pair, double rounding, ClosestPointSearch& search);

/// The same from `search.simplex`, as of polytopes that meet and may have moved since.
void find_closest_points_from_simplex(const PolytopePair& pair, double rounding,
                                      ClosestPointSearch& search);

/// The feature whose corners, or some of them, the vertices are. In a face of many corners these
/// need not be neighbours: then the triangle next to the first that is flattest as seen along n.
HullFeature spanned_feature(const Polytope& polytope, const Vec3& n,
                            std::span<const std::uint32_t> vertices);

/// The distinct vertices of one side of a simplex.
std::vector<std::uint32_t> vertices_of(const DifferenceSimplex& simplex,
                                       std::uint32_t VertexPair::*side);

} // namespace abut
