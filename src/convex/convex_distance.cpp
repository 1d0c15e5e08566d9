#include <abut/convex.h>
#include <abut/error.h>

#include "convex/closest_points.h"
#include "convex/convex_data.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// No coordinate in the pair's frame, and no difference of two, is off by more.
double rounding_of(const ConvexData& a, const ConvexData& b, const PolytopePair& pair) {
    const auto largest = [](const LinearMap& m) {
        return std::max({max_abs(m.x), max_abs(m.y), max_abs(m.z)});
    };
    return 0x1p-49 *
           (largest(pair.a.map) * a.reach + largest(pair.b.map) * b.reach + max_abs(pair.b.offset));
}

/// Two bodies under their transforms, at any pair of their levels.
struct PlacedBodies {
    const ConvexData &a, &b;
    const Transform &world_from_a, &world_from_b;

    [[nodiscard]] PolytopePair at(std::size_t level_a, std::size_t level_b) const {
        return {a.levels[level_a].polytope, world_from_a, b.levels[level_b].polytope, world_from_b};
    }
};

/// Where a search without a workspace begins: the vertices of two levels that are farthest towards
/// each other along a direction in the pair's frame.
VertexPair facing(const PlacedBodies& bodies, const PolytopePair& pair, std::size_t level_a,
                  std::size_t level_b, const Vec3& direction) {
    return {bodies.a.levels[level_a].starts.vertex(pair.a.map.pulled_back(direction)),
            bodies.b.levels[level_b].starts.vertex(pair.b.map.pulled_back(-direction))};
}

/// From coarse hulls to the bodies themselves, or to the first hulls that are near enough to them.
class Descent {
public:
    Descent(const PlacedBodies& bodies, double rounding, double max_error)
        : bodies_(bodies), rounding_(rounding), max_error_(max_error) {}

    ClosestState run() {
        std::size_t level_a = bodies_.a.levels.size() - 1, level_b = bodies_.b.levels.size() - 1;
        Vec3 direction = between_middles();
        ClosestState state;
        for (;;) {
            const PolytopePair pair = bodies_.at(level_a, level_b);
            const VertexPair start = facing(bodies_, pair, level_a, level_b, direction);
            const ClosestState next =
                closest_points(pair, vertex_feature(start.a), vertex_feature(start.b), rounding_);
            const std::uint32_t feature_pairs = state.feature_pairs + next.feature_pairs,
                                simplices = state.simplices + next.simplices;
            state = next;
            state.feature_pairs = feature_pairs, state.simplices = simplices;
            if ((level_a == 0 && level_b == 0))
                return state;
            direction = state.gap;
            level_a = 0;
            level_b = 0;
        }
    }

private:
    [[nodiscard]] Vec3 between_middles() const {
        const PolytopePair pair = bodies_.at(0, 0);
        return pair.b.place(bodies_.b.middle) - pair.a.place(bodies_.a.middle);
    }

    const PlacedBodies& bodies_;
    double rounding_, max_error_;
};

struct NamedFeature {
    Feature kind;
    std::uint32_t id;
};

/// The feature of the body that a feature of its triangulated surface is, or lies in.
NamedFeature named(const ConvexData& body, const HullFeature& f) {
    if (f.kind == Feature::vertex)
        return {Feature::vertex, f.vertex};
    if (f.kind == Feature::edge && body.edge_number[f.edge] != kNoEdge)
        return {Feature::edge, body.edge_number[f.edge]};
    return {Feature::face, body.face_number[f.edge]};
}

void remember(ConvexWorkspace* workspace, const ClosestState& state) {
    if (workspace == nullptr)
        return;
    if (state.meeting && state.simplex.count > 0) {
        workspace->kind = ConvexWorkspace::Kind::simplex;
        for (std::size_t i = 0; i < 4; ++i) {
            const VertexPair& corner = state.simplex.corners[i < state.simplex.count ? i : 0];
            workspace->a[i] = corner.a, workspace->b[i] = corner.b;
        }
        return;
    }
    const auto as_numbers = [](const HullFeature& f) {
        return std::array{f.vertex, f.edge, static_cast<std::uint32_t>(f.kind), 0U};
    };
    workspace->kind = ConvexWorkspace::Kind::features;
    workspace->a = as_numbers(state.a), workspace->b = as_numbers(state.b);
}

/// A feature as it was remembered, if the polytope has it.
HullFeature recalled(const Polytope& polytope, const std::array<std::uint32_t, 4>& numbers) {
    const auto [vertex, edge, kind, unused] = numbers;
    if (vertex >= polytope.vertices.size())
        return vertex_feature(0);
    const HullVertex& v = polytope.vertices[vertex];
    if (edge - v.first_edge >= v.degree)
        return vertex_feature(vertex);
    return {vertex, edge, static_cast<Feature>(kind)};
}

/// Goes on from where the last query ended.
ClosestState continued(const PolytopePair& pair, const ConvexWorkspace& last, double rounding) {
    if (last.kind == ConvexWorkspace::Kind::features)
        return closest_points(pair, recalled(*pair.a.polytope, last.a),
                              recalled(*pair.b.polytope, last.b), rounding);
    DifferenceSimplex simplex;
    for (std::size_t i = 0; i < 4; ++i) {
        const VertexPair corner{recalled(*pair.a.polytope, {last.a[i]}).vertex,
                                recalled(*pair.b.polytope, {last.b[i]}).vertex};
        const auto end = simplex.corners.begin() + simplex.count;
        if (std::find(simplex.corners.begin(), end, corner) == end)
            simplex.corners[simplex.count++] = corner;
    }
    return closest_points(pair, simplex, rounding);
}

void require_placement(const Transform& t, const char* what) {
    double sum = 0;
    for (const double v : t.m)
        sum += 0 * v; // NaN if any is infinite or none
    if (sum != 0)
        require_finite(t, what);
}

} // namespace

ConvexGap distance(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, const ConvexDistanceOptions& options) {
    require_placement(world_from_a, "transform of a");
    require_placement(world_from_b, "transform of b");
    if (!(options.max_error >= 0))
        throw Error(ErrorCode::bad_argument, "the error allowed must not be negative");
    const PlacedBodies bodies{a.data(), b.data(), world_from_a, world_from_b};
    const PolytopePair pair = bodies.at(0, 0);
    const double rounding = rounding_of(bodies.a, bodies.b, pair);
    ConvexWorkspace* const workspace = options.workspace;
    const ClosestState state =
        workspace != nullptr && workspace->kind != ConvexWorkspace::Kind::empty
            ? continued(pair, *workspace, rounding)
            : Descent(bodies, rounding, options.max_error).run();
    remember(workspace, state);

    ConvexGap gap;
    gap.counters = {state.feature_pairs, state.simplices};
    const Vec3 origin{world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    gap.point_a = origin + state.point_a;
    if (state.meeting) {
        gap.distance = 0;
        gap.point_b = gap.point_a;
        gap.status = state.distance_sq == 0 ? Status::exact : Status::converged;
        return gap;
    }
    gap.point_b = origin + (state.point_a + state.gap);
    gap.distance = gap.at_least = std::sqrt(state.distance_sq);
    const NamedFeature on_a = named(bodies.a, state.a), on_b = named(bodies.b, state.b);
    gap.feature_a = on_a.kind, gap.id_a = on_a.id;
    gap.feature_b = on_b.kind, gap.id_b = on_b.id;
    return gap;
}

} // namespace abut
