#include "geometry/rounded_box_distance.h"

#include "geometry/least_box_overlap.h"
#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace abut {

namespace {

using Edge = std::pair<Vec3, Vec3>;

/// The point of the solid box nearest to p.
Vec3 nearest_of_box(const RoundedBox& box, const Vec3& p) {
    const Vec3 d = p - box.centre;
    Vec3 nearest = box.centre;
    for (std::size_t k = 0; k < 3; ++k)
        nearest =
            nearest + std::clamp(dot(d, box.axis[k]), -box.half[k], box.half[k]) * box.axis[k];
    return nearest;
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

/// A pair of points, one of each box, and their squared distance.
struct Candidate {
    double distance_sq = std::numeric_limits<double>::infinity();
    Vec3 a, b;

    [[nodiscard]] double distance() const { return std::sqrt(distance_sq); }
    void take_nearer(const Vec3& p, const Vec3& q) {
        const double sq = length_sq(q - p);
        if (sq < distance_sq)
            *this = {sq, p, q};
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
        if (slab.may_be_nearer(slab.height(p), slab.bottom_b, best.distance()))
            best.take_nearer(p, nearest_of_box(b, p));
    for (const Vec3& q : vertices_of(b))
        if (slab.may_be_nearer(slab.top_a, slab.height(q), best.distance()))
            best.take_nearer(nearest_of_box(a, q), q);
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
            best.take_nearer(points.a, points.b);
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
        const Slab across(a, b, (1 / distance) * (best.b - best.a));
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

/// The points of overlapping boxes that coincide after b has moved by the overlap.
Candidate deepest_points(const RoundedBox& a, const RoundedBox& b, const LeastOverlap& least) {
    const Vec3 way = least.overlap * least.normal;
    Candidate points;
    switch (least.kind) {
    case LeastOverlap::Kind::face_a:
        points.b = farthest(b, -least.normal);
        points.a = points.b + way;
        break;
    case LeastOverlap::Kind::face_b:
        points.a = farthest(a, least.normal);
        points.b = points.a - way;
        break;
    case LeastOverlap::Kind::edges:
        RoundedBox parted = b;
        parted.centre = b.centre + way;
        points = nearest_features(a, parted, least.normal);
        points.b = points.b - way;
        break;
    }
    return points;
}

SolidGap with_radii(const RoundedBox& a, const RoundedBox& b, double core_distance,
                    const Candidate& points, const Vec3& normal) {
    return {core_distance - a.radius - b.radius, points.a + a.radius * normal,
            points.b - b.radius * normal, normal};
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

/// The gap of two segments with radii that are clearly apart: then no axis is needed.
std::optional<SolidGap> gap_of_apart_segments(const RoundedBox& a, const RoundedBox& b) {
    const Vec3 along_a = half_of_segment(a), along_b = half_of_segment(b);
    if (along_a == Vec3{} || along_b == Vec3{})
        return std::nullopt;
    const Vec3 u = 2 * along_a, v = 2 * along_b, r = (b.centre - a.centre) + (along_a - along_b);
    const SegmentPoints closest = nearest_on_segments(u, v, r);
    // The direction of a shorter distance is rounded too much.
    constexpr double kClearlySq = 0x1p-60;
    if (!(closest.distance_sq > kClearlySq * (length_sq(u) + length_sq(v))))
        return std::nullopt;
    // From the difference of the centres, which far from the origin is rounded less than points.
    const Vec3 way = (r + closest.t * v) - closest.s * u;
    const double distance = length(way);
    const Candidate points{closest.distance_sq, a.centre + (2 * closest.s - 1) * along_a,
                           b.centre + (2 * closest.t - 1) * along_b};
    return with_radii(a, b, distance, points, (1 / distance) * way);
}

} // namespace

SolidGap rounded_box_distance(const RoundedBox& a, const RoundedBox& b, double upper_bound) {
    if (const std::optional<SolidGap> gap = gap_of_apart_segments(a, b))
        return *gap;
    const bool points = is_point(a) && is_point(b);
    const LeastOverlap least = points ? LeastOverlap() : least_overlap(a, b);
    // Slightly less than the axis tells, because that is rounded.
    const double apart = -least.overlap * (1 - 0x1p-40) - a.radius - b.radius;
    if (!points && apart > upper_bound)
        return {apart, {}, {}, least.normal};
    if (points || least.overlap < 0) {
        const Candidate nearest =
            points ? Candidate{length_sq(b.centre - a.centre), a.centre, b.centre}
                   : nearest_features(a, b, least.normal);
        const double distance = nearest.distance();
        if (distance > 0)
            return with_radii(a, b, distance, nearest, (1 / distance) * (nearest.b - nearest.a));
        if (points)
            return with_radii(a, b, 0, nearest, a.axis[2]);
    }
    return with_radii(a, b, -least.overlap, deepest_points(a, b, least), least.normal);
}

} // namespace abut
