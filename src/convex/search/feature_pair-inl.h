// The closest points of two features of convex polytopes.

// Included once for each target.
#if defined(ABUT_CONVEX_FEATURE_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_CONVEX_FEATURE_PAIR_INL_H
#undef ABUT_CONVEX_FEATURE_PAIR_INL_H
#else
#define ABUT_CONVEX_FEATURE_PAIR_INL_H
#endif

#include "convex/hull/placed_xyz-inl.h"
#include "convex/search/voronoi_marching.h"
#include "geometry/nearest-inl.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using XyzTriangle = std::array<Xyz, 3>;

/// The corners of a feature that hold the closest point, as bits: bit 0 its vertex, bit 1 the end
/// of its edge, bit 2 the end of the next edge.
using Corners = std::uint32_t;

/// The closest points of two features, and the corners that hold them.
struct Measured {
    Xyz point_a, gap;
    double distance_sq = std::numeric_limits<double>::infinity();
    Corners a = 1, b = 1;
    /// The square of a length s: an edge's length or a triangle's height. Rounding of the corners
    /// by e turns the gap between the features' lines or planes by at most about e / s. 0: not
    /// known. kOfEdges: to be computed by spread_of_edges.
    double spread_sq = std::numeric_limits<double>::infinity();
};

inline constexpr double kOfEdges = -1;

/// What is known of two edges once they are measured: the second one as a vector, and squares.
struct EdgePair {
    Xyz v;
    EdgeSquares squares;
};

HWY_INLINE Measured turned(const Measured& m) {
    return {m.point_a + m.gap, -m.gap, m.distance_sq, m.b, m.a, m.spread_sq};
}

HWY_INLINE Measured measured(const Xyz& point_a, const Xyz& gap, Corners a, Corners b,
                             double spread_sq = std::numeric_limits<double>::infinity()) {
    return {point_a, gap, length_sq(gap), a, b, spread_sq};
}

/// Measures the segment from p0 to p1, of a, and the point q, of b.
HWY_INLINE Measured measure_edge_vertex(const Xyz& p0, const Xyz& p1, const Xyz& q) {
    const Xyz u = p1 - p0, w = q - p0;
    const double along = dot(w, u), all = length_sq(u);
    if (!(along > 0))
        return measured(p0, w, 1, 1);
    if (along >= all)
        return measured(p1, q - p1, 2, 1);
    const Xyz foot = (along / all) * u;
    return measured(p0 + foot, w - foot, 3, 1, all);
}

HWY_INLINE Corners corners_at(double parameter) {
    return parameter <= 0 ? 1 : parameter >= 1 ? 2 : 3;
}

/// Measured::spread_sq of two edges, from those that have the closest point inside. 0 (not known)
/// if the gap is not perpendicular to both to rounding, or if they are almost parallel.
///
/// In          closest points as nearest_on_segments returns them.
HWY_INLINE double spread_of_edges(const EdgePair& edges, const Xyz& gap, double gap_sq,
                                  Corners on_u, Corners on_v) {
    const auto& [v, squares] = edges;
    const auto [uu, vv, nn] = squares;
    // The point on u was computed last, and so corrects the error of the point on v.
    if (on_v != 3)
        return on_u == 3 ? uu : std::numeric_limits<double>::infinity();
    const double along = dot(gap, v);
    if (!(along * along <= 0x1p-98 * (gap_sq + uu + vv) * vv))
        return 0;
    if (on_u != 3)
        return vv;
    return nn >= 0x1p-8 * uu * vv ? nn / std::max(uu, vv) : 0;
}

/// Out         `edges`: for spread_of_edges.
HWY_INLINE Measured measure_edge_edge(const Xyz& p0, const Xyz& p1, const Xyz& q0, const Xyz& q1,
                                      EdgePair& edges) {
    const Xyz u = p1 - p0, v = q1 - q0, r = q0 - p0;
    const SegmentPoints c = nearest_on_segments(u, v, r, edges.squares);
    edges.v = v;
    const Xyz from = c.s * u, gap = r + c.t * v - from;
    return {p0 + from, gap, c.distance_sq, corners_at(c.s), corners_at(c.t), kOfEdges};
}

/// The corners of a triangle that have weight at a foot.
HWY_INLINE Corners corners_of(const Foot<Xyz>& foot) {
    const Corners corners =
        (1 - foot.g - foot.h > 0 ? 1U : 0U) | (foot.g > 0 ? 2U : 0U) | (foot.h > 0 ? 4U : 0U);
    return (corners << foot.first | corners >> (3 - foot.first)) & 7U;
}

/// kEdgeCorners[k][c]: the triangle's corners that the corners c of its edge k are.
constexpr Corners kEdgeCorners[3][4] = {{0, 1, 2, 3}, {0, 2, 4, 6}, {0, 4, 1, 5}};

/// Measures a triangle of a and a point of b whose foot lies outside the triangle.
inline HWY_NOINLINE void measure_border_vertex(const XyzTriangle& t, const Xyz& q,
                                               Measured& nearest) {
    nearest.distance_sq = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Measured m = measure_edge_vertex(t[k], t[(k + 1) % 3], q);
        if (!(m.distance_sq < nearest.distance_sq))
            continue;
        nearest = m;
        nearest.a = kEdgeCorners[k][m.a];
    }
}

/// Measures a triangle of a and a point of b.
HWY_INLINE Measured measure_face_vertex(const XyzTriangle& t, const Xyz& q) {
    const Foot<Xyz> foot = foot_on(q, t);
    if (foot.within)
        return measured(foot.point, foot.gap, corners_of(foot), 1, foot.height_sq());
    Measured nearest;
    measure_border_vertex(t, q, nearest);
    return nearest;
}

/// The segment runs from q0 to q1, on b.
inline HWY_NOINLINE void measure_face_edge(const XyzTriangle& t, const Xyz& q0, const Xyz& q1,
                                           Measured& nearest) {
    const Xyz normal = cross(t[1] - t[0], t[2] - t[0]);
    const double h0 = dot(normal, q0 - t[0]), h1 = dot(normal, q1 - t[0]);
    const bool pierces_plane = (h0 > 0) != (h1 > 0);
    if (pierces_plane) {
        const Xyz crossing = q0 + (h0 / (h0 - h1)) * (q1 - q0);
        if (foot_on(crossing, t).within) {
            nearest = {crossing, {}, 0, 7, 3, 0};
            return;
        }
    }
    nearest.distance_sq = std::numeric_limits<double>::infinity();
    const auto take = [&](const Measured& m) HWY_ATTR {
        if (m.distance_sq < nearest.distance_sq)
            nearest = m;
    };
    // Inside the triangle, only an end of the segment can be nearest. If the segment stays on one
    // side of the plane, only the end nearer to the plane can be, and nothing else is nearer then.
    const bool first_is_nearer = std::abs(h0) < std::abs(h1);
    if (const Foot<Xyz> foot = foot_on(first_is_nearer ? q0 : q1, t); foot.within) {
        take(measured(foot.point, foot.gap, corners_of(foot), first_is_nearer ? 1 : 2,
                      foot.height_sq()));
        if (!pierces_plane)
            return;
    }
    if (pierces_plane)
        if (const Foot<Xyz> foot = foot_on(first_is_nearer ? q1 : q0, t); foot.within)
            take(measured(foot.point, foot.gap, corners_of(foot), first_is_nearer ? 2 : 1,
                          foot.height_sq()));
    EdgePair nearest_edges;
    Corners on_edge = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        EdgePair edges;
        const Measured m = measure_edge_edge(t[k], t[(k + 1) % 3], q0, q1, edges);
        if (!(m.distance_sq < nearest.distance_sq))
            continue;
        nearest = m;
        nearest.a = kEdgeCorners[k][m.a];
        nearest_edges = edges, on_edge = m.a;
    }
    if (nearest.spread_sq == kOfEdges)
        nearest.spread_sq =
            spread_of_edges(nearest_edges, nearest.gap, nearest.distance_sq, on_edge, nearest.b);
}

HWY_INLINE Xyz corner0(const PlacedXyz& side, const HullFeature& f) {
    return side.vertex(f.vertex);
}
HWY_INLINE Xyz corner1(const PlacedXyz& side, const HullFeature& f) {
    return side.place(side.polytope().to(f.edge));
}
HWY_INLINE XyzTriangle triangle(const PlacedXyz& side, const HullFeature& f) {
    const Polytope& p = side.polytope();
    return {corner0(side, f), corner1(side, f),
            side.place(p.to(p.after(p.vertices[f.vertex], f.edge)))};
}

/// In          any two features except two triangles.
/// Out         `edges`: set if both are edges. Their spread is left to the caller, since a walk
///             needs only that of its last pair.
HWY_INLINE Measured measure(const PlacedXyz& side_a, const PlacedXyz& side_b, const HullFeature& a,
                            const HullFeature& b, EdgePair& edges) {
    switch (3 * static_cast<int>(a.kind) + static_cast<int>(b.kind)) {
    case 0: {
        const Xyz p = corner0(side_a, a);
        return measured(p, corner0(side_b, b) - p, 1, 1);
    }
    case 1:
        return turned(
            measure_edge_vertex(corner0(side_b, b), corner1(side_b, b), corner0(side_a, a)));
    case 2:
        return turned(measure_face_vertex(triangle(side_b, b), corner0(side_a, a)));
    case 3:
        return measure_edge_vertex(corner0(side_a, a), corner1(side_a, a), corner0(side_b, b));
    case 4:
        return measure_edge_edge(corner0(side_a, a), corner1(side_a, a), corner0(side_b, b),
                                 corner1(side_b, b), edges);
    case 5: {
        Measured nearest;
        measure_face_edge(triangle(side_b, b), corner0(side_a, a), corner1(side_a, a), nearest);
        return turned(nearest);
    }
    case 6:
        return measure_face_vertex(triangle(side_a, a), corner0(side_b, b));
    default: {
        Measured nearest;
        measure_face_edge(triangle(side_a, a), corner0(side_b, b), corner1(side_b, b), nearest);
        return nearest;
    }
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
