#include "world/solids/known_separation.h"

#include <cmath>

namespace abut {

namespace {

/// The rounding of a gap that is allowed for, relative to the sizes. It is far above that of a dozen products.
constexpr double kGapRounding = 0x1p-30;
/// Cross products of edges that are more nearly parallel are not tried: their direction is rounded.
constexpr double kLeastSine = 0x1p-6;

double sum_of_halves(const RoundedBox& box) {
    return box.half[0] + box.half[1] + box.half[2];
}

/// Half of the box's extent along a direction.
double reach_of(const RoundedBox& box, const Vec3& direction) {
    return std::abs(dot(direction, box.axis[0])) * box.half[0] +
           std::abs(dot(direction, box.axis[1])) * box.half[1] +
           std::abs(dot(direction, box.axis[2])) * box.half[2];
}

/// Whether the axis of a number separates two boxes by more than a distance.
bool is_apart_along_axis(const RoundedBox& a, const RoundedBox& b, std::size_t axis,
                         double distance) {
    const Vec3 way = b.centre - a.centre;
    const double sizes = sum_of_sizes(way) + sum_of_halves(a) + sum_of_halves(b);
    const double least = distance + kGapRounding * (distance + sizes);
    if (axis < 3)
        return std::abs(dot(way, a.axis[axis])) - a.half[axis] - reach_of(b, a.axis[axis]) > least;
    if (axis < 6)
        return std::abs(dot(way, b.axis[axis - 3])) - b.half[axis - 3] -
                   reach_of(a, b.axis[axis - 3]) >
               least;
    const Vec3 across = cross(a.axis[(axis - 6) / 3], b.axis[(axis - 6) % 3]);
    const double sq = length_sq(across);
    const double gap = std::abs(dot(way, across)) - reach_of(a, across) - reach_of(b, across);
    return sq > kLeastSine * kLeastSine && gap > 0 && gap * gap > least * least * sq;
}

/// Whether a unit vector from a to b separates two capsules by more than a distance.
bool is_apart_along(const RoundedBox& a, const RoundedBox& b, const Vec3& direction,
                    double distance) {
    const HalfSegment of_a(a), of_b(b);
    const Vec3 way = b.centre - a.centre;
    const double reach = a.radius + b.radius + distance;
    const double gap = dot(way, direction) - std::abs(dot(of_a.half, direction)) -
                       std::abs(dot(of_b.half, direction)) - reach;
    return gap >
           kGapRounding * (reach + sum_of_sizes(way) + a.half[of_a.number] + b.half[of_b.number]);
}

} // namespace

bool is_apart(const KnownSeparation& known, const RoundedBox& a, const RoundedBox& b,
              double distance) {
    if (known.axis != kNoAxis)
        return is_apart_along_axis(a, b, known.axis, distance + a.radius + b.radius);
    return known.direction != Vec3{} && is_apart_along(a, b, known.direction, distance);
}

} // namespace abut
