#include "convex/search/shallow_depth.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convex/search/shallow_depth.cpp"
#include "simd/foreach_target.h"
#include "convex/hull/placed_xyz-inl.h"
#include "convex/search/neighbours-inl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// A face of the difference: a triangle of one body and a vertex of the other, or a parallelogram
/// of two edges. Counter-clockwise as seen from outside.
struct DifferenceFace {
    std::array<Xyz, 4> at;
    std::array<VertexPair, 4> vertices;
    std::uint32_t count = 0;
    Xyz normal;             ///< unit vector
    double height = 0;      ///< the least of its corners' heights along the normal
    double unevenness = 0;  ///< by how much these heights differ
    double thinness_sq = 0; ///< the square of the least height of a triangle of it
    double inradius = 0;    ///< the least distance of the foot from an edge; not above 0: outside
};

HWY_INLINE std::array<std::uint32_t, 3> vertices_of(const Polytope& p, const HullFeature& f) {
    if (f.kind == Feature::vertex)
        return {f.vertex, f.vertex, f.vertex};
    const std::uint32_t next =
        f.kind == Feature::face ? p.target(p.after(p.vertices[f.vertex], f.edge)) : f.vertex;
    return {f.vertex, p.target(f.edge), next};
}

/// Returns whether two features span a face of a difference.
inline bool span_face(const HullFeature& a, const HullFeature& b) {
    return static_cast<int>(a.kind) + static_cast<int>(b.kind) == 2;
}

/// Sets all of `face` but its inradius. False if it has no area.
///
/// In          features that span a face; `inside`: a point inside the difference.
HWY_INLINE bool make_face(const PlacedXyz& side_a, const PlacedXyz& side_b, const HullFeature& a,
                          const HullFeature& b, const Xyz& inside, DifferenceFace& face) {
    const auto va = vertices_of(side_a.polytope(), a), vb = vertices_of(side_b.polytope(), b);
    const Xyz a0 = side_a.vertex(va[0]), b0 = side_b.vertex(vb[0]);
    if (a.kind == Feature::edge) {
        const Xyz a1 = side_a.vertex(va[1]), b1 = side_b.vertex(vb[1]);
        face.at = {b0 - a0, b1 - a0, b1 - a1, b0 - a1};
        face.vertices = {VertexPair{va[0], vb[0]}, {va[0], vb[1]}, {va[1], vb[1]}, {va[1], vb[0]}};
        face.count = 4;
    } else if (a.kind == Feature::face) {
        face.at = {b0 - a0, b0 - side_a.vertex(va[1]), b0 - side_a.vertex(va[2]), {}};
        face.vertices = {VertexPair{va[0], vb[0]}, {va[1], vb[0]}, {va[2], vb[0]}, {}};
        face.count = 3;
    } else {
        face.at = {b0 - a0, side_b.vertex(vb[1]) - a0, side_b.vertex(vb[2]) - a0, {}};
        face.vertices = {VertexPair{va[0], vb[0]}, {va[0], vb[1]}, {va[0], vb[2]}, {}};
        face.count = 3;
    }
    const Xyz u = face.at[1] - face.at[0], v = face.at[2] - face.at[0], w = face.at[2] - face.at[1];
    Xyz normal = cross(u, v);
    const double sq = length_sq(normal);
    if (!(sq > 0))
        return false;
    face.thinness_sq = sq / std::max({length_sq(u), length_sq(v), length_sq(w)});
    if (dot(normal, face.at[0] - inside) < 0) {
        normal = -normal;
        std::swap(face.at[1], face.at[face.count - 1]);
        std::swap(face.vertices[1], face.vertices[face.count - 1]);
    }
    face.normal = (1 / std::sqrt(sq)) * normal;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::uint32_t i = 0; i < face.count; ++i) {
        const double h = dot(face.normal, face.at[i]);
        least = std::min(least, h), most = std::max(most, h);
    }
    face.height = least, face.unevenness = most - least;
    return true;
}

/// Sets the face's inradius and, if the foot lies inside, the nearest point's corners and weights.
HWY_INLINE void measure_foot(DifferenceFace& face, NearestBoundary& nearest) {
    std::array<double, 4> areas{};
    double least_sq = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (std::uint32_t i = 0; i < face.count; ++i) {
        const Xyz& p = face.at[i];
        const Xyz edge = face.at[i + 1 == face.count ? 0 : i + 1] - p;
        // (n x e) . (h n - p)
        areas[i] = dot(cross(edge, face.normal), p);
        inside = inside && areas[i] > 0;
        least_sq = std::min(least_sq, areas[i] * areas[i] / length_sq(edge));
    }
    face.inradius = inside ? std::sqrt(least_sq) : 0;
    if (!inside)
        return;
    std::array<std::uint32_t, 3> corners{0, 1, 2};
    std::array<double, 3> weights{areas[1], areas[2], areas[0]};
    if (face.count == 4) {
        const double across = dot(cross(face.at[2] - face.at[0], face.normal), face.at[0]);
        if (across > 0)
            corners = {0, 2, 3}, weights = {areas[2], areas[3], across};
        else
            weights = {areas[1], -across, areas[0]};
    }
    const double share = 1 / (weights[0] + weights[1] + weights[2]);
    for (std::size_t k = 0; k < 3; ++k) {
        nearest.corners[k] = face.vertices[corners[k]];
        nearest.weights[k] = share * weights[k];
    }
}

/// Returns whether the difference holds the ball around the origin that touches the face at its
/// foot. The hull of two things lies in the difference: the face's disc around the foot, and the
/// inner ball.
///
/// Let h be the face's distance, e the disc's radius, and p the angle of a direction to the normal.
/// Along it the ball around the origin reaches h, and the disc reaches h cos p + e sin p, which is
/// no less as long as tan(p / 2) <= e / h. At the angle where that ends, the inner ball must reach
/// farther. From there on it reaches farther and farther, if that angle is not below the angle at
/// which the inner ball reaches least.
HWY_INLINE bool covers(const DifferenceFace& face, const DifferenceBall& ball, double rounding) {
    const double h = face.height + face.unevenness,
                 e = face.inradius * (1 - 0x1p-20) - 16 * rounding;
    const Xyz middle = to_xyz(ball.middle);
    const double below = -dot(face.normal, middle);
    const double aside = length(to_vec3(middle + below * face.normal));
    const double room = ball.radius * (1 - 0x1p-20) - h - 16 * rounding;
    // Otherwise products of three lengths may underflow or overflow.
    const bool is_usual = std::min({h, e, below, room}) > 0x1p-200 && below + aside < 0x1p200;
    const double hh = h * h, ee = e * e, he = 2 * h * e;
    return is_usual && std::min(h, e) > 0x1p10 * rounding && aside * (hh - ee) <= below * he &&
           below * (hh - ee) + aside * he <= room * (hh + ee);
}

enum class FaceTest : std::uint8_t { none, outside, found };

/// Measures the face that two features span, if it is one of the difference.
HWY_INLINE FaceTest test_face(const PlacedXyz& side_a, const PlacedXyz& side_b,
                              const DifferenceBall& ball, double rounding, double all_rounding,
                              const HullFeature& a, const HullFeature& b, DifferenceFace& face,
                              NearestBoundary& nearest) {
    if (!make_face(side_a, side_b, a, b, to_xyz(ball.middle), face))
        return FaceTest::none;
    measure_foot(face, nearest);
    const double behind_a = excess_along(side_a, a, -face.normal),
                 behind_b = excess_along(side_b, b, face.normal);
    // A triangle has neighbours behind it, unless its body is flat or on its other side.
    const double most_a = a.kind == Feature::face ? -rounding : rounding,
                 most_b = b.kind == Feature::face ? -rounding : rounding;
    if (behind_a > most_a || behind_b > most_b)
        return FaceTest::none;
    if (!(face.inradius > 0))
        return FaceTest::outside;
    nearest.normal = to_vec3(face.normal);
    nearest.depth = face.height + face.unevenness;
    nearest.at_least = face.height - 4 * all_rounding;
    const double rounding_sq = rounding * rounding,
                 least_behind = 0x1p118 * rounding_sq * rounding_sq;
    nearest.is_depth_proven = least_behind > 0x1p-900 && behind_a < 0 && behind_b < 0 &&
                              behind_a * behind_a * face.thinness_sq >= least_behind &&
                              behind_b * behind_b * face.thinness_sq >= least_behind;
    nearest.is_inside_proven = nearest.at_least > 0 && face.unevenness <= 2 * all_rounding &&
                               covers(face, ball, all_rounding);
    return FaceTest::found;
}

void find_face(const PolytopePair& pair, const DifferenceBall& ball, double rounding, Vec3 outward,
               double height, bool again, ShallowSearch& search, NearestBoundary& nearest) {
    constexpr std::uint32_t kMostWalks = 8, kMostPairs = 64;
    const PlacedXyz side_a(pair.a), side_b(pair.b);
    const double all_rounding = rounding + world_rounding(pair);
    DifferenceFace face;
    double beyond = 0x1p-6 * length(ball.middle);
    if (again) {
        if (test_face(side_a, side_b, ball, rounding, all_rounding, search.a, search.b, face,
                      nearest) == FaceTest::found) {
            search.is_face = true;
            return;
        }
        outward = to_vec3(face.normal), height = face.height;
    }
    PolytopePair moved = pair;
    WalkState at;
    at.a = search.a, at.b = search.b;
    at.feature_pairs = 0;
    for (std::uint32_t i = 0; i < kMostWalks && height > -beyond; ++i) {
        const double by = height + beyond;
        moved.b.offset = pair.b.offset - by * outward;
        walk(moved, rounding, kMostPairs, at);
        search.feature_pairs = at.feature_pairs;
        if (at.end != WalkEnd::closest)
            return;
        search.a = at.a, search.b = at.b;
        if (span_face(at.a, at.b)) {
            const FaceTest test =
                test_face(side_a, side_b, ball, rounding, all_rounding, at.a, at.b, face, nearest);
            if (test == FaceTest::found) {
                search.is_face = true;
                return;
            }
            outward = to_vec3(face.normal), height = face.height;
        } else {
            const Vec3 point = at.gap + by * outward;
            outward = (-1 / std::sqrt(at.distance_sq)) * at.gap;
            height = dot(point, outward);
        }
        beyond = 0.25 * std::abs(height) + 0x1p20 * rounding;
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_face);

void find_shallow_depth(const PolytopePair& pair, const DifferenceBall& ball, double rounding,
                        const Vec3& outward, double height, ShallowSearch& search,
                        NearestBoundary& nearest) {
    HWY_DYNAMIC_DISPATCH(find_face)(pair, ball, rounding, outward, height, false, search, nearest);
}

void find_shallow_depth_again(const PolytopePair& pair, const DifferenceBall& ball, double rounding,
                              ShallowSearch& search, NearestBoundary& nearest) {
    HWY_DYNAMIC_DISPATCH(find_face)(pair, ball, rounding, {}, 0, true, search, nearest);
}

} // namespace abut
#endif
