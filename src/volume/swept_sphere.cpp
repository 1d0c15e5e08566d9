#include "volume/swept_sphere.h"

#include "math/rounding.h"
#include "volume/aabb.h"
#include "volume/float_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

/// An interval of one coordinate.
struct Extent {
    double low = std::numeric_limits<double>::infinity(),
           high = -std::numeric_limits<double>::infinity();
    [[nodiscard]] double middle() const { return 0.5 * low + 0.5 * high; }
    [[nodiscard]] double half() const { return std::max(0.0, 0.5 * high - 0.5 * low); }
};

/// Balls in the frame of given axes, which are reordered so that the widest extent comes first.
struct AlignedBalls {
    Axes axes;
    Vec3 origin;
    std::vector<Ball> balls;

    AlignedBalls(std::span<const Ball> given, const Axes& directions)
        : axes(directions), origin(given[0].centre) {
        std::array<Extent, 3> extents;
        for (const Ball& ball : given)
            for (std::size_t i = 0; i < 3; ++i) {
                const double x = dot(axes[i], ball.centre - origin);
                extents[i].low = std::min(extents[i].low, x - ball.radius);
                extents[i].high = std::max(extents[i].high, x + ball.radius);
            }
        std::array<std::size_t, 3> order{0, 1, 2};
        std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
            return extents[i].half() > extents[k].half();
        });
        axes = {directions[order[0]], directions[order[1]], directions[order[2]]};
        origin = origin + extents[order[0]].middle() * axes[0] +
                 extents[order[1]].middle() * axes[1] + extents[order[2]].middle() * axes[2];
        for (const Ball& ball : given) {
            const Vec3 d = ball.centre - origin;
            balls.push_back({{dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)}, ball.radius});
        }
    }
};

/// Reach of a swept ball along a core axis, at a distance `off` from that axis.
double reach_at(double radius, double off) {
    return std::sqrt(std::max(0.0, radius * radius - off * off));
}

/// Where the core ends on each of its axes: as far inside as the radius allows, ignoring the
/// corners.
template <std::size_t dimension>
std::array<Extent, dimension> inset_extents(const AlignedBalls& aligned, double radius) {
    std::array<Extent, dimension> core{};
    for (std::size_t i = 0; i < dimension; ++i) {
        // The ends must be so far out that the swept ball covers every given ball.
        Extent ends;
        for (const Ball& ball : aligned.balls) {
            const std::array x{ball.centre.x, ball.centre.y, ball.centre.z};
            double off_sq = 0;
            for (std::size_t k = dimension; k < 3; ++k)
                off_sq += x[k] * x[k];
            const double reach = reach_at(std::max(0.0, radius - ball.radius), std::sqrt(off_sq));
            ends.high = std::max(ends.high, x[i] - reach);
            ends.low = std::min(ends.low, x[i] + reach);
        }
        const double middle = 0.5 * ends.low + 0.5 * ends.high;
        core[i] = ends.low <= ends.high ? ends : Extent{middle, middle};
    }
    return core;
}

/// Moves a rectangle's corners out along their diagonals until the sweep covers the balls beyond
/// them. With a ball's offsets x, y, z from the corner, m is the smaller solution of
///
///     (x - m)^2 + (y - m)^2 + z^2 = r^2
void reach_corners(const AlignedBalls& aligned, double radius, std::array<Extent, 2>& core) {
    std::array<Extent, 2> grown = core;
    for (const Ball& ball : aligned.balls) {
        const auto beyond = [](double x, const Extent& e) {
            return x > e.high ? x - e.high : x < e.low ? e.low - x : 0;
        };
        const double x = beyond(ball.centre.x, core[0]), y = beyond(ball.centre.y, core[1]);
        const double r = std::max(0.0, radius - ball.radius);
        const double excess = x * x + y * y + ball.centre.z * ball.centre.z - r * r;
        if (!(x > 0 && y > 0 && excess > 0))
            continue;
        const double m = 0.5 * ((x + y) - std::sqrt(std::max(0.0, (x + y) * (x + y) - 2 * excess)));
        const auto extend_to = [&](double c, const Extent& e, Extent& g) {
            if (c > e.high)
                g.high = std::max(g.high, e.high + m);
            else
                g.low = std::min(g.low, e.low - m);
        };
        extend_to(ball.centre.x, core[0], grown[0]);
        extend_to(ball.centre.y, core[1], grown[1]);
    }
    core = grown;
}

/// Distance of a point from a point of the core: from the nearest one, up to rounding.
template <std::size_t dimension>
double distance_from_core(const SweptSphere<dimension>& swept, const Vec3& point) {
    Vec3 d = point - to_double(swept.centre);
    for (const auto& axis : swept.axes) {
        const Vec3 direction = to_double(axis.direction);
        const double half = axis.half;
        d = d - std::clamp(dot(d, direction), -half, half) * direction;
    }
    return length(d);
}

} // namespace

template <std::size_t dimension>
SweptSphere<dimension> fit_balls(std::span<const Ball> balls, const Axes& axes) {
    const AlignedBalls aligned(balls, axes);
    double radius = 0;
    for (const Ball& ball : aligned.balls) {
        const std::array x{ball.centre.x, ball.centre.y, ball.centre.z};
        double off_sq = 0;
        for (std::size_t k = dimension; k < 3; ++k)
            off_sq += x[k] * x[k];
        radius = std::max(radius, std::sqrt(off_sq) + ball.radius);
    }
    auto core = inset_extents<dimension>(aligned, radius);
    if constexpr (dimension == 2)
        reach_corners(aligned, radius, core);

    SweptSphere<dimension> swept;
    Vec3 centre = aligned.origin;
    for (std::size_t i = 0; i < dimension; ++i) {
        centre = centre + core[i].middle() * aligned.axes[i];
        swept.axes[i] = {to_float(aligned.axes[i]), to_float({core[i].half(), 0, 0})[0]};
    }
    swept.centre = to_float(centre);
    // This radius makes the volume enclose the balls, whatever was rounded or estimated before. Its
    // own error comes from differences, two subtracted multiples and a length: fewer than 64
    // roundings, relative to the point's distance from the centre.
    double largest = 0;
    for (const Ball& ball : balls)
        largest =
            std::max(largest, distance_from_core(swept, ball.centre) + ball.radius +
                                  64 * 0x1p-53 * length(ball.centre - to_double(swept.centre)));
    swept.radius = round_up(largest * (1 + 4 * 0x1p-53) + kUnderflow);
    return swept;
}

template <std::size_t dimension>
void add_corners(const SweptSphere<dimension>& swept, std::vector<Ball>& balls) {
    for (unsigned corner = 0; corner < 1U << dimension; ++corner) {
        Vec3 p = to_double(swept.centre);
        double size = length(p);
        for (std::size_t i = 0; i < dimension; ++i) {
            const double half = swept.axes[i].half;
            p = p + ((corner >> i & 1U) != 0 ? half : -half) * to_double(swept.axes[i].direction);
            size += half;
        }
        balls.push_back({p, swept.radius + 16 * 0x1p-53 * size});
    }
}

std::vector<Ball> vertex_balls(std::span<const Triangle> triangles, double margin) {
    std::vector<Ball> vertices;
    vertices.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (const Vec3& p : t)
            vertices.push_back({p, 2 * margin}); // sqrt(3) margin at most
    return vertices;
}

template <std::size_t dimension>
SweptSphere<dimension> SweptSphere<dimension>::fit(std::span<const Triangle> triangles,
                                                   double margin) {
    return fit_balls<dimension>(vertex_balls(triangles, margin), hull_axes(triangles));
}

template <std::size_t dimension>
SweptSphere<dimension> SweptSphere<dimension>::merge(const SweptSphere& a, const SweptSphere& b) {
    std::vector<Ball> corners;
    add_corners(a, corners);
    add_corners(b, corners);
    std::vector<Vec3> points;
    points.reserve(corners.size());
    for (const Ball& ball : corners)
        points.push_back(ball.centre);
    return fit_balls<dimension>(corners, principal_axes(points));
}

template <std::size_t dimension>
double SweptSphere<dimension>::reach() const {
    return (length(to_double(centre)) + double{circumradius()}) * (1 + 0x1p-20);
}

template <std::size_t dimension>
float SweptSphere<dimension>::circumradius() const {
    double sum_sq = 0;
    for (const Axis& axis : axes)
        sum_sq += double{axis.half} * axis.half;
    return round_up((std::sqrt(sum_sq) + radius) * (1 + 8 * 0x1p-24));
}

template <std::size_t dimension>
SweptSphereImage<dimension> image_of(const SweptSphere<dimension>& volume,
                                     const RelativePose& pose) {
    SweptSphereImage<dimension> image;
    image.margin = pose.margin;
    image.circumradius = volume.circumradius() * pose.most_stretch;
    image.swept.centre = apply(pose, volume.centre);
    image.swept.radius = volume.radius * pose.most_stretch;
    for (std::size_t i = 0; i < dimension; ++i) {
        const auto moved = apply_linear(pose, volume.axes[i].direction);
        const float stretch = std::sqrt(dot(moved, moved));
        image.swept.axes[i] = {scaled(1 / stretch, moved), volume.axes[i].half * stretch};
        image.dual[i] = image.swept.axes[i].direction;
    }
    if constexpr (dimension == 2) {
        const auto &u = image.swept.axes[0].direction, &v = image.swept.axes[1].direction;
        const float slant = dot(u, v);
        const float scale = 1 / (1 - slant * slant);
        image.is_slanted = !(std::abs(slant) < 0x1p-20F);
        image.dual = {scaled(scale, minus_scaled(u, slant, v)),
                      scaled(scale, minus_scaled(v, slant, u))};
    }
    return image;
}

template struct SweptSphere<0>;
template struct SweptSphere<1>;
template struct SweptSphere<2>;
template Pss fit_balls(std::span<const Ball>, const Axes&);
template Lss fit_balls(std::span<const Ball>, const Axes&);
template Rss fit_balls(std::span<const Ball>, const Axes&);
template void add_corners(const Rss&, std::vector<Ball>&);
template SweptSphereImage<0> image_of(const SweptSphere<0>&, const RelativePose&);
template SweptSphereImage<1> image_of(const SweptSphere<1>&, const RelativePose&);
template SweptSphereImage<2> image_of(const SweptSphere<2>&, const RelativePose&);

} // namespace abut
