#include <abut/convex.h>

#include "convex/convex_data.h"
#include "convex/convex_query.h"
#include "convex/expanding_polytope.h"
#include "math/vector.h"

#include <cmath>
#include <optional>

namespace abut {

namespace {

/// Four corners all around: one where the boundary is nearest by what the middles say, and three
/// across from that. Most often they hold the origin; if not, a search of simplices goes on from them.
DifferenceSimplex simplex_around(const PolytopePair& pair, const Vec3& between) {
    const Vec3 u = length_sq(between) > 0 ? normalized_or_zero(-between) : Vec3{1, 0, 0};
    const Vec3 v = perpendicular(u), w = cross(u, v);
    const double cosine = -0.5, sine = std::sqrt(0.75); // a third of a turn
    DifferenceSimplex simplex;
    for (const Vec3& outward : {u, v, cosine * v + sine * w, cosine * v - sine * w})
        add_if_new(facing_vertices(pair, -outward), simplex);
    return simplex;
}

/// From a simplex that holds the origin; none if there is none.
std::optional<NearestBoundary> begin(const ConvexData& a, const ConvexData& b,
                                     const PolytopePair& pair, double rounding,
                                     ConvexWorkspace* workspace, ConvexCounters& counters) {
    const DifferenceSimplex first = workspace != nullptr && has_simplex(*workspace)
                                        ? recalled_simplex(pair, *workspace)
                                        : simplex_around(pair, between_middles(a, b, pair));
    const SimplexState found = search_simplex(pair, first, rounding);
    counters.simplices = found.steps;
    if (!found.meeting)
        return std::nullopt;
    if (workspace != nullptr)
        remember(found.simplex, *workspace);
    return expand_simplex(pair, rounding, found.simplex,
                          workspace != nullptr ? &workspace->deepest : nullptr);
}

} // namespace

ConvexDepth penetration(const Convex& a, const Transform& world_from_a, const Convex& b,
                        const Transform& world_from_b, ConvexWorkspace* workspace) {
    const double rounding = rounding_of(a.data(), world_from_a, b.data(), world_from_b);
    const PolytopePair pair(a.data().levels[0].polytope, world_from_a, b.data().levels[0].polytope,
                            world_from_b);
    ConvexDepth result;
    // From what proved the last depth, if it still holds the origin.
    std::optional<NearestBoundary> nearest;
    if (workspace != nullptr && !workspace->deepest.faces.empty())
        nearest = expand_again(pair, rounding, workspace->deepest);
    if (!nearest)
        nearest = begin(a.data(), b.data(), pair, rounding, workspace, result.counters);
    if (!nearest)
        return result;
    result.meet = true;
    result.counters.simplices += nearest->steps;
    result.depth = nearest->depth, result.at_least = nearest->at_least;
    // b - a reaches that far along the normal: b goes back by as much.
    result.direction = -nearest->normal;
    for (std::size_t i = 0; i < 3; ++i) {
        const double weight = nearest->weights[i];
        result.point_a = result.point_a + weight * pair.a.vertex(nearest->corners[i].a);
        result.point_b = result.point_b + weight * pair.b.vertex(nearest->corners[i].b);
    }
    const Vec3 origin{world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    result.point_a = origin + result.point_a;
    result.point_b = origin + result.point_b;
    if (result.depth - result.at_least > 2 * rounding)
        result.status = Status::converged;
    return result;
}

} // namespace abut
