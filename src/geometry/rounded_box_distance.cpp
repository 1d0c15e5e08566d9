#include "geometry/rounded_box_distance.h"

#include "geometry/least_box_overlap.h"
#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace abut {

namespace {

using Edge = std::pair<Vec3, Vec3>;

/// The vector from a point to the nearest point of the solid box. It is computed in the box's
/// coordinates: next to a face it has the direction of the face's normal, however short it is.
Vec3 way_to_box(const RoundedBox& box, const Vec3& p) {
    const Vec3 d = p - box.centre;
    Vec3 way;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = dot(d, box.axis[k]);
        way = way + (std::clamp(along, -box.half[k], box.half[k]) - along) * box.axis[k];
    }
    return way;
}

/// The distinct vertices: an axis without extent does not double them.
boost::container::static_vector<Vec3, 8> vertices_of(const RoundedBox& box) {
    boost::container::static_vector<Vec3, 8> vertices{box.centre};
    for (std::size_t k = 0; k < 3; ++k) {
        if (box.half[k] == 0)
            continue;
        const std::size_t count = vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            vertices.push_back(vertices[i] + box.half[k] * box.axis[k]);
            vertices[i] = vertices[i] - box.half[k] * box.axis[k];
        }
    }
    return vertices;
}

boost::container::static_vector<Edge, 12> edges_of(const RoundedBox& box) {
    boost::container::static_vector<Edge, 12> edges;
    for (std::size_t k = 0; k < 3; ++k) {
        if (box.half[k] == 0)
            continue;
        RoundedBox across = box;
        across.half[k] = 0;
        const Vec3 along = box.half[k] * box.axis[k];
        for (const Vec3& middle : vertices_of(across))
            edges.emplace_back(middle - along, middle + along);
    }
    return edges;
}

/// A pair of points, one of each box, the vector between them and its squared length.
struct Candidate {
    double distance_sq = std::numeric_limits<double>::infinity();
    Vec3 a, b, way; ///< way: from a to b

    [[nodiscard]] double distance() const { return std::sqrt(distance_sq); }
    void take_nearer(const Vec3& p, const Vec3& q, const Vec3& from_p_to_q) {
        const double sq = length_sq(from_p_to_q);
        if (sq < distance_sq)
            *this = {sq, p, q, from_p_to_q};
    }
};

double reach(const RoundedBox& box, const Vec3& direction) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += std::abs(dot(direction, box.axis[k])) * box.half[k];
    return sum;
}

/// The extents of two boxes along a unit vector from a to b.
struct Slab {
    Vec3 origin, normal;
    double top_a, bottom_b;
    double rounding; ///< error bound of a height

    Slab(const RoundedBox& a, const RoundedBox& b, const Vec3& along)
        : origin(a.centre), normal(along), top_a(reach(a, along)) {
        const double reach_b = reach(b, along);
        bottom_b = height(b.centre) - reach_b;
        rounding = 0x1p-50 * (length(b.centre - a.centre) + top_a + reach_b);
    }
    [[nodiscard]] double height(const Vec3& p) const { return dot(p - origin, normal); }
    [[nodiscard]] double gap() const { return bottom_b - top_a; }
    /// Whether something at height `low` or above may be within `distance` of something at height
    /// `high` or below.
    [[nodiscard]] bool may_be_nearer(double high, double low, double distance) const {
        return low - high < distance - rounding;
    }
};

/// The closest pair of a vertex of one box and a point of the other. In: the boxes are apart.
Candidate nearest_vertex(const RoundedBox& a, const RoundedBox& b, const Slab& slab) {
    Candidate best;
    for (const Vec3& p : vertices_of(a))
        if (slab.may_be_nearer(slab.height(p), slab.bottom_b, best.distance())) {
            const Vec3 way = way_to_box(b, p);
            best.take_nearer(p, p + way, way);
        }
    for (const Vec3& q : vertices_of(b))
        if (slab.may_be_nearer(slab.top_a, slab.height(q), best.distance())) {
            const Vec3 way = way_to_box(a, q);
            best.take_nearer(q + way, q, -way);
        }
    return best;
}

/// Keeps the closest pair of edges if it is closer than the best so far. In: the boxes are apart.
void take_nearer_edges(const RoundedBox& a, const RoundedBox& b, const Slab& slab,
                       Candidate& best) {
    const auto edges_b = edges_of(b);
    for (const auto& [p0, p1] : edges_of(a)) {
        const double high = std::max(slab.height(p0), slab.height(p1));
        if (!slab.may_be_nearer(high, slab.bottom_b, best.distance()))
            continue;
        for (const auto& [q0, q1] : edges_b) {
            const double low = std::min(slab.height(q0), slab.height(q1));
            if (!slab.may_be_nearer(high, low, best.distance()))
                continue;
            const ClosestPoints points = segment_segment_distance(p0, p1, q0, q1);
            best.take_nearer(points.a, points.b, points.b - points.a);
        }
    }
}

/// The closest points of boxes that are apart: of a vertex and a box, or of two edges. Features
/// that a plane proves to be farther apart than the best so far are skipped.
///
/// In          normal: a unit vector from a to b. The better it separates, the more is skipped.
Candidate nearest_features(const RoundedBox& a, const RoundedBox& b, const Vec3& normal) {
    Slab slab(a, b, normal);
    Candidate best = nearest_vertex(a, b, slab);
    if (const double distance = best.distance(); distance > 0) {
        const Slab across(a, b, (1 / distance) * best.way);
        if (across.gap() > slab.gap())
            slab = across;
    }
    if (slab.may_be_nearer(slab.top_a, slab.bottom_b, best.distance()))
        take_nearer_edges(a, b, slab, best);
    return best;
}

/// The farthest point along a direction. If the direction is perpendicular to an edge or face, its
/// middle.
Vec3 farthest(const RoundedBox& box, const Vec3& direction) {
    Vec3 p = box.centre;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = dot(direction, box.axis[k]);
        p = p + (along > 0 ? box.half[k] : along < 0 ? -box.half[k] : 0) * box.axis[k];
    }
    return p;
}

/// A bound of the coordinates of both boxes, relative to a.centre.
double size_of_both(const RoundedBox& a, const RoundedBox& b) {
    double size = sum_of_sizes(b.centre - a.centre);
    for (std::size_t k = 0; k < 3; ++k)
        size += a.half[k] + b.half[k];
    return size;
}

/// Bound of the rounding of a coordinate, relative to the size of both boxes: of about ten sums and
/// products.
constexpr double kBoxGapRounding = 0x1p-48;
/// A distance above this share of the size tells its direction: rounded by 2^-28, of which the
/// square is below the rounding of a coordinate.
constexpr double kClearShare = 0x1p-20;

/// Whether a box holds a point, to rounding.
bool box_holds(const RoundedBox& box, const Vec3& p, double rounding) {
    const Vec3 d = p - box.centre;
    for (std::size_t k = 0; k < 3; ++k)
        if (!(std::abs(dot(d, box.axis[k])) <= box.half[k] + rounding))
            return false;
    return true;
}

/// The points of overlapping boxes that coincide after b has moved by the overlap.
Candidate deepest_points(const RoundedBox& a, const RoundedBox& b, const LeastOverlap& least,
                         double rounding) {
    const Vec3 way = least.overlap * least.normal;
    Candidate points;
    // The farthest point of one box, brought onto a face of the other: into it, if the faces are
    // parallel and overlap sideways.
    if (least.kind == LeastOverlap::Kind::face_a) {
        const Vec3 on_a = farthest(b, -least.normal) + way;
        points.a = on_a + way_to_box(a, on_a);
        points.b = points.a - way;
        if (box_holds(b, points.b, rounding))
            return points;
    } else if (least.kind == LeastOverlap::Kind::face_b) {
        const Vec3 on_b = farthest(a, least.normal) - way;
        points.b = on_b + way_to_box(b, on_b);
        points.a = points.b + way;
        if (box_holds(a, points.a, rounding))
            return points;
    }
    RoundedBox parted = b;
    parted.centre = b.centre + way;
    points = nearest_features(a, parted, least.normal);
    points.b = points.b - way;
    return points;
}

SolidGap with_radii(const RoundedBox& a, const RoundedBox& b, double core_distance,
                    const Candidate& points, const Vec3& normal) {
    return {core_distance - a.radius - b.radius, points.a + a.radius * normal,
            points.b - b.radius * normal, normal};
}

/// The gap of boxes that are apart, or touch to rounding.
///
/// In          nearest: their closest points, at a distance above 0.
SolidGap gap_of_apart(const RoundedBox& a, const RoundedBox& b, const LeastOverlap& least,
                      Candidate nearest, double size) {
    const double distance = nearest.distance(), apart = -least.overlap;
    const double rounding = kBoxGapRounding * size;
    // If the points are as near as the planes across the best axis, that axis is the direction.
    // It is not rounded, as the way between points that nearly touch is.
    if (distance < kClearShare * size && apart >= distance - rounding) {
        const Vec3 on_b = nearest.a + apart * least.normal, on_a = nearest.b - apart * least.normal;
        if (box_holds(b, on_b, rounding)) {
            nearest.b = on_b;
            return with_radii(a, b, apart, nearest, least.normal);
        }
        if (box_holds(a, on_a, rounding)) {
            nearest.a = on_a;
            return with_radii(a, b, apart, nearest, least.normal);
        }
    }
    return with_radii(a, b, distance, nearest, (1 / distance) * nearest.way);
}

/// The gap of two boxes along a direction. Points are relative to a's centre, which is the origin.
SolidGap gap_of_boxes(const RoundedBox& a, const RoundedBox& b, const LeastOverlap& least) {
    const double size = size_of_both(a, b);
    if (least.overlap < 0) {
        const Candidate nearest = nearest_features(a, b, least.normal);
        if (nearest.distance_sq > 0)
            return gap_of_apart(a, b, least, nearest, size);
    }
    return with_radii(a, b, -least.overlap, deepest_points(a, b, least, kBoxGapRounding * size),
                      least.normal);
}

bool is_point(const RoundedBox& box) {
    return box.half == std::array<double, 3>{};
}

/// Half of a segment; zero of a box that has another extent.
Vec3 half_of_segment(const RoundedBox& box) {
    const auto& half = box.half;
    if (std::count(half.begin(), half.end(), 0.0) != 2)
        return {};
    const auto k =
        static_cast<std::size_t>(std::max_element(half.begin(), half.end()) - half.begin());
    return half[k] * box.axis[k];
}

/// The gap of a box and a ball. The normal points to the ball.
SolidGap gap_of_ball(const RoundedBox& box, const RoundedBox& ball) {
    const Vec3 way = ball.centre - box.centre;
    Vec3 nearest, out; // of the box, relative to its centre; from there to the ball's centre
    std::size_t last = 0;
    std::array<double, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) {
        along[k] = dot(way, box.axis[k]);
        const double inside = std::clamp(along[k], -box.half[k], box.half[k]);
        nearest = nearest + inside * box.axis[k];
        out = out + (along[k] - inside) * box.axis[k];
        if (std::abs(along[k]) - box.half[k] > std::abs(along[last]) - box.half[last])
            last = k;
    }
    SolidGap gap;
    gap.distance = length(out);
    if (gap.distance > kBoxGapRounding * size_of_both(box, ball)) {
        gap.normal = (1 / gap.distance) * out;
    } else { // the centre lies in the box, or on its surface to rounding: out through a face
        gap.normal = along[last] < 0 ? -box.axis[last] : box.axis[last];
        gap.distance = std::abs(along[last]) - box.half[last];
        nearest = way - gap.distance * gap.normal;
    }
    gap.point_a = box.centre + (nearest + box.radius * gap.normal);
    gap.point_b = ball.centre - ball.radius * gap.normal;
    gap.distance -= box.radius + ball.radius;
    return gap;
}

SolidGap gap_of_balls(const RoundedBox& a, const RoundedBox& b) {
    const Vec3 way = b.centre - a.centre;
    const double distance = length(way);
    const Vec3 normal = distance > 0 ? (1 / distance) * way : a.axis[2];
    return {distance - a.radius - b.radius, a.centre + a.radius * normal,
            b.centre - b.radius * normal, normal};
}

/// The direction from one segment to another where they touch, to rounding.
///
/// In          u, v: the segments, of which at the parameters s and t the closest points are. way:
///             from one of these to the other.
Vec3 normal_of_touching(const Vec3& u, const Vec3& v, const SegmentPoints& closest, const Vec3& way,
                        double rounding) {
    const Vec3 along_u = normalized_or_zero(u), along_v = normalized_or_zero(v),
               both = cross(along_u, along_v);
    const double sine = length(both);
    const bool in_u = closest.s > 0 && closest.s<1, in_v = closest.t> 0 && closest.t < 1;
    // A product is rounded by 2^-52, so its direction by 2^-52 / sine.
    if (const bool are_turned = sine > 0x1p-26; are_turned && in_u && in_v)
        return (dot(both, way) < 0 ? -1 / sine : 1 / sine) * both;
    // Rounding alone tilts the way towards a segment in whose inside it ends.
    Vec3 across = way;
    if (in_u)
        across = across - dot(across, along_u) * along_u;
    if (in_v)
        across = across - dot(across, along_v) * along_v;
    if (length(across) > rounding)
        return normalized_or_zero(across);
    return sine > 0x1p-26 ? (1 / sine) * both : perpendicular(along_u);
}

SolidGap turned_round(const SolidGap& gap) {
    return {gap.distance, gap.point_b, gap.point_a, -gap.normal};
}

} // namespace

// Segments that cross overlap by nothing but their radii.
SolidGap capsule_distance(const Sphere& a, const Vec3& half_a, const Sphere& b, const Vec3& half_b,
                          double upper_bound) {
    const Vec3 u = 2 * half_a, v = 2 * half_b, r = (b.centre - a.centre) + (half_a - half_b);
    const SegmentPoints closest = nearest_on_segments(u, v, r);
    // From the difference of the centres, which far from the origin is rounded less than points.
    const Vec3 way = (r + closest.t * v) - closest.s * u;
    double distance = length(way);
    const double size = max_abs(u) + max_abs(v);
    Vec3 normal;
    if (distance > kClearShare * size) {
        normal = (1 / distance) * way;
        if (const double apart = distance - a.radius - b.radius; apart > upper_bound)
            return {apart, {}, {}, normal};
    } else {
        normal = normal_of_touching(u, v, closest, way, kBoxGapRounding * (size + max_abs(r)));
        distance = std::max(dot(way, normal), 0.0);
    }
    return {distance - a.radius - b.radius,
            (a.centre + (2 * closest.s - 1) * half_a) + a.radius * normal,
            (b.centre + (2 * closest.t - 1) * half_b) - b.radius * normal, normal};
}

SolidGap rounded_box_distance(const RoundedBox& a, const RoundedBox& b, double upper_bound) {
    if (is_point(b))
        return is_point(a) ? gap_of_balls(a, b) : gap_of_ball(a, b);
    if (is_point(a))
        return turned_round(gap_of_ball(b, a));
    if (const Vec3 along_a = half_of_segment(a); along_a != Vec3{})
        if (const Vec3 along_b = half_of_segment(b); along_b != Vec3{})
            return capsule_distance({a.centre, a.radius}, along_a, {b.centre, b.radius}, along_b,
                                    upper_bound);
    const LeastOverlap least = least_overlap(a, b);
    // Slightly less than the axis tells, because that is rounded.
    const double apart = -least.overlap * (1 - 0x1p-40) - a.radius - b.radius;
    if (apart > upper_bound)
        return {apart, {}, {}, least.normal};
    // Seen from a's centre, corners are rounded no more than the difference of the centres.
    RoundedBox near_a = a, near_b = b;
    near_a.centre = {}, near_b.centre = b.centre - a.centre;
    SolidGap gap = gap_of_boxes(near_a, near_b, least);
    gap.point_a = a.centre + gap.point_a, gap.point_b = a.centre + gap.point_b;
    return gap;
}

} // namespace abut
