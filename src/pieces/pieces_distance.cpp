#include <abut/convex_pieces.h>
#include <abut/error.h>
#include <abut/shape_queries.h>

#include "geometry/point_triangle_distance.h"
#include "pieces/pieces_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace abut {

namespace {

void require_not_negative(double value, const char* what) {
    if (!(value >= 0))
        throw Error(ErrorCode::bad_argument, std::string(what) + " must not be negative");
}

/// A triangle of the surface and what of it holds a closest point.
struct SurfaceFeature {
    std::uint32_t triangle = 0;
    Feature kind = Feature::face;
    std::uint8_t index = 0;
};

/// One side of a pair of closest points.
struct Side {
    const ConvexPiecesData& solid;
    const Transform& world;
    std::uint32_t piece;
    const HullFeature& on;       ///< of the piece's hull
    const PlacedPolytope& place; ///< the frame of the query
    const Vec3 &point, &other;   ///< in there, in that frame
};

/// The feature of one of some triangles that is nearest to the other side's point.
SurfaceFeature nearest_feature(const Side& s, std::span<const std::uint32_t> triangles,
                               double& least_sq) {
    SurfaceFeature result;
    const Mesh& mesh = s.solid.mesh();
    for (const std::uint32_t t : triangles) {
        const auto& c = mesh.triangles[t];
        const NearestOnTriangle n = nearest_on_triangle(
            s.other, {s.place.place(mesh.positions[c[0]]), s.place.place(mesh.positions[c[1]]),
                      s.place.place(mesh.positions[c[2]])});
        if (n.distance_sq < least_sq) {
            least_sq = n.distance_sq;
            result = {t, static_cast<Feature>(n.dimension), n.index};
        }
    }
    return result;
}

SurfaceFeature at_vertex(const Side& s) {
    const Mesh& mesh = s.solid.mesh();
    const std::uint32_t source = s.solid.tree.sources[s.piece][s.on.vertex];
    SurfaceFeature result{s.solid.triangle_at[source], Feature::vertex, 0};
    const auto& corners = mesh.triangles[result.triangle];
    while (mesh.positions[corners.at(result.index)] != mesh.positions[source])
        ++result.index;
    return result;
}

/// The triangle and its feature that a closest point lies on. `last`: the one before, or null.
SurfaceFeature name(const Side& s, const Vec3& origin, double rounding, const std::uint32_t* last) {
    if (s.on.kind == Feature::vertex)
        return at_vertex(s);
    const double expected = length(s.other - s.point);
    const auto holds_point = [&](double distance_sq) {
        return std::sqrt(distance_sq) <= expected * (1 + 0x1p-40) + 16 * rounding;
    };
    double least_sq = std::numeric_limits<double>::infinity();
    SurfaceFeature result;
    if (last != nullptr) {
        result = nearest_feature(s, {last, 1}, least_sq);
        if (holds_point(least_sq))
            return result;
        least_sq = std::numeric_limits<double>::infinity();
    }
    const PieceFaces& faces = s.solid.faces[s.piece];
    if (faces.begin.empty()) {
        result = nearest_feature(s, s.solid.triangles_of(s.piece), least_sq);
    } else {
        const std::uint32_t face = faces.face_of_edge[s.on.edge];
        result = nearest_feature(s, faces.in(face), least_sq);
        const std::uint32_t beyond = faces.face_of_edge[s.place.polytope->twin(s.on.edge)];
        if (s.on.kind == Feature::edge && beyond != face) {
            double of_face_sq = least_sq;
            const SurfaceFeature there = nearest_feature(s, faces.in(beyond), of_face_sq);
            if (of_face_sq < least_sq)
                least_sq = of_face_sq, result = there;
        }
    }
    // Where the hull covers what other pieces have: one of theirs.
    if (!holds_point(least_sq)) {
        const std::uint32_t triangle = nearest(s.solid.model, s.world, origin + s.point).triangle;
        least_sq = std::numeric_limits<double>::infinity();
        result = nearest_feature(s, {&triangle, 1}, least_sq);
    }
    return result;
}

void report_common_point(const PlacedPieces& placed, const Vec3& point, PiecesGap& gap) {
    gap.distance = gap.at_least = 0;
    gap.point_a = gap.point_b = point;
    gap.triangle_a = placed.a.triangles_of(gap.piece_a)[0];
    gap.triangle_b = placed.b.triangles_of(gap.piece_b)[0];
}

void report(const PlacedPieces& placed, PiecesQuery& query, PiecesGap& gap) {
    const ClosestPieces& best = query.search().best();
    const WalkState& at = best.search.at;
    gap.piece_a = placed.node_a(best.hulls.a).piece;
    gap.piece_b = placed.node_b(best.hulls.b).piece;
    if (best.distance == 0) {
        report_common_point(placed, placed.origin() + at.point_a, gap);
        gap.status = at.distance_sq == 0 ? Status::exact : Status::converged;
        return;
    }
    const PolytopePair hulls = placed.hulls(best.hulls);
    const Vec3 point_b = at.point_a + at.gap;
    gap.distance = best.distance;
    gap.point_a = placed.origin() + at.point_a;
    gap.point_b = placed.origin() + point_b;
    const TrianglePair* last = query.last_triangles();
    const SurfaceFeature a = name({placed.a, placed.world_from_a, gap.piece_a, at.a, hulls.a,
                                   at.point_a, point_b},
                                  placed.origin(), placed.rounding,
                                  last != nullptr ? &last->a : nullptr),
                         b = name({placed.b, placed.world_from_b, gap.piece_b, at.b, hulls.b,
                                   point_b, at.point_a},
                                  placed.origin(), placed.rounding,
                                  last != nullptr ? &last->b : nullptr);
    query.remember({a.triangle, b.triangle});
    gap.triangle_a = a.triangle, gap.feature_a = a.kind, gap.index_a = a.index;
    gap.triangle_b = b.triangle, gap.feature_b = b.kind, gap.index_b = b.index;
}

} // namespace

PiecesGap distance(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                   const Transform& world_from_b, const PiecesDistanceOptions& options) {
    require_not_negative(options.upper_bound, "distance bound");
    require_not_negative(options.max_error, "distance error");
    PiecesGap gap;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    PiecesQuery query(placed, options.workspace, gap.counters);
    query.search().set_bound(options.upper_bound);
    query.search().set_slack(options.max_error);
    const bool found = query.run();
    const ClosestPieces& best = query.search().best();
    if (best.meet()) {
        report(placed, query, gap);
        return gap;
    }
    if (const auto point = query.contained_point(query.search().at_least())) {
        report_common_point(placed, *point, gap);
        return gap;
    }
    if (!found) {
        gap.distance = gap.at_least = options.upper_bound;
        gap.status = Status::bound_only;
        return gap;
    }
    report(placed, query, gap);
    gap.at_least = options.max_error > 0 ? query.search().at_least() : gap.distance;
    const double excess = best.search.at.excess;
    if (excess * excess > placed.rounding * placed.rounding * gap.distance * gap.distance)
        gap.at_least = std::max(0.0, std::min(gap.at_least, gap.distance - excess / gap.distance));
    if (gap.at_least < gap.distance)
        gap.status = Status::converged;
    return gap;
}

bool within(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
            const Transform& world_from_b, double tolerance, PiecesWorkspace* workspace) {
    require_not_negative(tolerance, "tolerance");
    PiecesCounters counters;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    PiecesQuery query(placed, workspace, counters);
    query.search().set_bound(tolerance);
    query.search().stop_at_first();
    return query.run() || query.contained_point(query.search().at_least()).has_value();
}

} // namespace abut
