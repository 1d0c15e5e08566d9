#include "geometry/triangle_triangle_intersect.h"

#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace abut {

namespace {

using Signs = std::array<int, 3>;

/// Sides of the plane of `plane` that the vertices of t lie on. One normal serves all three
/// filters.
Signs plane_sides(const Triangle& plane, const Triangle& t) {
    const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0];
    const Vec3 n = cross(u, v);
    const auto largest = [](const Vec3& p) {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    };
    const double edge = std::max(largest(u), largest(v));
    Signs signs{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 w = t[i] - plane[0];
        const double side = dot(n, w), reach = largest(w);
        // The bound of triangle_block.cpp, Sides; underflow included.
        const double bound = 32 * 0x1p-53 * edge * edge * reach + 0x1p-1000 * (reach + 1);
        signs[i] = side > bound    ? 1
                   : side < -bound ? -1
                                   : orient3d(plane[0], plane[1], plane[2], t[i]);
    }
    return signs;
}

bool strictly_one_side(const Signs& s) {
    return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
}
bool all_zero(const Signs& s) {
    return s[0] == 0 && s[1] == 0 && s[2] == 0;
}
bool straddles(const Signs& s) {
    return (s[0] > 0 || s[1] > 0 || s[2] > 0) && (s[0] < 0 || s[1] < 0 || s[2] < 0);
}

/// A triangle cut by a plane: both edges from the apex meet the plane.
struct Cut {
    const Vec3 *apex, *left, *right; ///< in the triangle's own cyclic order
    int side;                        ///< of the apex as seen from the base: +1 or -1
};

Cut cut(const Triangle& t, const Signs& s) {
    // The apex is a vertex whose sign the others lack, they not being on opposite sides themselves.
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        if (s[i] != s[j] && s[i] != s[k] && s[j] * s[k] >= 0)
            return {&t[i], &t[j], &t[k], s[i] != 0 ? s[i] : -(s[j] + s[k])};
    }
    return {}; // not reached: the signs are neither all equal nor all zero
}

/// A collinear triangle's end points: of points on one line, the least and the greatest.
std::array<Vec3, 2> end_points(const Triangle& t) {
    const auto less = [](const Vec3& p, const Vec3& q) {
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    const auto [least, greatest] = std::minmax({t[0], t[1], t[2]}, less);
    return {least, greatest};
}

bool segments_intersect_2d(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, int axis) {
    const int pqr = orient2d(p, q, r, axis), pqs = orient2d(p, q, s, axis);
    const int rsp = orient2d(r, s, p, axis), rsq = orient2d(r, s, q, axis);
    if (pqr == 0 && pqs == 0 && rsp == 0 && rsq == 0) {
        Box3 a, b;
        extend(a, p), extend(a, q), extend(b, r), extend(b, s);
        return overlap(a, b);
    }
    return pqr * pqs <= 0 && rsp * rsq <= 0;
}

bool contains_2d(const Triangle& t, const Vec3& p, int axis) {
    const int u = orient2d(t[0], t[1], p, axis), v = orient2d(t[1], t[2], p, axis),
              w = orient2d(t[2], t[0], p, axis);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Whether an edge of `a` has all of `b` strictly on its outer side; `winding` is the sign of a's
/// projection.
bool edge_separates_2d(const Triangle& a, int winding, const Triangle& b, int axis) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &p = a[i], &q = a[(i + 1) % 3];
        if (orient2d(p, q, b[0], axis) * winding < 0 && orient2d(p, q, b[1], axis) * winding < 0 &&
            orient2d(p, q, b[2], axis) * winding < 0)
            return true;
    }
    return false;
}

bool coplanar_intersect(const Triangle& a, const Triangle& b) {
    const int axis = projection_axis(a);
    const int winding_a = orient2d(a[0], a[1], a[2], axis);
    const int winding_b = orient2d(b[0], b[1], b[2], axis);
    return !edge_separates_2d(a, winding_a, b, axis) && !edge_separates_2d(b, winding_b, a, axis);
}

} // namespace

int projection_axis(const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const int largest = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    for (int i = 0; i < 3; ++i) {
        const int axis = (largest + i) % 3;
        if (orient2d(t[0], t[1], t[2], axis) != 0)
            return axis;
    }
    return -1;
}

bool segment_segment_intersect(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    if (orient3d(p, q, r, s) != 0)
        return false;
    // One plane holds all four. Project along an axis on which that plane does not become a line.
    for (const Triangle& t :
         {Triangle{p, q, r}, Triangle{p, q, s}, Triangle{r, s, p}, Triangle{r, s, q}})
        if (const int axis = projection_axis(t); axis >= 0)
            return segments_intersect_2d(p, q, r, s, axis);
    return segments_intersect_2d(p, q, r, s,
                                 0); // all on one line: every axis gives the interval test
}

bool segment_triangle_intersect(const Vec3& p, const Vec3& q, const Triangle& t) {
    const int side_p = orient3d(t[0], t[1], t[2], p), side_q = orient3d(t[0], t[1], t[2], q);
    if (side_p * side_q > 0)
        return false;
    if (side_p == 0 && side_q == 0) {
        const int axis = projection_axis(t);
        return contains_2d(t, p, axis) || segments_intersect_2d(p, q, t[0], t[1], axis) ||
               segments_intersect_2d(p, q, t[1], t[2], axis) ||
               segments_intersect_2d(p, q, t[2], t[0], axis);
    }
    // The line meets the plane in one point: it lies within if the edges all turn the same way
    // around the line.
    const int u = orient3d(p, q, t[0], t[1]), v = orient3d(p, q, t[1], t[2]),
              w = orient3d(p, q, t[2], t[0]);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

TriangleContact triangle_triangle_intersect(const Triangle& a, const Triangle& b) {
    const Signs b_sides = plane_sides(a, b);
    if (strictly_one_side(b_sides))
        return TriangleContact::none;
    const Signs a_sides = plane_sides(b, a);
    if (strictly_one_side(a_sides))
        return TriangleContact::none;

    if (all_zero(a_sides) || all_zero(b_sides)) {
        const bool a_flat = collinear(a[0], a[1], a[2]), b_flat = collinear(b[0], b[1], b[2]);
        bool meet = false;
        if (a_flat && b_flat) {
            const auto [p, q] = end_points(a);
            const auto [r, s] = end_points(b);
            meet = segment_segment_intersect(p, q, r, s);
        } else if (a_flat || b_flat) {
            const auto [p, q] = end_points(a_flat ? a : b);
            meet = segment_triangle_intersect(p, q, a_flat ? b : a);
        } else {
            meet = coplanar_intersect(a, b);
        }
        return meet ? TriangleContact::touch : TriangleContact::none;
    }

    // Both planes cut both triangles: compare their intervals on the common line, directed along
    // n_a x n_b. There, the edge from a's apex comes before the edge from b's apex if
    //     side_a side_b orient3d(apex_a, end_a, apex_b, end_b) > 0,
    // and the cyclic order of each triangle tells which of its two edges comes first.
    const Cut ca = cut(a, a_sides), cb = cut(b, b_sides);
    const Vec3 &a_first = ca.side > 0 ? *ca.right : *ca.left,
               &a_last = ca.side > 0 ? *ca.left : *ca.right;
    const Vec3 &b_first = cb.side > 0 ? *cb.left : *cb.right,
               &b_last = cb.side > 0 ? *cb.right : *cb.left;
    const int sides = ca.side * cb.side;
    const int a_before_b = sides * orient3d(*ca.apex, a_last, *cb.apex, b_first);
    if (a_before_b > 0)
        return TriangleContact::none;
    const int a_to_b = sides * orient3d(*ca.apex, a_first, *cb.apex, b_last);
    if (a_to_b < 0)
        return TriangleContact::none;
    const bool cross = a_before_b < 0 && a_to_b > 0 && straddles(a_sides) && straddles(b_sides);
    return cross ? TriangleContact::cross : TriangleContact::touch;
}

} // namespace abut
