#include "geometry/triangle_triangle_segment.h"

#include "geometry/triangle_planes.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <tuple>

namespace abut {

namespace {

using namespace triangle_planes;

/// Exact for determinants of doubles within 2^100 of each other; beyond that, its error is far
/// below any rounding of doubles.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

template <typename Real>
struct Vector {
    Real x, y, z;
    Vector(const Vec3& from, const Vec3& to)
        : x(Real(to.x) - Real(from.x)), y(Real(to.y) - Real(from.y)), z(Real(to.z) - Real(from.z)) {
    }
};

/// Something that an edge is cut by: the plane of a triangle, or, in a projection along an axis,
/// the line through p and q.
class Cutter {
public:
    explicit Cutter(const Triangle& plane) : p_(plane[0]), q_(plane[1]), r_(plane[2]) {}
    Cutter(const Vec3& p, const Vec3& q, int axis) : p_(p), q_(q), axis_(axis) {}

    /// Proportional to the signed distance of `point`.
    template <typename Real>
    [[nodiscard]] Real side(const Vec3& point) const {
        const Vector<Real> u(p_, q_), w(p_, point);
        if (axis_ == 0)
            return u.y * w.z - u.z * w.y;
        if (axis_ == 1)
            return u.z * w.x - u.x * w.z;
        if (axis_ == 2)
            return u.x * w.y - u.y * w.x;
        const Vector<Real> v(p_, r_);
        return (u.y * v.z - u.z * v.y) * w.x + (u.z * v.x - u.x * v.z) * w.y +
               (u.x * v.y - u.y * v.x) * w.z;
    }

    /// Upper bound on the error of side<double>(point), underflow included.
    [[nodiscard]] double side_error(const Vec3& point) const {
        const auto largest = [](const Vec3& d) {
            return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        };
        const double reach = largest(point - p_);
        double edge = largest(q_ - p_);
        if (axis_ < 0) {
            edge = std::max(edge, largest(r_ - p_));
            edge *= edge;
        }
        return 32 * 0x1p-53 * edge * reach + 0x1p-1000 * (reach + 1);
    }

private:
    Vec3 p_, q_, r_;
    int axis_ = -1; ///< -1: the plane through p, q, r
};

/// The point where the segment p q meets the cutter. In: p and q on different sides, or one of them
/// on it.
Vec3 cut_point(Vec3 p, Vec3 q, const Cutter& cutter) {
    // A fixed order, so that both triangles at an edge get the same point.
    if (std::tie(q.x, q.y, q.z) < std::tie(p.x, p.y, p.z))
        std::swap(p, q);
    auto side_p = cutter.side<double>(p), side_q = cutter.side<double>(q);
    const double error = cutter.side_error(p) + cutter.side_error(q);
    // False also if something overflows or underflows.
    const bool certain = error <= 0x1p-37 * std::abs(side_p - side_q) && side_p * side_q <= 0 &&
                         std::isfinite(side_p - side_q);
    if (!certain) {
        const auto wide_p = cutter.side<Wide>(p), wide_q = cutter.side<Wide>(q);
        const Wide scale = abs(wide_p) + abs(wide_q);
        if (scale == 0)
            return p;
        side_p = static_cast<double>(Wide(wide_p / scale));
        side_q = static_cast<double>(Wide(wide_q / scale));
    }
    return std::abs(side_p) <= std::abs(side_q) ? p + (side_p / (side_p - side_q)) * (q - p)
                                                : q + (side_q / (side_q - side_p)) * (p - q);
}

void add(Intersection& result, const Vec3& p) {
    const auto end = result.corners.begin() + result.count;
    if (result.count < result.corners.size() && std::find(result.corners.begin(), end, p) == end)
        result.corners[result.count++] = p;
}

/// The distinct corners of a triangle: two or one if it has no area.
using DistinctCorners = boost::container::static_vector<Vec3, 3>;

DistinctCorners corners_of(const Triangle& t) {
    if (!collinear(t[0], t[1], t[2]))
        return {t[0], t[1], t[2]};
    const auto [p, q] = end_points(t);
    return p == q ? DistinctCorners{p} : DistinctCorners{p, q};
}

/// Whether the corners' convex hull holds p. In: all points lie in one plane, whose projection
/// along the axis keeps its area.
bool holds(const DistinctCorners& c, const Vec3& p, int axis) {
    if (c.size() == 1)
        return p == c[0];
    if (c.size() == 2) {
        Box3 box;
        extend(box, c[0]), extend(box, c[1]);
        return collinear(c[0], c[1], p) && encloses(box, {p, p});
    }
    const int u = orient2d(c[0], c[1], p, axis), v = orient2d(c[1], c[2], p, axis),
              w = orient2d(c[2], c[0], p, axis);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// An axis along which the plane of all points keeps its area; any axis if they lie on one line.
int common_axis(const DistinctCorners& a, const DistinctCorners& b) {
    boost::container::static_vector<Vec3, 6> p(a.begin(), a.end());
    p.insert(p.end(), b.begin(), b.end());
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = i + 1; j < p.size(); ++j)
            for (std::size_t k = j + 1; k < p.size(); ++k)
                if (const int axis = projection_axis({p[i], p[j], p[k]}); axis >= 0)
                    return axis;
    return 0;
}

/// Sorts the corners around their mean: counter-clockwise as seen from the axis, or clockwise if
/// turn is -1.
void sort_around(Intersection& result, int axis, int turn) {
    Vec3 middle;
    for (std::uint32_t i = 0; i < result.count; ++i)
        middle = middle + (1.0 / result.count) * result.corners[i];
    std::array<double, 6> angle{};
    for (std::uint32_t i = 0; i < result.count; ++i) {
        const Vec3 d = result.corners[i] - middle;
        angle[i] = turn * std::atan2(component(d, (axis + 2) % 3), component(d, (axis + 1) % 3));
        for (std::uint32_t j = i; j > 0 && angle[j] < angle[j - 1]; --j) {
            std::swap(angle[j], angle[j - 1]);
            std::swap(result.corners[j], result.corners[j - 1]);
        }
    }
}

/// The common polygon of coplanar triangles. Each of its corners is a corner of one triangle within
/// the other, or a proper crossing of two edges.
Intersection coplanar_polygon(const Triangle& ta, const Triangle& tb) {
    const DistinctCorners a = corners_of(ta), b = corners_of(tb);
    Intersection result;
    if (a.size() == 2 && b.size() == 2 && orient3d(a[0], a[1], b[0], b[1]) != 0)
        return result; // two segments, skew
    const int axis = common_axis(a, b);
    for (const Vec3& p : a)
        if (holds(b, p, axis))
            add(result, p);
    for (const Vec3& p : b)
        if (holds(a, p, axis))
            add(result, p);
    const auto edges = [](const DistinctCorners& c) -> std::size_t {
        return c.size() == 2 ? 1 : c.size() == 3 ? 3 : 0;
    };
    for (std::size_t i = 0; i < edges(a); ++i)
        for (std::size_t j = 0; j < edges(b); ++j) {
            const Vec3 &p = a[i], &q = a[(i + 1) % a.size()];
            const Vec3 &r = b[j], &s = b[(j + 1) % b.size()];
            if (orient2d(p, q, r, axis) * orient2d(p, q, s, axis) < 0 &&
                orient2d(r, s, p, axis) * orient2d(r, s, q, axis) < 0)
                add(result, cut_point(p, q, Cutter(r, s, axis)));
        }
    if (result.count > 2)
        sort_around(result, axis, orient2d(ta[0], ta[1], ta[2], axis));
    return result;
}

/// The point that the segment p q shares with t. In: p q is not coplanar with t, which has an area.
Intersection segment_point(const Vec3& p, const Vec3& q, const Triangle& t) {
    Intersection result;
    if (!segment_triangle_intersect(p, q, t))
        return result;
    if (orient3d(t[0], t[1], t[2], p) == 0)
        add(result, p);
    else if (orient3d(t[0], t[1], t[2], q) == 0)
        add(result, q);
    else
        add(result, cut_point(p, q, Cutter(t)));
    return result;
}

/// An end of an interval: where the edge from the apex meets the other triangle's plane.
Vec3 interval_end(const Vec3& apex, const Vec3& end, const Triangle& triangle, const Signs& sides,
                  const Triangle& plane) {
    const auto on_plane = [&](const Vec3& v) {
        return sides[static_cast<std::size_t>(&v - triangle.data())] == 0;
    };
    if (on_plane(apex))
        return apex;
    return on_plane(end) ? end : cut_point(apex, end, Cutter(plane));
}

} // namespace

Intersection triangle_triangle_segment(const Triangle& a, const Triangle& b) {
    const Signs b_sides = plane_sides(a, b), a_sides = plane_sides(b, a);
    if (strictly_one_side(b_sides) || strictly_one_side(a_sides))
        return {};
    if (all_zero(a_sides) && all_zero(b_sides))
        return coplanar_polygon(a, b);
    if (all_zero(b_sides)) { // a has no area
        const auto [p, q] = end_points(a);
        return segment_point(p, q, b);
    }
    if (all_zero(a_sides)) {
        const auto [p, q] = end_points(b);
        return segment_point(p, q, a);
    }

    const LineIntervals line = line_intervals(a, a_sides, b, b_sides);
    if (line.before(line.a_last, line.b_first) > 0 || line.before(line.a_first, line.b_last) < 0)
        return {};
    const bool starts_in_b = line.before(line.a_first, line.b_first) > 0,
               ends_in_a = line.before(line.a_last, line.b_last) > 0;
    Intersection result;
    add(result, starts_in_b ? interval_end(*line.b_apex, *line.b_first, b, b_sides, a)
                            : interval_end(*line.a_apex, *line.a_first, a, a_sides, b));
    if (line.before(line.a_last, line.b_first) != 0 && line.before(line.a_first, line.b_last) != 0)
        add(result, ends_in_a ? interval_end(*line.a_apex, *line.a_last, a, a_sides, b)
                              : interval_end(*line.b_apex, *line.b_last, b, b_sides, a));
    return result;
}

} // namespace abut
