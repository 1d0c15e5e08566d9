#include "convex/support/local_core.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace abut {

namespace {

/// A point that is nearer than this to the border of a feature, relative to the feature, is on the
/// border. Points of a search are known to about 1e-8.
constexpr double kBorder = 1e-6;
/// A feature counts only if the direction agrees with its rule to this.
constexpr double kAgreement = 1e-3;

/// Coordinates along the axes of a shape.
struct Local {
    double x, y, z;
};
Local along_axes(const SupportShape& shape, const Vec3& v) {
    return {dot(shape.axis[0], v), dot(shape.axis[1], v), dot(shape.axis[2], v)};
}
Vec3 from_axes(const SupportShape& shape, const Local& v) {
    return v.x * shape.axis[0] + v.y * shape.axis[1] + v.z * shape.axis[2];
}

void add_rule(LocalCore& core, const Vec3& normal, double level, const Vec3& direction) {
    if (std::abs(dot(normal, direction) - level) <= kAgreement && core.rule_count < 3)
        core.rules[core.rule_count++] = {normal, level};
}

void place_on_box(LocalCore& core, const Vec3& at, const Vec3& direction) {
    const SupportShape& box = *core.shape;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = dot(box.axis[k], at), half = box.half[k];
        const bool inside = std::abs(along) < half * (1 - kBorder) &&
                            std::abs(dot(box.axis[k], direction)) <= kAgreement;
        core.fixed = core.fixed + (inside ? along : with_sign(half, along)) * box.axis[k];
        if (!inside)
            continue;
        add_rule(core, box.axis[k], 0, direction);
        core.room = std::min(core.room, half - std::abs(along));
    }
}

/// The face of a cylinder's or cone's end, at this height.
void place_on_disc(LocalCore& core, const Local& at, double height, const Vec3& direction) {
    core.fixed = from_axes(*core.shape, {at.x, at.y, height});
    core.room = core.shape->half[0] - std::hypot(at.x, at.y);
    add_rule(core, core.shape->axis[0], 0, direction);
    add_rule(core, core.shape->axis[1], 0, direction);
}

void place_on_cylinder(LocalCore& core, const Local& at, const Vec3& direction) {
    const SupportShape& cylinder = *core.shape;
    const Local d = along_axes(cylinder, direction);
    const double radius = cylinder.half[0], half = cylinder.half[2];
    if (std::hypot(d.x, d.y) <= kAgreement && std::hypot(at.x, at.y) < radius * (1 - kBorder))
        return place_on_disc(core, at, with_sign(half, d.z), direction);
    core.rim = 1;
    const bool on_side = std::abs(d.z) <= kAgreement && std::abs(at.z) < half * (1 - kBorder);
    core.fixed = (on_side ? at.z : with_sign(half, at.z)) * cylinder.axis[2];
    if (!on_side)
        return;
    add_rule(core, cylinder.axis[2], 0, direction);
    core.room = half - std::abs(at.z);
}

void place_on_cone(LocalCore& core, const Local& at, const Vec3& direction) {
    const SupportShape& cone = *core.shape;
    const Local d = along_axes(cone, direction);
    const double radius = cone.half[0], half = cone.half[2];
    if (d.z < 0 && std::hypot(d.x, d.y) <= kAgreement &&
        std::hypot(at.x, at.y) < radius * (1 - kBorder))
        return place_on_disc(core, at, -half, direction);
    // The side's normals make a fixed angle with the axis. Its points are between apex and rim.
    const double slope = radius / std::hypot(radius, 2 * half);
    const double down = half > 0 ? (half - at.z) / (2 * half) : 1;
    if (std::abs(d.z - slope) <= kAgreement && down > kBorder && down < 1 - kBorder) {
        core.rim = down, core.fixed = ((1 - 2 * down) * half) * cone.axis[2];
        add_rule(core, cone.axis[2], slope, direction);
        core.room = std::min(down, 1 - down) * std::hypot(radius, 2 * half);
        return;
    }
    core.rim = down < 0.5 ? 0 : 1;
    core.fixed = (down < 0.5 ? half : -half) * cone.axis[2];
}

void place_on_ellipsoid(LocalCore& core, const Vec3& at, const Vec3& direction) {
    const SupportShape& ellipsoid = *core.shape;
    core.curved = true;
    double inside = 0;
    bool flat = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const double half = ellipsoid.half[k];
        const double ratio = half > 0 ? dot(ellipsoid.axis[k], at) / half : 0;
        inside += ratio * ratio, flat = flat || half == 0;
    }
    if (!flat || !(inside < 1 - kBorder))
        return;
    core.curved = false, core.fixed = at;
    double least = std::numeric_limits<double>::infinity();
    for (const double half : ellipsoid.half)
        least = half > 0 ? std::min(least, half) : least;
    core.room = (1 - std::sqrt(inside)) * least;
    for (std::size_t k = 0; k < 3; ++k)
        if (ellipsoid.half[k] > 0)
            add_rule(core, ellipsoid.axis[k], 0, direction);
}

/// The corners of a triangle or polytope that carry weight.
void place_on_corners(LocalCore& core, PairSide side, const SupportSimplex& nearest, const Vec3& at,
                      const Vec3& direction) {
    constexpr double kNoWeight = 1e-7;
    core.fixed = at;
    std::array<Vec3, 4> corner;
    std::array<double, 4> weight{};
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < nearest.count; ++i) {
        if (!(nearest.weights[i] > kNoWeight))
            continue;
        const Vec3 p = side == PairSide::a ? nearest.corners[i].a : nearest.corners[i].b;
        const std::size_t k = static_cast<std::size_t>(
            std::find(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(count), p) -
            corner.begin());
        corner[k] = p, weight[k] += nearest.weights[i];
        count = std::max(count, k + 1);
    }
    for (std::size_t i = 1; i < count; ++i)
        add_rule(core, normalized_or_zero(corner[i] - corner[0]), 0, direction);
    // The weight of a corner is the point's height above the opposite side, relative to the corner's.
    for (std::size_t i = 0; i < count && count > 1; ++i) {
        const Vec3 &next = corner[(i + 1) % count], way = corner[i] - next,
                   edge = normalized_or_zero(corner[(i + 2) % count] - next);
        const double height = count == 2 ? length(way) : length(cross(way, edge));
        core.room = std::min(core.room, weight[i] * height);
    }
}

/// The farthest point of the disc or the ellipsoid, or of the disc of the ellipsoid's rim.
Vec3 round_point(const SupportShape& shape, const Local& d) {
    const double across = std::hypot(d.x, d.y);
    const double scale = across > 0 ? shape.half[0] / across : 0;
    return from_axes(shape, {scale * d.x, scale * d.y, 0});
}

Vec3 round_derivative(const SupportShape& shape, const Local& d, const Local& by) {
    const double across = std::hypot(d.x, d.y);
    if (!(across > 0))
        return {};
    // Only a motion around the axis moves the point.
    const double u = -d.y / across, v = d.x / across;
    const double scale = shape.half[0] / across * (u * by.x + v * by.y);
    return from_axes(shape, {scale * u, scale * v, 0});
}

Vec3 ellipsoid_derivative(const SupportShape& shape, const Local& d, const Local& by) {
    const auto& [a, b, c] = shape.half;
    const Local p{a * d.x, b * d.y, c * d.z}, q{a * by.x, b * by.y, c * by.z};
    const double size = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    if (!(size > 0))
        return {};
    const double along = (p.x * q.x + p.y * q.y + p.z * q.z) / (size * size);
    const double length_sq = d.x * d.x + d.y * d.y + d.z * d.z;
    const double inset = shape.inset / std::sqrt(length_sq),
                 turn = (d.x * by.x + d.y * by.y + d.z * by.z) / length_sq;
    return from_axes(shape, {a * (q.x - along * p.x) / size - inset * (by.x - turn * d.x),
                             b * (q.y - along * p.y) / size - inset * (by.y - turn * d.y),
                             c * (q.z - along * p.z) / size - inset * (by.z - turn * d.z)});
}

} // namespace

Vec3 LocalCore::point(const Vec3& direction) const {
    if (curved)
        return farthest(*shape, direction);
    return rim > 0 ? fixed + rim * round_point(*shape, along_axes(*shape, direction)) : fixed;
}

Vec3 LocalCore::derivative(const Vec3& direction, const Vec3& along) const {
    const Local d = along_axes(*shape, direction), by = along_axes(*shape, along);
    if (curved)
        return ellipsoid_derivative(*shape, d, by);
    return rim > 0 ? rim * round_derivative(*shape, d, by) : Vec3{};
}

LocalCore local_core(const SupportPair& pair, PairSide side, const SupportSimplex& nearest,
                     const Vec3& direction) {
    LocalCore core;
    core.shape = side == PairSide::a ? &pair.a() : &pair.b();
    const DifferencePoint points = nearest.nearest();
    // Points of b are relative to a's centre.
    const Vec3 at = side == PairSide::a ? points.a : points.b - pair.offset();
    switch (core.shape->kind) {
    case CoreKind::box:
        place_on_box(core, at, direction);
        break;
    case CoreKind::cylinder:
        place_on_cylinder(core, along_axes(*core.shape, at), direction);
        break;
    case CoreKind::cone:
        place_on_cone(core, along_axes(*core.shape, at), direction);
        break;
    case CoreKind::ellipsoid:
        place_on_ellipsoid(core, at, direction);
        break;
    default:
        place_on_corners(core, side, nearest, at, direction);
        break;
    }
    return core;
}

} // namespace abut
