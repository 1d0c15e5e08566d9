#include "geometry/triangle_triangle_intersect.h"

#include "geometry/triangle_planes.h"
#include "math/predicates.h"

#include <cmath>

namespace abut {

namespace {

using namespace triangle_planes;

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

/// Whether an edge of `a` has all of `b` strictly on its outer side. `winding` is the sign of a's
/// projected area.
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
    // One plane holds all four points. Project along an axis on which that plane does not become a
    // line.
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
    // The line meets the plane in one point. It lies within the triangle if all edges turn the same
    // way around the line.
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

    // Both planes cut both triangles: compare their intervals on the common line.
    const LineIntervals line = line_intervals(a, a_sides, b, b_sides);
    const int a_before_b = line.before(line.a_last, line.b_first);
    if (a_before_b > 0)
        return TriangleContact::none;
    const int a_to_b = line.before(line.a_first, line.b_last);
    if (a_to_b < 0)
        return TriangleContact::none;
    const bool cross = a_before_b < 0 && a_to_b > 0 && straddles(a_sides) && straddles(b_sides);
    return cross ? TriangleContact::cross : TriangleContact::touch;
}

} // namespace abut
