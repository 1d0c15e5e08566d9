#include <abut/convex_pieces.h>
#include <abut/error.h>

#include "geometry/point_triangle_distance.h"
#include "pieces/pieces_query.h"

#include <algorithm>
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

/// The triangle and its feature that hold the point of a piece which is nearest to another.
///
/// In          the feature of the piece's hull that holds it; `other` in the frame of `place`.
SurfaceFeature name(const ConvexPiecesData& solid, std::uint32_t piece, const HullFeature& f,
                    const PlacedPolytope& place, const Vec3& other) {
    SurfaceFeature result;
    const auto& mesh = solid.mesh();
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](std::span<const std::uint32_t> triangles) {
        for (const std::uint32_t t : triangles) {
            const auto& c = mesh.triangles[t];
            const NearestOnTriangle n = nearest_on_triangle(
                other, {place.place(mesh.positions[c[0]]), place.place(mesh.positions[c[1]]),
                        place.place(mesh.positions[c[2]])});
            if (n.distance_sq < least) {
                least = n.distance_sq;
                result = {t, static_cast<Feature>(n.dimension), n.index};
            }
        }
    };
    if (f.kind == Feature::vertex) {
        const std::uint32_t source = solid.tree.sources[piece][f.vertex];
        result = {solid.triangle_at[source], Feature::vertex, 0};
        const auto& c = mesh.triangles[result.triangle];
        while (mesh.positions[c.at(result.index)] != mesh.positions[source])
            ++result.index;
        return result;
    }
    const PieceFaces& faces = solid.faces[piece];
    if (!faces.begin.empty()) {
        const std::uint32_t face = faces.face_of_edge[f.edge];
        look_at(faces.in(face));
        const std::uint32_t beyond = faces.face_of_edge[place.polytope->edges[f.edge].twin];
        if (f.kind == Feature::edge && beyond != face)
            look_at(faces.in(beyond));
    }
    if (!(least < std::numeric_limits<double>::infinity()))
        look_at(solid.triangles_of(piece));
    return result;
}

void report_common_point(const PlacedPieces& placed, const Vec3& point, PiecesGap& gap) {
    gap.distance = gap.at_least = 0;
    gap.point_a = gap.point_b = point;
    gap.triangle_a = placed.a.triangles_of(gap.piece_a)[0];
    gap.triangle_b = placed.b.triangles_of(gap.piece_b)[0];
}

void report(const PlacedPieces& placed, const ClosestPieces& best, PiecesGap& gap) {
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
    const SurfaceFeature a = name(placed.a, gap.piece_a, at.a, hulls.a, point_b),
                         b = name(placed.b, gap.piece_b, at.b, hulls.b, at.point_a);
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
        report(placed, best, gap);
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
    report(placed, best, gap);
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
