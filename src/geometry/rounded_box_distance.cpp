#include "geometry/rounded_box_distance.h"

#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace abut {

namespace {

using Edge = std::pair<Vec3, Vec3>;

/// The nearest point of the solid box.
Vec3 nearest_of_box(const RoundedBox& box, const Vec3& p) {
    const Vec3 d = p - box.centre;
    Vec3 nearest = box.centre;
    for (std::size_t k = 0; k < 3; ++k)
        nearest =
            nearest + std::clamp(dot(d, box.axis[k]), -box.half[k], box.half[k]) * box.axis[k];
    return nearest;
}

/// Different ones only: of axes without extent, one end.
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

/// A pair of points, and the square of their distance.
struct Candidate {
    double distance_sq = std::numeric_limits<double>::infinity();
    Vec3 a, b;

    void take_nearer(const Vec3& p, const Vec3& q) {
        const double sq = length_sq(q - p);
        if (sq < distance_sq)
            *this = {sq, p, q};
    }
};

/// Of boxes that are apart: a vertex and a box, or two edges.
Candidate nearest_features(const RoundedBox& a, const RoundedBox& b) {
    Candidate best;
    for (const Vec3& p : vertices_of(a))
        best.take_nearer(p, nearest_of_box(b, p));
    for (const Vec3& q : vertices_of(b))
        best.take_nearer(nearest_of_box(a, q), q);
    const auto edges_b = edges_of(b);
    for (const auto& [p0, p1] : edges_of(a))
        for (const auto& [q0, q1] : edges_b) {
            const ClosestPoints points = segment_segment_distance(p0, p1, q0, q1);
            best.take_nearer(points.a, points.b);
        }
    return best;
}

/// The farthest point along a direction; the middle of an edge or face at right angles to it.
Vec3 farthest(const RoundedBox& box, const Vec3& direction) {
    Vec3 p = box.centre;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = dot(direction, box.axis[k]);
        p = p + (along > 0 ? box.half[k] : along < 0 ? -box.half[k] : 0) * box.axis[k];
    }
    return p;
}

double reach(const RoundedBox& box, const Vec3& direction) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += std::abs(dot(direction, box.axis[k])) * box.half[k];
    return sum;
}

/// The axis along which two boxes overlap least, or are apart.
struct LeastOverlap {
    double overlap = std::numeric_limits<double>::infinity(); ///< negative: apart
    Vec3 normal;                                              ///< from a to b
    enum class Kind : std::uint8_t { face_a, face_b, edges } kind = Kind::face_a;

    void try_axis(const RoundedBox& a, const RoundedBox& b, const Vec3& axis, Kind of) {
        const double between = dot(b.centre - a.centre, axis);
        const double depth = reach(a, axis) + reach(b, axis) - std::abs(between);
        if (depth < overlap) {
            overlap = depth, kind = of;
            normal = between < 0 ? -axis : axis;
        }
    }
};

LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b) {
    using Kind = LeastOverlap::Kind;
    LeastOverlap least;
    for (const Vec3& axis : a.axis)
        least.try_axis(a, b, axis, Kind::face_a);
    for (const Vec3& axis : b.axis)
        least.try_axis(a, b, axis, Kind::face_b);
    for (const Vec3& u : a.axis)
        for (const Vec3& v : b.axis) {
            const Vec3 axis = cross(u, v);
            const double sq = length_sq(axis);
            // Nearly parallel edges: what their product would tell, the faces' axes do.
            if (sq > 0x1p-40)
                least.try_axis(a, b, (1 / std::sqrt(sq)) * axis, Kind::edges);
        }
    return least;
}

/// Of boxes that overlap: points that moving b by the overlap brings together.
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
        points = nearest_features(a, parted);
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

} // namespace

SolidGap rounded_box_distance(const RoundedBox& a, const RoundedBox& b, double upper_bound) {
    const bool points = is_point(a) && is_point(b);
    const LeastOverlap least = points ? LeastOverlap() : least_overlap(a, b);
    // Slightly less than the axis tells: it is rounded.
    const double apart = -least.overlap * (1 - 0x1p-40) - a.radius - b.radius;
    if (!points && apart > upper_bound)
        return {apart, {}, {}, least.normal};
    if (points || least.overlap < 0) {
        const Candidate nearest =
            points ? Candidate{length_sq(b.centre - a.centre), a.centre, b.centre}
                   : nearest_features(a, b);
        const double distance = std::sqrt(nearest.distance_sq);
        if (distance > 0)
            return with_radii(a, b, distance, nearest, (1 / distance) * (nearest.b - nearest.a));
        if (points)
            return with_radii(a, b, 0, nearest, a.axis[2]);
    }
    return with_radii(a, b, -least.overlap, deepest_points(a, b, least), least.normal);
}

} // namespace abut
