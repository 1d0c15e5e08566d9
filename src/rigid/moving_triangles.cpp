#include "rigid/moving_triangles.h"

#include "math/vector.h"
#include "rigid/motion_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// How a vertex moves along a direction.
struct VertexMotion {
    double height, speed;
};

class TrianglesInMotion {
public:
    TrianglesInMotion(const MovingPair& pair, double time, const Triangle& a, const Triangle& b,
                      const Vec3& origin)
        : pair_(pair), a_(measure(pair.a.trajectory, a, origin, time)),
          b_(measure(pair.b.trajectory, b, origin, time)) {}

    struct Result {
        double gap;  ///< along the direction; negative: it does not separate them
        double time; ///< for which they stay apart
    };

    /// Vertex by vertex: triangles stay on their sides of a plane while all their vertices do.
    [[nodiscard]] Result along(const Vec3& n) const {
        const double bend =
            bend_along(a_, pair_.a.trajectory, n) + bend_along(b_, pair_.b.trajectory, n);
        const auto project = [&](const Body& body) {
            std::array<VertexMotion, 3> result{};
            for (std::size_t i = 0; i < 3; ++i)
                result[i] = {dot(n, body.vertices[i]), dot(n, body.velocities[i])};
            return result;
        };
        const auto of_a = project(a_), of_b = project(b_);
        Result result{std::numeric_limits<double>::infinity(),
                      std::numeric_limits<double>::infinity()};
        for (const VertexMotion& p : of_a)
            for (const VertexMotion& q : of_b) {
                const double gap = q.height - p.height;
                result.gap = std::min(result.gap, gap);
                result.time =
                    std::min(result.time,
                             free_time({gap - pair_.margin, p.speed - q.speed, bend, pair_.speed}));
            }
        return result;
    }

    /// The longest time that a direction shows in which faces or edges part the triangles: such a
    /// direction is exact to rounding however near they are, where that of the closest points, a
    /// difference of almost equal points, is not.
    [[nodiscard]] double along_features(const Vec3& nearly) const {
        double best = 0;
        const auto attempt = [&](const Vec3& direction) {
            const Vec3 n = normalized_or_zero(direction);
            best = std::max(best, along(dot(n, nearly) < 0 ? -n : n).time);
        };
        const auto edges_a = edges(a_), edges_b = edges(b_);
        attempt(cross(edges_a[0], edges_a[1]));
        attempt(cross(edges_b[0], edges_b[1]));
        const auto across = [&](const Vec3& edge) {
            const Vec3 e = normalized_or_zero(edge);
            attempt(nearly - dot(nearly, e) * e);
        };
        for (const Vec3& e : edges_a) {
            across(e);
            for (const Vec3& f : edges_b)
                attempt(cross(e, f));
        }
        for (const Vec3& f : edges_b)
            across(f);
        return best;
    }

private:
    struct Body {
        Triangle vertices, velocities; ///< vertices relative to the origin
        double arm = 0;                ///< no vertex is farther from the axis of rotation
    };

    static Body measure(const Trajectory& trajectory, const Triangle& t, const Vec3& origin,
                        double time) {
        Body body;
        for (std::size_t i = 0; i < 3; ++i) {
            body.vertices[i] = t[i] - origin;
            body.velocities[i] = trajectory.velocity_at(t[i], time);
            body.arm = std::max(body.arm, trajectory.axis_distance(t[i], time));
        }
        return body;
    }
    static double bend_along(const Body& body, const Trajectory& trajectory, const Vec3& n) {
        return length(cross(n, trajectory.angular_velocity())) * trajectory.speed_of_rotation() *
               body.arm;
    }
    static std::array<Vec3, 3> edges(const Body& body) {
        const Triangle& t = body.vertices;
        return {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    }

    const MovingPair& pair_;
    Body a_, b_;
};

} // namespace

double free_time(const MovingPair& pair, double time, const Triangle& a, const Triangle& b,
                 const ClosestPoints& closest) {
    const Vec3 between = closest.b - closest.a;
    const double gap = length(between);
    // Whatever the direction.
    const double least = free_time({gap - pair.margin, pair.speed, 0, pair.speed});
    if (least == 0)
        return 0;
    const Vec3 n = (1 / gap) * between;
    const TrianglesInMotion triangles(pair, time, a, b, closest.a);
    const TrianglesInMotion::Result result = triangles.along(n);
    const bool is_exact = result.gap >= 0.5 * gap;
    return std::max({least, result.time, is_exact ? 0 : triangles.along_features(n)});
}

} // namespace abut
