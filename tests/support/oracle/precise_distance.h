#pragma once

#include "math/vector.h"
#include "tests/support/oracle/exact_oracle.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

/// Distances to 100 digits, by trying all pairs of faces of both convex sets. For each pair, a
/// linear system gives the nearest points of the affine hulls (Cramer's rule). They count if they
/// lie within the faces. There is no clamping and no order of cases.
namespace abut::test {

using Precise = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                              boost::multiprecision::et_off>;
using PrecisePoint = std::array<Precise, 3>;

inline PrecisePoint precise(const Vec3& p) {
    return {Precise(p.x), Precise(p.y), Precise(p.z)};
}
inline PrecisePoint operator-(const PrecisePoint& a, const PrecisePoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Precise dot(const PrecisePoint& a, const PrecisePoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline void keep_least(Precise& best, const Precise& v) {
    if (v < best)
        best = v;
}
inline bool in_unit(const Precise& v) {
    return v >= 0 && v <= 1;
}

/// Keeps the squared norm of r + s u + t v at its stationary point, if the system is regular and
/// `inside` holds.
template <typename Inside>
void try_stationary(Precise& best, const PrecisePoint& r, const PrecisePoint& u,
                    const PrecisePoint& v, const Inside& inside) {
    const Precise uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ru = dot(r, u), rv = dot(r, v);
    const Precise det = uu * vv - uv * uv;
    if (det == 0)
        return;
    const Precise s = (uv * rv - vv * ru) / det, t = (uv * ru - uu * rv) / det;
    if (inside(s, t)) {
        const PrecisePoint g{r[0] + s * u[0] + t * v[0], r[1] + s * u[1] + t * v[1],
                             r[2] + s * u[2] + t * v[2]};
        keep_least(best, dot(g, g));
    }
}

inline Precise point_segment_sq(const PrecisePoint& p, const PrecisePoint& q0,
                                const PrecisePoint& q1) {
    const PrecisePoint v = q1 - q0, w = p - q0;
    Precise best = dot(w, w);
    keep_least(best, dot(p - q1, p - q1));
    if (const Precise vv = dot(v, v); vv > 0)
        if (const Precise t = dot(w, v) / vv; in_unit(t))
            keep_least(best, dot(w, w) - t * dot(w, v));
    return best;
}

inline Precise segment_segment_sq(const PrecisePoint& p0, const PrecisePoint& p1,
                                  const PrecisePoint& q0, const PrecisePoint& q1) {
    Precise best = point_segment_sq(p0, q0, q1);
    keep_least(best, point_segment_sq(p1, q0, q1));
    keep_least(best, point_segment_sq(q0, p0, p1));
    keep_least(best, point_segment_sq(q1, p0, p1));
    try_stationary(best, p0 - q0, p1 - p0, q0 - q1,
                   [](const Precise& s, const Precise& t) { return in_unit(s) && in_unit(t); });
    return best;
}

using PreciseTriangle = std::array<PrecisePoint, 3>;
inline PreciseTriangle precise(const Triangle& t) {
    return {precise(t[0]), precise(t[1]), precise(t[2])};
}

inline void keep_foot(Precise& best, const PrecisePoint& p, const PreciseTriangle& t) {
    try_stationary(
        best, t[0] - p, t[1] - t[0], t[2] - t[0],
        [](const Precise& g, const Precise& h) { return g >= 0 && h >= 0 && g + h <= 1; });
}

inline Precise precise_root(const Precise& square) {
    return square > 0 ? Precise(boost::multiprecision::sqrt(square)) : Precise(0);
}

inline Precise precise_distance(const Vec3& p, const Triangle& triangle) {
    const PrecisePoint q = precise(p);
    const PreciseTriangle t = precise(triangle);
    Precise best = point_segment_sq(q, t[0], t[1]);
    keep_least(best, point_segment_sq(q, t[1], t[2]));
    keep_least(best, point_segment_sq(q, t[2], t[0]));
    keep_foot(best, q, t);
    return precise_root(best);
}

/// The distance of the boundaries and of vertex-face pairs only. Crossing triangles are not
/// considered.
inline Precise precise_boundary_distance(const Triangle& triangle_a, const Triangle& triangle_b) {
    const PreciseTriangle a = precise(triangle_a), b = precise(triangle_b);
    Precise best = segment_segment_sq(a[0], a[1], b[0], b[1]);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            keep_least(best, segment_segment_sq(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
        keep_foot(best, a[i], b);
        keep_foot(best, b[i], a);
    }
    return precise_root(best);
}

inline Precise precise_distance(const Triangle& a, const Triangle& b) {
    return oracle_meet<AnyInt>(a, b) ? Precise(0) : precise_boundary_distance(a, b);
}

} // namespace abut::test
