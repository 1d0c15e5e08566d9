// Foot of a point on a triangle, and closest points of segments. Templates: for Vec3, and for Xyz
// (a vector in one register) where that is faster.

// Included once for each target.
#if defined(ABUT_GEOMETRY_NEAREST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_GEOMETRY_NEAREST_INL_H
#undef ABUT_GEOMETRY_NEAREST_INL_H
#else
#define ABUT_GEOMETRY_NEAREST_INL_H
#endif

#include "geometry/triangle_triangle_distance.h"
#include "math/xyz-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

HWY_INLINE Vec3 choose(bool first, const Vec3& a, const Vec3& b) {
    return first ? a : b;
}

/// Foot of a point on the plane of a triangle. If it lies within the triangle, its weights are g
/// and h at the two corners after `first`, and 1 - g - h at `first`.
template <class V>
struct Foot {
    bool within = false;
    std::size_t first = 0;
    double g = 0, h = 0;
    V point, gap;          ///< gap: from the foot to the point
    double nn = 0, uu = 1; ///< squares of twice the triangle's area and of its longest edge

    /// The square of the triangle's smallest height.
    [[nodiscard]] HWY_INLINE double height_sq() const { return nn / uu; }
};

/// See foot_within in geometry/point_triangle_distance.h.
template <class V>
HWY_INLINE Foot<V> foot_on(const V& p, const std::array<V, 3>& t) {
    // Works along the longest edge u: there, a needle's foot is well determined whatever its width.
    const V e0 = t[1] - t[0], e1 = t[2] - t[1], e2 = t[0] - t[2];
    const double sq0 = length_sq(e0), sq1 = length_sq(e1), sq2 = length_sq(e2);
    const bool is_1 = sq1 > sq0;
    const bool is_2 = sq2 > (is_1 ? sq1 : sq0);
    const double uu = is_2 ? sq2 : is_1 ? sq1 : sq0;
    const V origin = choose(is_2, t[2], choose(is_1, t[1], t[0]));
    const V u = choose(is_2, e2, choose(is_1, e1, e0));
    const V v = -choose(is_2, e1, choose(is_1, e0, e2));
    const V w = p - origin;
    const V n = cross(u, v);
    const double nn = length_sq(n), along = dot(cross(u, w), n);
    Foot<V> foot;
    if (!(nn > 0 && along >= 0 && along <= nn))
        return foot;
    // h = (u x w) . n / n.n, and the best g for that h: g compensates for the error of h.
    const double h = along / nn, g = dot(w - h * v, u) / uu;
    if (!(g >= 0 && g + h <= 1))
        return foot;
    const V from_origin = g * u + h * v;
    foot.within = true;
    foot.first = is_2 ? 2 : is_1 ? 1 : 0;
    foot.g = g, foot.h = h, foot.nn = nn, foot.uu = uu;
    foot.point = origin + from_origin, foot.gap = w - from_origin;
    return foot;
}

/// Squared lengths of two edges and of their cross product.
struct EdgeSquares {
    double uu = 0, vv = 0, nn = 0;
};

/// See geometry/triangle_triangle_distance.h.
///
/// Out         `squares`: of u and v.
template <class V>
HWY_INLINE SegmentPoints nearest_on_segments(const V& u, const V& v, const V& r,
                                             EdgeSquares& squares) {
    const auto clamp01 = [](double x) HWY_ATTR { return std::min(std::max(x, 0.0), 1.0); };
    const double uu = length_sq(u), vv = length_sq(v), uv = dot(u, v);
    const V n = cross(u, v);
    const double nn = length_sq(n);
    // First s for the two lines: s = (r x v) . n / n.n. Then the best t for that s, and the best s
    // for that t.
    double s = nn > 0 ? clamp01(dot(cross(r, v), n) / nn) : 0;
    const double t = vv > 0 ? clamp01((s * uv - dot(r, v)) / vv) : 0;
    s = uu > 0 ? clamp01((t * uv + dot(r, u)) / uu) : 0;
    squares.uu = uu, squares.vv = vv, squares.nn = nn;
    return {s, t, length_sq(r - s * u + t * v)};
}

template <class V>
HWY_INLINE SegmentPoints nearest_on_segments(const V& u, const V& v, const V& r) {
    EdgeSquares squares;
    return nearest_on_segments(u, v, r, squares);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
