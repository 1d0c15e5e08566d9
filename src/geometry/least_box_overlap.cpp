#include "geometry/least_box_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace abut {

namespace {

/// Half of the box's extent along a direction.
double reach_along(const RoundedBox& box, const Vec3& direction) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += std::abs(dot(direction, box.axis[k])) * box.half[k];
    return sum;
}

/// The square with the sign of the number. It orders numbers as they are.
double signed_square(double x) {
    return x * std::abs(x);
}

/// The result for the axis of a number: 0 to 2 are those of a, 3 to 5 those of b, then come the cross products.
///
/// In          overlap: along that axis. way: from a to b, positive or negative as along the axis.
LeastOverlap overlap_along(const RoundedBox& a, const RoundedBox& b, std::size_t number,
                           double overlap, double way) {
    using Kind = LeastOverlap::Kind;
    LeastOverlap result;
    result.overlap = overlap, result.axis = static_cast<std::uint8_t>(number);
    result.kind = number < 3 ? Kind::face_a : number < 6 ? Kind::face_b : Kind::edges;
    Vec3 along;
    if (number < 6) {
        along = number < 3 ? a.axis[number] : b.axis[number - 3];
    } else {
        const Vec3 across = cross(a.axis[(number - 6) / 3], b.axis[(number - 6) % 3]);
        along = (1 / length(across)) * across;
        // The axis of nearly parallel edges is rounded, and so was what the sums of the search tell about it.
        // About the rounded axis, these sums are right.
        result.overlap = reach_along(a, along) + reach_along(b, along) -
                         std::abs(dot(b.centre - a.centre, along));
    }
    result.normal = way < 0 ? -along : along;
    return result;
}

} // namespace

LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b, double farthest) {
    return least_overlap(a, b, BoxAxes(a, b), farthest);
}

LeastOverlap least_overlap(const RoundedBox& a, const RoundedBox& b, const BoxAxes& axes,
                           double farthest) {
    const auto& turn = axes.turn;
    const auto& way = axes.way;
    double size[3][3];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            size[i][k] = std::abs(turn[i][k]);
    double least = std::numeric_limits<double>::infinity(), least_way = 0;
    std::size_t best = 0;
    // Values are chosen: a branch would be taken at random.
    const auto keep_face = [&](double reach, std::size_t axis) {
        const double overlap = reach - std::abs(way[axis]);
        best = overlap < least ? axis : best;
        least_way = overlap < least ? way[axis] : least_way;
        least = std::min(overlap, least);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        double reach_b = 0;
        for (std::size_t k = 0; k < 3; ++k)
            reach_b += size[i][k] * b.half[k];
        keep_face(a.half[i] + reach_b, i);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        double reach_a = 0;
        for (std::size_t i = 0; i < 3; ++i)
            reach_a += size[i][k] * a.half[i];
        keep_face(reach_a + b.half[k], 3 + k);
    }
    if (least < -farthest)
        return overlap_along(a, b, best, least, least_way);
    // Overlaps along cross products are compared by their squares, without roots.
    double least_sq = signed_square(least);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3,
                              k2 = (k + 2) % 3;
            const double reach_a = a.half[i1] * size[i2][k] + a.half[i2] * size[i1][k];
            const double reach_b = b.half[k1] * size[i][k2] + b.half[k2] * size[i][k1];
            const double across = way[i2] * turn[i1][k] - way[i1] * turn[i2][k];
            // That of the cross product, which is not a unit vector.
            const double overlap_sq = signed_square(reach_a + reach_b - std::abs(across));
            const double sq = turn[i1][k] * turn[i1][k] + turn[i2][k] * turn[i2][k];
            // For nearly parallel edges, the face axes already tell what their cross product would.
            if (overlap_sq < least_sq * sq && sq > 0x1p-40)
                least_sq = overlap_sq / sq, least_way = across, best = 6 + 3 * i + k;
        }
    return overlap_along(a, b, best, least, least_way);
}

} // namespace abut
