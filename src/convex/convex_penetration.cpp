#include <abut/convex.h>

#include "convex/convex_data.h"
#include "convex/convex_query.h"
#include "convex/expanding_polytope.h"

#include <array>
#include <span>

namespace abut {

ConvexDepth penetration(const Convex& a, const Transform& world_from_a, const Convex& b,
                        const Transform& world_from_b, ConvexWorkspace* workspace) {
    const double rounding = rounding_of(a.data(), world_from_a, b.data(), world_from_b);
    const PolytopePair pair(a.data().levels[0].polytope, world_from_a, b.data().levels[0].polytope,
                            world_from_b);
    const DifferenceSimplex first = first_simplex(a.data(), b.data(), pair, workspace);
    const SimplexState found = search_simplex(pair, first, rounding);
    ConvexDepth result;
    result.counters.simplices = found.steps;
    if (!found.meeting)
        return result;
    // With corners that were close to the way out last time, the polytope is there at once.
    std::array<VertexPair, 3> hints{};
    const bool warm = workspace != nullptr && workspace->kind == ConvexWorkspace::Kind::simplex;
    for (std::size_t i = 0; warm && i < hints.size(); ++i)
        hints[i] = recalled(pair, workspace->deepest[i]);
    const NearestBoundary nearest =
        ExpandingPolytope(pair, rounding)
            .run(found.simplex,
                 warm ? std::span<const VertexPair>(hints) : std::span<const VertexPair>());
    if (workspace != nullptr) {
        remember(found.simplex, *workspace);
        workspace->deepest = nearest.corners;
    }

    result.meet = true;
    result.counters.simplices += nearest.steps;
    result.depth = nearest.depth, result.at_least = nearest.at_least;
    // b - a reaches that far along the normal: b goes back by as much.
    result.direction = -nearest.normal;
    for (std::size_t i = 0; i < 3; ++i) {
        const double weight = nearest.weights[i];
        result.point_a = result.point_a + weight * pair.a.vertex(nearest.corners[i].a);
        result.point_b = result.point_b + weight * pair.b.vertex(nearest.corners[i].b);
    }
    const Vec3 origin{world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    result.point_a = origin + result.point_a;
    result.point_b = origin + result.point_b;
    if (result.depth - result.at_least > 2 * rounding)
        result.status = Status::converged;
    return result;
}

} // namespace abut
