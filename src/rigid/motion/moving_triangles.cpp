#include "rigid/motion/moving_triangles.h"

#include "math/vector.h"
#include "rigid/motion/motion_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// How often a horizon is shortened while much less time is proven than it allows.
constexpr int kHorizonRounds = 3;
/// A plane that does not turn is good enough if it proves this share of the time that may be hoped
/// for.
constexpr double kGoodEnough = 0.25;
/// Far above the rounding of a sum of a few products, relative to its terms.
constexpr double kSumRounding = 0x1p-47;

/// The motion of a vertex along a direction.
struct VertexMotion {
    double height, speed;
};

struct MovingTriangle {
    const Trajectory& trajectory;
    Triangle vertices;              ///< relative to a point near both triangles
    std::array<Vec3, 3> velocities; ///< of the vertices
    std::array<double, 3> arms{};   ///< distances of the vertices from the axis of rotation
    double arm = 0;                 ///< the longest

    MovingTriangle(const Trajectory& t, const Triangle& world, const Vec3& origin, double time)
        : trajectory(t) {
        for (std::size_t i = 0; i < 3; ++i) {
            vertices[i] = world[i] - origin;
            velocities[i] = t.velocity_at(world[i], time);
            arms[i] = t.axis_distance(world[i], time);
            arm = std::max(arm, arms[i]);
        }
    }
    [[nodiscard]] const Vec3& spin() const { return trajectory.angular_velocity(); }
    [[nodiscard]] double rate() const { return trajectory.speed_of_rotation(); }
    [[nodiscard]] std::array<Vec3, 3> edges() const {
        return {vertices[1] - vertices[0], vertices[2] - vertices[1], vertices[0] - vertices[2]};
    }
};

/// Bounds |n x x| within a time in which n turns at the rate `turning`.
double most_across(const Vec3& n, const Vec3& x, double turning, double time) {
    const double size = length(x);
    return std::min(size, length(cross(n, x)) + time * turning * size);
}

/// A function of time by its first value, the speed of its first decrease, and a bound of its
/// second derivative.
struct HeightBound {
    double value = 0, decrease = 0, bend = 0;

    HeightBound& operator+=(const HeightBound& x) {
        value += x.value, decrease += x.decrease, bend += x.bend;
        return *this;
    }
};

/// Two triangles of turning bodies, with their closest points.
class TrianglesInMotion {
public:
    TrianglesInMotion(const MovingPair& pair, double time, const Triangle& a, const Triangle& b,
                      const ClosestPoints& closest)
        : pair_(pair), time_(time), closest_(closest), a_(pair.a.trajectory, a, closest.a, time),
          b_(pair.b.trajectory, b, closest.a, time) {}

    [[nodiscard]] const MovingTriangle& a() const { return a_; }
    [[nodiscard]] const MovingTriangle& b() const { return b_; }

    struct Result {
        double gap;  ///< along the direction; negative if the direction does not separate them
        double time; ///< how long they stay apart
    };

    /// Separates the triangles by a plane that does not turn. Each pair of vertices gives a time:
    /// triangles stay on their sides of a plane as long as all their vertices do.
    [[nodiscard]] Result along(const Vec3& n) const {
        const double bend = bend_along(a_, n) + bend_along(b_, n);
        const auto project = [&](const MovingTriangle& body) {
            std::array<VertexMotion, 3> result{};
            for (std::size_t i = 0; i < 3; ++i)
                result[i] = {dot(n, body.vertices[i]), dot(n, body.velocities[i])};
            return result;
        };
        const auto of_a = project(a_), of_b = project(b_);
        Result result{kUnbounded, kUnbounded};
        for (const VertexMotion& p : of_a)
            for (const VertexMotion& q : of_b) {
                const double gap = q.height - p.height;
                result.gap = std::min(result.gap, gap);
                result.time = std::min(
                    result.time,
                    free_time({gap - pair_.reach(), p.speed - q.speed, bend, pair_.speed}));
            }
        return result;
    }

    /// Computes the members that the functions below need.
    void look_at_both() {
        velocity_ = pair_.b.trajectory.velocity() - pair_.a.trajectory.velocity();
        spin_ = b_.spin() - a_.spin();
        between_ = closest_.b - closest_.a;
        closing_in_a_ = pair_.b.trajectory.velocity_at(closest_.b, time_) -
                        pair_.a.trajectory.velocity_at(closest_.b, time_);
        turning_of_b_ = b_.rate() * pair_.b.trajectory.axis_distance(closest_.b, time_);
    }

    /// Estimates how long the closest points alone would stay apart if a plane turned with the
    /// better of the two bodies. Proves nothing.
    [[nodiscard]] double hope(const Vec3& n) const {
        const double turning_of_a = a_.rate() * pair_.a.trajectory.axis_distance(closest_.a, time_);
        const double spin = length(spin_), moving = length(velocity_) + length(closing_in_a_);
        const double bend = std::min(spin * turning_of_b_ + a_.rate() * moving,
                                     spin * turning_of_a + b_.rate() * moving);
        return free_time(
            {length(between_) - pair_.radius, -dot(n, closing_in_a_), bend, kUnbounded});
    }

    /// Separates the triangles by a plane that turns with one of the bodies, for at most `horizon`.
    /// However large that body's triangle is, only the other's vertices move. n: from a to b.
    [[nodiscard]] double along_with(const MovingTriangle& own, const Vec3& n,
                                    double horizon) const {
        const bool is_a = &own == &a_;
        const MovingTriangle& other = is_a ? b_ : a_;
        const Vec3 up = is_a ? n : -n;
        const double highest = std::max(
            {dot(up, own.vertices[0]), dot(up, own.vertices[1]), dot(up, own.vertices[2])});
        const double across_own = length(cross(up, own.spin()));
        double proven = kUnbounded;
        for (std::size_t j = 0; j < 3 && proven > 0; ++j) {
            const Vec3 u = other.velocities[j] -
                           own.trajectory.velocity_at(closest_.a + other.vertices[j], time_);
            const double turning = other.rate() * other.arms[j];
            const double gap = dot(up, other.vertices[j]) - highest - pair_.reach();
            proven = std::min(proven, in_rounds(horizon, [&](double end) {
                                  const double fastest = most_speed(u, own, turning, end);
                                  const double bend =
                                      most_across(up, spin_, across_own, end) * turning +
                                      across_own * (length(velocity_) + fastest);
                                  return free_time({gap, -dot(up, u), bend, fastest});
                              }));
        }
        return proven;
    }

    /// Separates the triangles by a plane parallel to an edge of each, with unit directions e and
    /// f.
    [[nodiscard]] double along_edges(const Vec3& e_any, const Vec3& f, double horizon) const {
        const double sign = dot(between_, cross(e_any, f)) < 0 ? -1 : 1;
        const Vec3 e = sign * e_any, n = cross(e, f);
        const double sine = length(n);
        if (!(dot(between_, n) > pair_.reach() * sine))
            return 0;
        return in_rounds(horizon, [&](double end) { return along_edges(e, f, n, sine, end); });
    }

private:
    static double bend_along(const MovingTriangle& body, const Vec3& n) {
        return length(cross(n, body.spin())) * body.rate() * body.arm;
    }

    /// Bounds, until the time `end`, the speed relative to the own body of a point of the other one
    /// that has the relative velocity u now and turns at the given speed.
    [[nodiscard]] double most_speed(const Vec3& u, const MovingTriangle& own, double turning,
                                    double end) const {
        return kHorizonGrowth *
               (length(u) + end * (length(spin_) * turning + own.rate() * length(velocity_)));
    }

    /// The longest time that a bound proves, over horizons that are shortened step by step.
    template <class Bound>
    [[nodiscard]] double in_rounds(double horizon, const Bound& bound) const {
        const double most = kHorizonTurn / (a_.rate() + b_.rate());
        double end = std::min(horizon, most), proven = 0;
        for (int round = 0; round < kHorizonRounds; ++round) {
            const double time = bound(end);
            if (time > 0 && time >= end) {
                proven = std::max(proven, end < horizon ? end : kUnbounded);
                break;
            }
            proven = std::max(proven, time);
            if (time > 0.5 * end || time <= 0)
                break;
            end = 2 * time;
        }
        return proven;
    }

    [[nodiscard]] double along_edges(const Vec3& e, const Vec3& f, const Vec3& n, double sine,
                                     double end) const {
        const double spin = length(spin_), spin_of_e = length(cross(a_.spin(), e)),
                     spin_of_f = length(cross(b_.spin(), f));
        const Vec3 turned_e = cross(spin_, e), turned_f = cross(spin_, f);
        const double across_e = std::min(spin, length(turned_e) + end * spin * spin_of_e),
                     across_f = std::min(spin, length(turned_f) + end * spin * spin_of_f);
        // The closest points.
        const double fastest = most_speed(closing_in_a_, a_, turning_of_b_, end);
        const double most_bend = spin * turning_of_b_ + a_.rate() * (length(velocity_) + fastest);
        const double most_sine = std::min(1.0, sine + end * across_f);
        const double sideways =
            std::min(fastest, length(cross(e, closing_in_a_)) + end * most_bend);
        const double distance = length(between_) + end * fastest;
        const double turned = dot(between_, cross(e, turned_f));
        const double lost = kSumRounding * (fastest + spin * distance) + pair_.reach() * across_f;
        const HeightBound middle{dot(between_, n) - pair_.reach() * sine - kSumRounding * distance,
                                 -(dot(closing_in_a_, n) + turned) + lost,
                                 most_bend * most_sine + 2 * sideways * across_f +
                                     distance * (spin * spin_of_f + a_.rate() * across_f)};
        // How far the vertices lie behind the closest points.
        std::array<HeightBound, 3> of_a, of_b;
        const auto behind = [&](const Vec3& w, const Vec3& direction, const Vec3& turned_direction,
                                const MovingTriangle& own, double spin_of_other,
                                double across_other) {
            const double size = length(w);
            const Vec3 unit = normalized_or_zero(w);
            const double turning = length(cross(unit, own.spin()));
            return HeightBound{dot(w, direction) - kSumRounding * size,
                               -dot(w, turned_direction) + kSumRounding * size * spin,
                               size * (most_across(unit, spin_, turning, end) * spin_of_other +
                                       turning * across_other)};
        };
        for (std::size_t i = 0; i < 3; ++i) {
            of_a[i] = behind(-cross(a_.vertices[i], e), f, turned_f, a_, spin_of_f, across_f);
            of_b[i] =
                behind(cross(f, b_.vertices[i] - between_), e, -turned_e, b_, spin_of_e, across_e);
        }
        double result = kUnbounded;
        for (const HeightBound& x : of_a)
            for (const HeightBound& y : of_b) {
                HeightBound sum = middle;
                sum += x, sum += y;
                result =
                    std::min(result, free_time({sum.value, sum.decrease, sum.bend, kUnbounded}));
            }
        return result;
    }

    const MovingPair& pair_;
    double time_;
    const ClosestPoints& closest_;
    MovingTriangle a_, b_;
    Vec3 velocity_, spin_;    ///< velocity of b's centre relative to a's; spin of b relative to a
    Vec3 between_;            ///< from the closest point of a to that of b
    Vec3 closing_in_a_;       ///< velocity of the closest point of b relative to a
    double turning_of_b_ = 0; ///< speed of that point about the axis of b
};

/// Returns whether an edge belongs to the feature of a triangle that holds the closest point.
bool is_near(std::size_t edge, const TriangleFeature& on) {
    return on.kind == Feature::face || on.index == edge ||
           (on.kind == Feature::vertex && on.index == (edge + 1) % 3);
}

} // namespace

double free_time(const MovingPair& pair, double time, const Triangle& a, const Triangle& b,
                 const ClosestPoints& closest, double horizon) {
    const Vec3 between = closest.b - closest.a;
    const double gap = length(between);
    // A bound for any direction.
    const double least = free_time({gap - pair.reach(), pair.speed, 0, pair.speed});
    if (least == 0)
        return 0;
    const Vec3 n = (1 / gap) * between;
    TrianglesInMotion triangles(pair, time, a, b, closest);
    const TrianglesInMotion::Result result = triangles.along(n);
    const bool is_exact = result.gap - pair.radius >= 0.5 * (gap - pair.radius);
    double best = std::max(least, result.time);
    const bool turns = triangles.a().rate() > 0 || triangles.b().rate() > 0;
    if (best >= horizon || (is_exact && !turns))
        return best;
    const auto with_a_body = [&](const Vec3& up) {
        best = std::max(best, triangles.along_with(triangles.a(), up, horizon));
        best = std::max(best, triangles.along_with(triangles.b(), up, horizon));
    };
    const auto edges_a = triangles.a().edges(), edges_b = triangles.b().edges();
    if (turns) {
        triangles.look_at_both();
        if (is_exact && best >= kGoodEnough * triangles.hope(n))
            return best;
        with_a_body(n);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                if (best < horizon && is_near(i, closest.on_a) && is_near(j, closest.on_b))
                    best = std::max(best,
                                    triangles.along_edges(normalized_or_zero(edges_a[i]),
                                                          normalized_or_zero(edges_b[j]), horizon));
    }
    if (is_exact || best >= horizon)
        return best;
    // The direction of the closest points is a difference of almost equal points. If its rounding
    // is too large, a direction from faces or edges that part the triangles is exact to rounding,
    // however near the triangles are.
    const auto attempt = [&](const Vec3& direction) {
        const Vec3 unit = normalized_or_zero(direction), up = dot(unit, n) < 0 ? -unit : unit;
        best = std::max(best, triangles.along(up).time);
        if (turns)
            with_a_body(up);
    };
    attempt(cross(edges_a[0], edges_a[1]));
    attempt(cross(edges_b[0], edges_b[1]));
    const auto across = [&](const Vec3& edge) {
        const Vec3 e = normalized_or_zero(edge);
        attempt(n - dot(n, e) * e);
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

} // namespace abut
