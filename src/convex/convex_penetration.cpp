#include <abut/convex.h>

#include "convex/convex_data.h"
#include "convex/convex_query.h"
#include "convex/expanding_polytope.h"

#include <optional>

namespace abut {

namespace {

/// From what proved the last depth; none if it does not hold the origin any more, or there is none.
std::optional<NearestBoundary> go_on(const PolytopePair& pair, double rounding,
                                     ConvexWorkspace* workspace) {
    if (workspace == nullptr || workspace->deepest.faces.empty())
        return std::nullopt;
    ExpandingPolytope polytope(pair, rounding);
    if (!polytope.recall(workspace->deepest))
        return std::nullopt;
    std::optional<NearestBoundary> nearest = polytope.expand();
    if (nearest)
        polytope.remember(workspace->deepest);
    return nearest;
}

/// From a simplex that holds the origin; none if there is none.
std::optional<NearestBoundary> begin(const ConvexData& a, const ConvexData& b,
                                     const PolytopePair& pair, double rounding,
                                     ConvexWorkspace* workspace, ConvexCounters& counters) {
    const DifferenceSimplex first = first_simplex(a, b, pair, workspace);
    const SimplexState found = search_simplex(pair, first, rounding);
    counters.simplices = found.steps;
    if (!found.meeting)
        return std::nullopt;
    ExpandingPolytope polytope(pair, rounding);
    std::optional<NearestBoundary> nearest = polytope.begin(found.simplex);
    if (!nearest)
        nearest = polytope.expand();
    if (workspace != nullptr) {
        remember(found.simplex, *workspace);
        polytope.remember(workspace->deepest);
    }
    return nearest;
}

} // namespace

ConvexDepth penetration(const Convex& a, const Transform& world_from_a, const Convex& b,
                        const Transform& world_from_b, ConvexWorkspace* workspace) {
    const double rounding = rounding_of(a.data(), world_from_a, b.data(), world_from_b);
    const PolytopePair pair(a.data().levels[0].polytope, world_from_a, b.data().levels[0].polytope,
                            world_from_b);
    ConvexDepth result;
    std::optional<NearestBoundary> nearest = go_on(pair, rounding, workspace);
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
