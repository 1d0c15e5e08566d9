#include "view/simplify/stick.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr double kRounding = 1 + 0x1p-40;
/// The share of the length in which points belong to an end.
constexpr double kEndShare = 0.25;

std::size_t farthest_from(const Vec3& p, std::span<const Vec3> points) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const double d = length_sq(points[i] - p); d > most)
            most = d, best = i;
    return best;
}

double segment_distance(const Vec3& p, const Stick& to) {
    const Vec3 along = to.b - to.a;
    const double square = length_sq(along);
    const double t = square > 0 ? std::clamp(dot(p - to.a, along) / square, 0.0, 1.0) : 0;
    return length(p - (to.a + t * along));
}

/// The two points of an end that are about the farthest apart in a direction, or in any direction
/// across the axis.
std::array<std::uint32_t, 2> end_pair(std::span<const Vec3> points, const Vec3& axis, double from,
                                      double to, const Vec3* direction) {
    const auto across = [&](const Vec3& p) {
        return direction != nullptr ? dot(p, *direction) * *direction : p - dot(p, axis) * axis;
    };
    std::array<std::uint32_t, 2> pair{};
    bool is_first = true;
    // The farthest from the first point, and the farthest from that one.
    for (int step = 0; step < 3; ++step) {
        const Vec3 seen = across(points[pair[1]]);
        double most = -1;
        std::uint32_t best = pair[1];
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const double at = dot(points[i], axis);
            if (at < from || at > to)
                continue;
            if (is_first) {
                best = i, is_first = false;
                break;
            }
            if (const double d = length_sq(across(points[i]) - seen); d > most)
                most = d, best = i;
        }
        pair = {pair[1], best};
    }
    return pair;
}

} // namespace

Stick stick_of(std::span<const Vec3> points) {
    const Vec3& p = points[farthest_from(points[0], points)];
    const Vec3& q = points[farthest_from(p, points)];
    const Vec3 axis = normalized_or_zero(q - p);
    // The axis goes through the middle of the points across it.
    Box3 box;
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const Vec3& each : points) {
        const double at = dot(each - p, axis);
        least = std::min(least, at), most = std::max(most, at);
        extend(box, each - at * axis);
    }
    const Vec3 middle = 0.5 * (box.lower + box.upper);
    const Vec3 foot = middle - dot(middle - p, axis) * axis;
    Stick stick{foot + least * axis, foot + most * axis, 0};
    for (const Vec3& each : points)
        stick.radius = std::max(stick.radius, segment_distance(each, stick));
    stick.radius *= kRounding;
    return stick;
}

double axis_gap(const Stick& from, const Stick& to) {
    // The distance to a segment is a convex function, so the ends bound it.
    return kRounding * std::max(segment_distance(from.a, to), segment_distance(from.b, to));
}

std::array<std::uint32_t, 4> stick_corners(std::span<const Vec3> points, const Stick& stick) {
    const Vec3 axis = normalized_or_zero(stick.b - stick.a);
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const Vec3& p : points)
        least = std::min(least, dot(p, axis)), most = std::max(most, dot(p, axis));
    const double share = kEndShare * (most - least);
    const auto near = end_pair(points, axis, least, least + share, nullptr);
    const Vec3 wide = normalized_or_zero(points[near[1]] - points[near[0]]);
    const Vec3 other = normalized_or_zero(cross(axis, wide));
    const auto far = end_pair(points, axis, most - share, most, &other);
    std::array<std::uint32_t, 4> corners{near[0], near[1], far[0], far[1]};
    const Vec3 &a = points[corners[0]], &b = points[corners[1]], &c = points[corners[2]],
               &d = points[corners[3]];
    // Seen from outside, the face (0, 1, 2) has the fourth corner behind it.
    if (dot(cross(b - a, c - a), d - a) > 0)
        std::swap(corners[2], corners[3]);
    return corners;
}

} // namespace abut
