#include "convex/support/local_core.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace abut {

namespace {

/// A point that is nearer than this to the border of a feature, relative to the feature, is taken to be
/// on the border. Points of a search are known to about 1e-8.
constexpr double kBorder = 1e-6;
/// A point that is nearer than this to the border of a feature, in the pair's frame or relative to the
/// feature, may be on either side of it.
constexpr double kUnsure = 0x1p-12;
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

/// Whether a point is in the inside of a feature, on its border, or may be either. The likelier comes first.
struct Choices {
    std::array<bool, 2> inside{};
    std::size_t count = 0;

    /// In          from_border: how far inside the point is. size: of the feature. allowed: the
    ///             direction agrees with the inside.
    Choices(double from_border, double size, bool allowed) {
        const bool likely = allowed && from_border > kBorder * size;
        inside[count++] = likely;
        if (allowed && std::abs(from_border) <= std::max(kUnsure, kUnsure * size))
            inside[count++] = !likely;
    }
    [[nodiscard]] const bool* begin() const { return inside.data(); }
    [[nodiscard]] const bool* end() const { return inside.data() + count; }
};

void keep(LocalCores& cores, const LocalCore& core) {
    if (cores.size() < cores.capacity())
        cores.push_back(core);
}

/// Places the point along the axes from the k-th on.
void place_on_box(LocalCores& cores, const LocalCore& so_far, std::size_t k, const Vec3& at,
                  const Vec3& direction) {
    if (k == 3)
        return keep(cores, so_far);
    const SupportShape& box = *so_far.shape;
    const double along = dot(box.axis[k], at), half = box.half[k];
    const double room = half - std::abs(along);
    for (const bool inside :
         Choices(room, half, half > 0 && std::abs(dot(box.axis[k], direction)) <= kAgreement)) {
        LocalCore core = so_far;
        core.fixed =
            core.fixed +
            (inside ? std::clamp(along, -half, half) : with_sign(half, along)) * box.axis[k];
        if (inside) {
            add_rule(core, box.axis[k], 0, direction);
        }
        place_on_box(cores, core, k + 1, at, direction);
    }
}

/// The face of a cylinder's or cone's end, at this height.
LocalCore on_disc(LocalCore core, const Local& at, double height, const Vec3& direction) {
    const double across = std::hypot(at.x, at.y), radius = core.shape->half[0],
                 part = across > radius ? radius / across : 1;
    core.fixed = from_axes(*core.shape, {part * at.x, part * at.y, height});
    add_rule(core, core.shape->axis[0], 0, direction);
    add_rule(core, core.shape->axis[1], 0, direction);
    return core;
}

/// The rim of a disc of `part` of the radius, at this height.
LocalCore on_rim(LocalCore core, double part, double height) {
    core.rim = part, core.fixed = height * core.shape->axis[2];
    return core;
}

void place_on_cylinder(LocalCores& cores, const LocalCore& empty, const Local& at,
                       const Vec3& direction) {
    const SupportShape& cylinder = *empty.shape;
    const Local d = along_axes(cylinder, direction);
    const double radius = cylinder.half[0], half = cylinder.half[2];
    for (const bool in_disc :
         Choices(radius - std::hypot(at.x, at.y), radius, std::hypot(d.x, d.y) <= kAgreement)) {
        if (in_disc) {
            keep(cores, on_disc(empty, at, with_sign(half, d.z), direction));
            continue;
        }
        const double room = half - std::abs(at.z);
        for (const bool on_side : Choices(room, half, std::abs(d.z) <= kAgreement)) {
            if (!on_side) {
                keep(cores, on_rim(empty, 1, with_sign(half, at.z)));
                continue;
            }
            LocalCore core = on_rim(empty, 1, std::clamp(at.z, -half, half));
            add_rule(core, cylinder.axis[2], 0, direction);
            keep(cores, core);
        }
    }
}

void place_on_cone(LocalCores& cores, const LocalCore& empty, const Local& at,
                   const Vec3& direction) {
    const SupportShape& cone = *empty.shape;
    const Local d = along_axes(cone, direction);
    const double radius = cone.half[0], half = cone.half[2];
    // The side's normals make a fixed angle with the axis. Its points are between apex and rim.
    const double side = std::hypot(radius, 2 * half), slope = radius / side;
    const double down = half > 0 ? std::clamp((half - at.z) / (2 * half), 0.0, 1.0) : 1;
    const double room = std::min(down, 1 - down) * side;
    for (const bool in_disc : Choices(radius - std::hypot(at.x, at.y), radius,
                                      d.z < 0 && std::hypot(d.x, d.y) <= kAgreement)) {
        if (in_disc) {
            keep(cores, on_disc(empty, at, -half, direction));
            continue;
        }
        for (const bool on_side : Choices(room, side, std::abs(d.z - slope) <= kAgreement)) {
            if (!on_side) {
                keep(cores, on_rim(empty, down < 0.5 ? 0 : 1, down < 0.5 ? half : -half));
                continue;
            }
            LocalCore core = on_rim(empty, down, (1 - 2 * down) * half);
            add_rule(core, cone.axis[2], slope, direction);
            keep(cores, core);
        }
    }
}

void place_on_ellipsoid(LocalCores& cores, const LocalCore& empty, const Vec3& at,
                        const Vec3& direction) {
    const SupportShape& ellipsoid = *empty.shape;
    double inside = 0, least = std::numeric_limits<double>::infinity();
    bool flat = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const double half = ellipsoid.half[k];
        const double ratio = half > 0 ? dot(ellipsoid.axis[k], at) / half : 0;
        inside += ratio * ratio, flat = flat || half == 0;
        least = half > 0 ? std::min(least, half) : least;
    }
    const double room = flat ? (1 - std::sqrt(inside)) * least : 0;
    for (const bool in_disc : Choices(room, least, flat)) {
        LocalCore core = empty;
        core.curved = !in_disc;
        if (in_disc) {
            core.fixed = inside > 1 ? (1 / std::sqrt(inside)) * at : at;
            core.room = std::max(room, 0.0);
            for (std::size_t k = 0; k < 3; ++k)
                if (ellipsoid.half[k] > 0)
                    add_rule(core, ellipsoid.axis[k], 0, direction);
        }
        keep(cores, core);
    }
}

/// The corners of a triangle or polytope that carry weight.
struct WeightedCorners {
    std::array<Vec3, 4> corner;
    std::array<double, 4> weight{};
    std::size_t count = 0;

    WeightedCorners(PairSide side, const SupportSimplex& nearest, double no_weight) {
        for (std::uint32_t i = 0; i < nearest.count; ++i) {
            if (!(nearest.weights[i] > no_weight))
                continue;
            const Vec3 p = side == PairSide::a ? nearest.corners[i].a : nearest.corners[i].b;
            const std::size_t k = static_cast<std::size_t>(
                std::find(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(count), p) -
                corner.begin());
            corner[k] = p, weight[k] += nearest.weights[i];
            count = std::max(count, k + 1);
        }
    }
    /// The corners' mean by their weights.
    [[nodiscard]] Vec3 mean() const {
        Vec3 sum;
        double all = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum = sum + weight[i] * corner[i], all += weight[i];
        return all > 0 ? (1 / all) * sum : sum;
    }
};

/// In          offset: of the shape's corners in the simplex.
void place_on_corners(LocalCores& cores, const LocalCore& empty, PairSide side,
                      const SupportSimplex& nearest, const Vec3& offset, const Vec3& direction) {
    // A corner of little weight may be none of the feature's.
    std::size_t last = 0;
    for (const double no_weight : {1e-7, 1e-4, 1e-2, 0.0}) {
        const WeightedCorners found(side, nearest, no_weight);
        const auto& [corner, weight, count] = found;
        if (count == 0 || count == last)
            continue;
        last = count;
        LocalCore core = empty;
        core.fixed = found.mean() - offset;
        for (std::size_t i = 1; i < count; ++i)
            add_rule(core, normalized_or_zero(corner[i] - corner[0]), 0, direction);
        // The weight of a corner is the point's height above the opposite side, relative to the corner's.
        for (std::size_t i = 0; i < count && count > 1; ++i) {
            const Vec3 &next = corner[(i + 1) % count], way = corner[i] - next,
                       edge = normalized_or_zero(corner[(i + 2) % count] - next);
            const double height = count == 2 ? length(way) : length(cross(way, edge));
            core.room = std::min(core.room, weight[i] * height);
        }
        keep(cores, core);
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

bool LocalCore::may_move(const Vec3& from, const Vec3& by, double error) const {
    const auto& [a, b, c] = shape->half;
    const Local at = along_axes(*shape, from + by);
    const double across = std::hypot(at.x, at.y);
    switch (shape->kind) {
    case CoreKind::box:
        return std::abs(at.x) <= a + error && std::abs(at.y) <= b + error &&
               std::abs(at.z) <= c + error;
    case CoreKind::cylinder:
        return across <= a + error && std::abs(at.z) <= c + error;
    case CoreKind::cone: { // below the side
        const double side = std::hypot(a, 2 * c);
        return std::abs(at.z) <= c + error && across <= a + error &&
               2 * c * across <= a * (c - at.z) + error * side;
    }
    default:
        return length(by) <= room + error;
    }
}

LocalCores local_cores(const SupportPair& pair, PairSide side, const SupportSimplex& nearest,
                       const Vec3& direction) {
    LocalCore empty;
    empty.shape = side == PairSide::a ? &pair.a() : &pair.b();
    const DifferencePoint points = nearest.nearest();
    // Points of b are relative to a's centre.
    const Vec3 offset = side == PairSide::a ? Vec3{} : pair.offset();
    const Vec3 at = (side == PairSide::a ? points.a : points.b) - offset;
    LocalCores cores;
    switch (empty.shape->kind) {
    case CoreKind::box:
        place_on_box(cores, empty, 0, at, direction);
        break;
    case CoreKind::cylinder:
        place_on_cylinder(cores, empty, along_axes(*empty.shape, at), direction);
        break;
    case CoreKind::cone:
        place_on_cone(cores, empty, along_axes(*empty.shape, at), direction);
        break;
    case CoreKind::ellipsoid:
        place_on_ellipsoid(cores, empty, at, direction);
        break;
    default:
        place_on_corners(cores, empty, side, nearest, offset, direction);
        break;
    }
    return cores;
}

} // namespace abut
