#include "volume/sphere.h"

#include "math/rounding.h"
#include "volume/aabb.h"
#include "volume/float_vector.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace abut {

namespace {

/// The smallest ball with some points on its surface. Without points, it excludes every point. A
/// point in the affine hull of those before it is ignored.
class Support {
public:
    [[nodiscard]] Support with(const Vec3& p) const {
        Support next = *this;
        if (count_ == 0) {
            next.ball_ = {p, 0};
            next.count_ = 1;
            return next;
        }
        // The new centre lies on a line through the old centre. The line is orthogonal to the
        // affine hull of the old points and lies in that of all points.
        const Vec3 d = p - ball_.centre;
        Vec3 normal = p - origin();
        for (std::size_t i = 0; i + 1 < count_; ++i)
            normal = normal - dot(normal, basis_[i]) * basis_[i];
        const double height = length(normal);
        if (!(height > 1e-10 * length(p - origin())))
            return next;
        normal = (1 / height) * normal;
        // |d - s n|^2 = r^2 + s^2
        const double s = (length_sq(d) - ball_.radius * ball_.radius) / (2 * dot(d, normal));
        next.basis_[count_ - 1] = normal;
        next.ball_ = {ball_.centre + s * normal, std::hypot(ball_.radius, s)};
        if (count_ == 1)
            next.origin_ = origin();
        ++next.count_;
        return next;
    }
    [[nodiscard]] bool full() const { return count_ == 4; }
    [[nodiscard]] bool excludes(const Vec3& p) const {
        return count_ == 0 || length(p - ball_.centre) > ball_.radius * (1 + 1e-12);
    }
    [[nodiscard]] const Ball& ball() const { return ball_; }

private:
    [[nodiscard]] const Vec3& origin() const { return count_ == 1 ? ball_.centre : origin_; }

    std::size_t count_ = 0;
    Ball ball_;
    Vec3 origin_; ///< the first point
    std::array<Vec3, 3> basis_;
};

/// The smallest ball around the points that has those of `support` on its surface.
Support smallest_ball(std::span<const Vec3> points, const Support& support) {
    Support best = support;
    if (support.full())
        return best;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (best.excludes(points[i]))
            best = smallest_ball(points.first(i), support.with(points[i]));
    return best;
}

/// The vertices that are extreme, in both senses, along the axes and diagonals of the cube.
std::vector<Vec3> extreme_vertices(std::span<const Triangle> triangles) {
    constexpr std::array<Vec3, 13> kWays{
        Vec3{1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
        {0, 1, 1},     {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
    std::vector<Vec3> extremes;
    for (const Vec3& direction : kWays) {
        const Vec3 *low = &triangles[0][0], *high = low;
        double least = dot(direction, *low), most = least;
        for (const Triangle& t : triangles)
            for (const Vec3& p : t) {
                const double x = dot(direction, p);
                if (x < least)
                    least = x, low = &p;
                if (x > most)
                    most = x, high = &p;
            }
        extremes.push_back(*low);
        extremes.push_back(*high);
    }
    return extremes;
}

} // namespace

BoundingSphere BoundingSphere::fit(std::span<const Triangle> triangles, double margin) {
    Ball ball = smallest_ball(extreme_vertices(triangles), {}).ball();
    for (const Triangle& t : triangles)
        for (const Vec3& p : t) {
            const double far = length(p - ball.centre);
            if (far > ball.radius) {
                const double grown = 0.5 * (ball.radius + far);
                ball.centre = ball.centre + ((grown - ball.radius) / far) * (p - ball.centre);
                ball.radius = grown;
            }
        }
    // Corrects all rounding so far: the radius is measured from the centre as it is stored.
    BoundingSphere sphere;
    sphere.centre = to_float(ball.centre);
    double radius = 0;
    for (const Triangle& t : triangles)
        for (const Vec3& p : t)
            radius = std::max(radius, length(p - to_double(sphere.centre)));
    sphere.radius = round_up(radius * (1 + 16 * 0x1p-53) + 2 * margin + kUnderflow);
    return sphere;
}

BoundingSphere BoundingSphere::merge(const BoundingSphere& a, const BoundingSphere& b) {
    const Vec3 ca = to_double(a.centre), cb = to_double(b.centre);
    const double apart = length(cb - ca);
    // The extreme points of both balls on the line through the centres, measured from a's centre.
    const double low = std::min(-double{a.radius}, apart - b.radius),
                 high = std::max(double{a.radius}, apart + b.radius);
    BoundingSphere sphere;
    sphere.centre = to_float(apart > 0 ? ca + (0.5 * (low + high) / apart) * (cb - ca) : ca);
    const Vec3 c = to_double(sphere.centre);
    sphere.radius = round_up(std::max(length(ca - c) + a.radius, length(cb - c) + b.radius) *
                             (1 + 16 * 0x1p-53));
    return sphere;
}

} // namespace abut
