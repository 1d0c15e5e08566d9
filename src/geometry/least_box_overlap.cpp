#include "geometry/least_box_overlap.h"

#include <cmath>

namespace abut {

namespace {

/// The axis along which the boxes overlap least, from an axis of each box.
Vec3 unit_axis(LeastOverlap::Kind kind, const Vec3& of_a, const Vec3& of_b) {
    if (kind == LeastOverlap::Kind::face_a)
        return of_a;
    if (kind == LeastOverlap::Kind::face_b)
        return of_b;
    const Vec3 across = cross(of_a, of_b);
    return (1 / length(across)) * across;
}

/// Half of the box's extent along a direction.
double reach_along(const RoundedBox& box, const Vec3& direction) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += std::abs(dot(direction, box.axis[k])) * box.half[k];
    return sum;
}

} // namespace

// All axes share the scalar products of the boxes' own axes.
LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b) {
    using Kind = LeastOverlap::Kind;
    const Vec3 d = b.centre - a.centre;
    double turn[3][3], way_a[3], way_b[3]; // b's axes in a's frame; the vector to b in both frames
    for (std::size_t i = 0; i < 3; ++i) {
        way_a[i] = dot(d, a.axis[i]);
        way_b[i] = dot(d, b.axis[i]);
        for (std::size_t k = 0; k < 3; ++k)
            turn[i][k] = dot(a.axis[i], b.axis[k]);
    }
    LeastOverlap least;
    std::size_t best_i = 0, best_k = 0;
    double best_way = 0;
    const auto keep = [&](double overlap, double way, Kind kind, std::size_t i, std::size_t k) {
        if (overlap < least.overlap) {
            least.overlap = overlap, least.kind = kind;
            best_way = way, best_i = i, best_k = k;
        }
    };
    for (std::size_t i = 0; i < 3; ++i) {
        double reach_b = 0;
        for (std::size_t k = 0; k < 3; ++k)
            reach_b += std::abs(turn[i][k]) * b.half[k];
        keep(a.half[i] + reach_b - std::abs(way_a[i]), way_a[i], Kind::face_a, i, 0);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        double reach_a = 0;
        for (std::size_t i = 0; i < 3; ++i)
            reach_a += std::abs(turn[i][k]) * a.half[i];
        keep(reach_a + b.half[k] - std::abs(way_b[k]), way_b[k], Kind::face_b, 0, k);
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3,
                              k2 = (k + 2) % 3;
            const double sq = turn[i1][k] * turn[i1][k] + turn[i2][k] * turn[i2][k];
            // For nearly parallel edges, the face axes already tell what their cross product would.
            if (sq <= 0x1p-40)
                continue;
            const double scale = 1 / std::sqrt(sq);
            const double reach_a =
                a.half[i1] * std::abs(turn[i2][k]) + a.half[i2] * std::abs(turn[i1][k]);
            const double reach_b =
                b.half[k1] * std::abs(turn[i][k2]) + b.half[k2] * std::abs(turn[i][k1]);
            const double way = way_a[i2] * turn[i1][k] - way_a[i1] * turn[i2][k];
            keep(scale * (reach_a + reach_b - std::abs(way)), way, Kind::edges, i, k);
        }
    const Vec3 along = unit_axis(least.kind, a.axis[best_i], b.axis[best_k]);
    least.normal = best_way < 0 ? -along : along;
    // The axis of nearly parallel edges is rounded, and so was what the sums above tell about it.
    // About the rounded axis, these sums are right.
    if (least.kind == Kind::edges)
        least.overlap = reach_along(a, along) + reach_along(b, along) - std::abs(dot(d, along));
    return least;
}

} // namespace abut
