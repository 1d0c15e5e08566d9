#include <abut/convex.h>
#include <abut/error.h>

#include "convex/closest_points.h"
#include "convex/convex_data.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

double sum_of_sizes(const Transform& t) {
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i)
        sum += std::abs(t.m[i]);
    return sum;
}

/// No coordinate in the pair's frame is off by more.
double rounding_of(const ConvexData& a, const ConvexData& b, const PolytopePair& pair) {
    return 0x1p-51 * (sum_of_sizes(*pair.a.linear) * a.reach +
                      sum_of_sizes(*pair.b.linear) * b.reach + std::abs(pair.b.offset.x) +
                      std::abs(pair.b.offset.y) + std::abs(pair.b.offset.z));
}

/// Two bodies under their transforms, at any pair of their levels.
struct PlacedBodies {
    const ConvexData &a, &b;
    const Transform &world_from_a, &world_from_b;

    [[nodiscard]] PolytopePair at(std::size_t level_a, std::size_t level_b) const {
        return {a.levels[level_a].polytope, world_from_a, b.levels[level_b].polytope, world_from_b};
    }
};

/// From coarse hulls to the bodies themselves, or to the first hulls that are near enough to them.
void descend(const PlacedBodies& bodies, double rounding, ClosestPointSearch& search) {
    std::size_t level_a = bodies.a.levels.size() - 1, level_b = bodies.b.levels.size() - 1;
    Vec3 direction;
    {
        const PolytopePair pair = bodies.at(0, 0);
        direction = pair.b.place(bodies.b.middle) - pair.a.place(bodies.a.middle);
    }
    for (;;) {
        const PolytopePair pair = bodies.at(level_a, level_b);
        search.at.a =
            vertex_feature(bodies.a.levels[level_a].starts.vertex(pair.a.pulled_back(direction)));
        search.at.b =
            vertex_feature(bodies.b.levels[level_b].starts.vertex(pair.b.pulled_back(-direction)));
        find_closest_points(pair, rounding, search);
        if (level_a == 0 && level_b == 0)
            return;
        direction = search.at.gap;
        level_a = 0;
        level_b = 0;
    }
}

/// The feature of the body that a feature of its triangulated surface is, or lies in.
void name(const ConvexData& body, const HullFeature& f, Feature& kind, std::uint32_t& id) {
    kind = f.kind;
    id = f.vertex;
    if (f.kind == Feature::edge)
        id = body.edge_number[f.edge];
    if (f.kind == Feature::face || id == kNoEdge) {
        kind = Feature::face;
        id = body.face_number[f.edge];
    }
}

void remember(const ClosestPointSearch& search, ConvexWorkspace& workspace) {
    auto& pairs = workspace.pairs;
    if (search.at.end == WalkEnd::meeting && search.simplex.count > 0) {
        workspace.kind = ConvexWorkspace::Kind::simplex;
        for (std::size_t i = 0; i < 4; ++i)
            pairs[i] = search.simplex.corners[i < search.simplex.count ? i : 0];
        return;
    }
    workspace.kind = ConvexWorkspace::Kind::features;
    const HullFeature &a = search.at.a, &b = search.at.b;
    pairs[0] = {a.vertex, b.vertex};
    pairs[1] = {a.edge, b.edge};
    pairs[2] = {static_cast<std::uint32_t>(a.kind), static_cast<std::uint32_t>(b.kind)};
}

/// Sets a feature to one that was remembered, if the polytope has it.
void recall(const Polytope& polytope, std::uint32_t vertex, std::uint32_t edge, std::uint32_t kind,
            HullFeature& f) {
    if (vertex >= polytope.vertices.size())
        return;
    const HullVertex& v = polytope.vertices[vertex];
    f.vertex = vertex;
    f.edge = edge;
    f.kind = edge - v.first_edge < v.degree ? static_cast<Feature>(kind) : Feature::vertex;
}

/// Goes on from where the last query ended.
void go_on(const PolytopePair& pair, double rounding, const ConvexWorkspace& last,
           ClosestPointSearch& search) {
    const Polytope &a = *pair.a.polytope, &b = *pair.b.polytope;
    const auto& pairs = last.pairs;
    if (last.kind == ConvexWorkspace::Kind::features) {
        recall(a, pairs[0].a, pairs[1].a, pairs[2].a, search.at.a);
        recall(b, pairs[0].b, pairs[1].b, pairs[2].b, search.at.b);
        find_closest_points(pair, rounding, search);
        return;
    }
    DifferenceSimplex& simplex = search.simplex;
    for (const VertexPair& last_pair : pairs) {
        const VertexPair corner{last_pair.a < a.vertices.size() ? last_pair.a : 0,
                                last_pair.b < b.vertices.size() ? last_pair.b : 0};
        auto* const end = simplex.corners.begin() + simplex.count;
        if (std::find(simplex.corners.begin(), end, corner) == end)
            simplex.corners[simplex.count++] = corner;
    }
    find_closest_points_from_simplex(pair, rounding, search);
}

} // namespace

ConvexGap distance(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, const ConvexDistanceOptions& options) {
    const PlacedBodies bodies{a.data(), b.data(), world_from_a, world_from_b};
    const PolytopePair pair = bodies.at(0, 0);
    const double rounding = rounding_of(bodies.a, bodies.b, pair);
    if (!std::isfinite(rounding)) {
        require_finite(world_from_a, "transform of a");
        require_finite(world_from_b, "transform of b");
    }
    if (!(options.max_error >= 0))
        throw Error(ErrorCode::bad_argument, "the error allowed must not be negative");
    ConvexWorkspace* const workspace = options.workspace;
    ClosestPointSearch search;
    if (workspace != nullptr && workspace->kind != ConvexWorkspace::Kind::empty)
        go_on(pair, rounding, *workspace, search);
    else
        descend(bodies, rounding, search);
    if (workspace != nullptr)
        remember(search, *workspace);

    ConvexGap gap;
    const WalkState& at = search.at;
    gap.counters = {at.feature_pairs, search.simplices};
    const Vec3 origin{world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    gap.point_a = origin + at.point_a;
    if (at.end == WalkEnd::meeting) {
        gap.distance = 0;
        gap.point_b = gap.point_a;
        gap.status = at.distance_sq == 0 ? Status::exact : Status::converged;
        return gap;
    }
    gap.point_b = origin + (at.point_a + at.gap);
    gap.distance = gap.at_least = std::sqrt(at.distance_sq);
    name(bodies.a, at.a, gap.feature_a, gap.id_a);
    name(bodies.b, at.b, gap.feature_b, gap.id_b);
    return gap;
}

} // namespace abut
