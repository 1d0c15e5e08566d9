#include <abut/convex_pieces.h>
#include <abut/error.h>
#include <abut/shape_queries.h>

#include "core/arguments.h"
#include "core/stop.h"
#include "geometry/point_triangle_distance.h"
#include "pieces/pieces_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace abut {

namespace {

/// A distance counts as exact if what is not proven of it is at most this share of it and so many
/// roundings of a placed vertex.
constexpr double kOpenShare = 1e-12, kOpenRoundings = 12;

/// A triangle of the surface, and its feature that holds a closest point.
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
    const PlacedPolytope& place; ///< in the frame of the query
    /// The closest points on this side and on the other, in that frame.
    const Vec3 &point, &other;
};

/// The feature of some triangles that is nearest to a point. `least_sq`: only features nearer than
/// this count; set to the squared distance found. `place`: set to the nearest point.
SurfaceFeature nearest_feature(const Side& s, const Vec3& point,
                               std::span<const std::uint32_t> triangles, double& least_sq,
                               Vec3& place) {
    SurfaceFeature result;
    const Mesh& mesh = s.solid.mesh();
    for (const std::uint32_t t : triangles) {
        const auto& c = mesh.triangles[t];
        const NearestOnTriangle n = nearest_on_triangle(
            point, {s.place.place(mesh.positions[c[0]]), s.place.place(mesh.positions[c[1]]),
                    s.place.place(mesh.positions[c[2]])});
        if (n.distance_sq < least_sq) {
            least_sq = n.distance_sq;
            place = n.point;
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

/// Returns whether a point lies on a segment, to `most_off`.
bool lies_on(const Vec3& point, const Vec3& from, const Vec3& to, double most_off) {
    const Vec3 edge = to - from, w = point - from;
    const double along = dot(w, edge), all = length_sq(edge);
    return along >= 0 && along <= all && length_sq(cross(w, edge)) <= most_off * most_off * all;
}

/// The triangle that has the hull's edge with the closest point as one of its own, found by the
/// edge's ends. None if there is none; most such edges have one.
std::optional<SurfaceFeature> same_edge(const Side& s, double most_off,
                                        std::span<const std::uint32_t> triangles) {
    if (s.on.kind != Feature::edge)
        return std::nullopt;
    const Polytope& p = *s.place.polytope;
    const Vec3 &from = p.vertices[s.on.vertex].at, to = p.to(s.on.edge);
    const Mesh& mesh = s.solid.mesh();
    for (const std::uint32_t t : triangles) {
        const auto& c = mesh.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &v = mesh.positions[c[k]], &w = mesh.positions[c[(k + 1) % 3]];
            if ((v == from && w == to) || (v == to && w == from)) {
                if (!lies_on(s.point, s.place.place(from), s.place.place(to), most_off))
                    return std::nullopt;
                return SurfaceFeature{t, Feature::edge, static_cast<std::uint8_t>(k)};
            }
        }
    }
    return std::nullopt;
}

/// The triangle, and its feature, that hold a closest point. `last`: the triangle of the last
/// query, or null.
SurfaceFeature name(const Side& s, const Vec3& origin, double rounding, const std::uint32_t* last) {
    if (s.on.kind == Feature::vertex)
        return at_vertex(s);
    const double most_off = 0x1p-48 * length(s.other - s.point) + 2 * rounding;
    double least_sq = std::numeric_limits<double>::infinity();
    Vec3 place;
    const auto holds_point = [&] { return length_sq(place - s.point) <= most_off * most_off; };
    SurfaceFeature result;
    if (last != nullptr) {
        if (const auto same = same_edge(s, most_off, {last, 1}))
            return *same;
        result = nearest_feature(s, s.other, {last, 1}, least_sq, place);
        if (holds_point())
            return result;
        least_sq = std::numeric_limits<double>::infinity();
    }
    const PieceFaces& faces = s.solid.faces[s.piece];
    if (faces.begin.empty()) {
        if (const auto same = same_edge(s, most_off, s.solid.triangles_of(s.piece)))
            return *same;
        result = nearest_feature(s, s.other, s.solid.triangles_of(s.piece), least_sq, place);
    } else {
        const std::uint32_t face = faces.face_of_edge[s.on.edge];
        if (const auto same = same_edge(s, most_off, faces.in(face)))
            return *same;
        result = nearest_feature(s, s.other, faces.in(face), least_sq, place);
        const std::uint32_t beyond = faces.face_of_edge[s.place.polytope->twin(s.on.edge)];
        if (s.on.kind == Feature::edge && beyond != face) {
            const double of_face_sq = least_sq;
            const SurfaceFeature there =
                nearest_feature(s, s.other, faces.in(beyond), least_sq, place);
            if (least_sq < of_face_sq)
                result = there;
        }
    }
    if (!std::isinf(least_sq) && holds_point())
        return result;
    // The point lies on triangles of another piece, or triangles lie almost in one plane.
    const std::uint32_t triangle = nearest(s.solid.model, s.world, origin + s.point).triangle;
    least_sq = std::numeric_limits<double>::infinity();
    result = nearest_feature(s, s.other, {&triangle, 1}, least_sq, place);
    if (holds_point())
        return result;
    least_sq = std::numeric_limits<double>::infinity();
    return nearest_feature(s, s.point, {&triangle, 1}, least_sq, place);
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

/// The answer if rounding hides what the hulls do: that of the triangles.
void report_surfaces(const PlacedPieces& placed, PiecesQuery& query, double upper_bound,
                     PiecesGap& gap) {
    const ClosestPieces& best = query.search().best();
    // Placed as the triangles are, the points found may be slightly farther apart.
    const double bound = best.found ? best.distance + 2 * placed.contact_zone() : upper_bound;
    Gap surfaces = query.surface_gap(bound);
    if (surfaces.status == Status::bound_only && best.found)
        surfaces = query.surface_gap(std::numeric_limits<double>::infinity());
    const bool is_beyond = surfaces.status == Status::bound_only || surfaces.distance > upper_bound;
    gap.triangle_a = surfaces.triangle_a, gap.triangle_b = surfaces.triangle_b;
    gap.piece_a = placed.a.piece_of[gap.triangle_a];
    gap.piece_b = placed.b.piece_of[gap.triangle_b];
    if (!is_beyond && surfaces.distance == 0) {
        gap.distance = 0;
        gap.point_a = gap.point_b = surfaces.point_a;
        return;
    }
    const double apart = std::max(0.0, surfaces.at_least - placed.contact_zone());
    if (const auto point = query.contained_point(apart)) {
        report_common_point(placed, *point, gap);
        return;
    }
    if (is_beyond) {
        gap.distance = upper_bound;
        gap.at_least = std::min(surfaces.at_least, upper_bound);
        gap.status = Status::bound_only;
        return;
    }
    gap.distance = surfaces.distance;
    gap.at_least = surfaces.at_least;
    gap.point_a = surfaces.point_a, gap.point_b = surfaces.point_b;
    gap.feature_a = surfaces.feature_a, gap.index_a = surfaces.index_a;
    gap.feature_b = surfaces.feature_b, gap.index_b = surfaces.index_b;
}

} // namespace

PiecesGap distance(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                   const Transform& world_from_b, const PiecesDistanceOptions& options) {
    require_not_negative(options.upper_bound, "distance bound");
    require_not_negative(options.absolute_error, "absolute error");
    const StopScope stopping(options.progress);
    PiecesGap gap;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    PiecesQuery query(placed, options.warm_start, gap.counters);
    query.search().set_bound(options.upper_bound);
    query.search().set_slack(options.absolute_error);
    const bool found = query.run();
    const ClosestPieces& best = query.search().best();
    if (!query.search().is_decided()) {
        report_surfaces(placed, query, options.upper_bound, gap);
        return gap;
    }
    if (best.meet()) {
        report(placed, query, gap);
        return gap;
    }
    if (const auto point = query.contained_point(query.search().at_least())) {
        report_common_point(placed, *point, gap);
        return gap;
    }
    // The hulls' bound is for vertices placed without rounding.
    const double proven = query.search().at_least() - 2 * placed.world_rounding();
    if (!found) {
        gap.distance = options.upper_bound;
        gap.at_least = std::clamp(proven, 0.0, options.upper_bound);
        gap.status = Status::bound_only;
        return gap;
    }
    report(placed, query, gap);
    gap.at_least = std::clamp(proven, 0.0, gap.distance);
    // Hulls of slivers can leave more open than rounding does: then the triangles decide.
    const double left_open = gap.distance - gap.at_least;
    if (options.absolute_error == 0 &&
        left_open > kOpenShare * gap.distance + kOpenRoundings * placed.world_rounding()) {
        report_surfaces(placed, query, options.upper_bound, gap);
        return gap;
    }
    if (options.absolute_error > 0 && gap.at_least < gap.distance)
        gap.status = Status::converged;
    return gap;
}

bool within(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
            const Transform& world_from_b, double tolerance, const PiecesWithinOptions& options) {
    require_not_negative(tolerance, "tolerance");
    const StopScope stopping(options.progress);
    PiecesCounters counters;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    if (std::isinf(tolerance))
        return true;
    PiecesQuery query(placed, options.warm_start, counters);
    query.search().set_bound(tolerance);
    query.search().stop_at_first();
    const bool found = query.run();
    const ClosestPieces& best = query.search().best();
    const double hidden = 0x1p-40 * tolerance + 8 * placed.contact_zone();
    // Hulls of slivers may seem to meet where they are apart: only a proof tells.
    if (found && (best.meet() ? best.proven : best.distance < tolerance - hidden))
        return true;
    if (!found && query.search().at_least() > tolerance + hidden)
        return query.contained_point(query.search().at_least()).has_value();
    return distance(a, world_from_a, b, world_from_b).distance <= tolerance;
}

} // namespace abut
