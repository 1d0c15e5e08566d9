#include "rigid/motion/moving_pair.h"

#include <abut/error.h>

#include "rigid/motion/motion_bounds.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Applies the inverse of a rotation.
Vec3 apply_transposed(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
Vec3 translation_of(const Transform& t) {
    return {t.m[9], t.m[10], t.m[11]};
}

Transform unscaled(const Transform& world_from_tree, double scale) {
    Transform t = world_from_tree;
    for (std::size_t i = 0; i < 9; ++i)
        t.m[i] /= scale;
    return t;
}

/// How far a scale may be from uniform, relative to it: less than the axes of nodes are from unit
/// length in single precision, so that the same bounds cover both.
constexpr double kUneven = 0x1p-22;

/// Bounds the distance of the box's points from the origin.
double farthest(const Aabb& box) {
    const auto largest = [&](std::size_t i) {
        return std::max(std::abs(double{box.lower[i]}), std::abs(double{box.upper[i]}));
    };
    return (1 + 0x1p-40) * length({largest(0), largest(1), largest(2)});
}

double determinant(const Transform& t) {
    const auto& m = t.m;
    return dot(Vec3{m[0], m[1], m[2]}, cross(Vec3{m[3], m[4], m[5]}, Vec3{m[6], m[7], m[8]}));
}

MovingPair::Body make_body(const Tree& tree, const Transform& model_from_tree,
                           const Trajectory& trajectory) {
    // The tree's frame is a rotation times a power of two.
    const auto& m = model_from_tree.m;
    const double scale = std::exp2(std::round(std::log2(length({m[0], m[1], m[2]})))) *
                         uniform_scale(trajectory.start());
    const double sign = determinant(trajectory.start()) < 0 ? -1 : 1;
    MovingPair::Body body{trajectory, tree, scale, model_from_tree, {}, {}, sign, 0};
    const Transform world_from_tree =
        unscaled(compose(body.trajectory.at(0), model_from_tree), scale);
    body.centre = apply_transposed(world_from_tree,
                                   body.trajectory.centre(0) - translation_of(world_from_tree));
    body.angular_velocity =
        sign * apply_transposed(world_from_tree, body.trajectory.angular_velocity());
    if (!tree.empty())
        body.reach = scale * (1 + kUneven) * farthest(tree.bounds);
    return body;
}

/// Bounds the speed of any point relative to the body's centre.
double speed_of_turning(const MovingPair::Body& body) {
    return body.trajectory.speed_of_rotation() * (length(body.centre) + body.reach);
}

/// Bounds all coordinates that occur, and all path lengths.
double size_of(const MovingPair::Body& body) {
    const Transform& start = body.trajectory.start();
    const double turning = speed_of_turning(body);
    return length(translation_of(start)) +
           std::max(1.0, uniform_scale(start)) * length(translation_of(body.model_from_tree)) +
           body.reach + length(body.trajectory.velocity()) + turning +
           // The centre counts only as far as the body turns about it.
           std::min(1.0, body.trajectory.speed_of_rotation()) * length(body.trajectory.centre(0));
}

FrameMotion motion_in(const MovingPair::Body& own, const Transform& world_from_own,
                      const MovingPair::Body& other, double time, const MovingPair& pair) {
    const auto turned = [&](const Vec3& v) { return apply_transposed(world_from_own, v); };
    FrameMotion motion;
    const double unit = 1 / own.scale;
    motion.centre_own = unit * own.centre;
    motion.centre_other =
        unit * turned(other.trajectory.centre(time) - translation_of(world_from_own));
    motion.velocity = unit * turned(other.trajectory.velocity() - own.trajectory.velocity());
    motion.spin_own = own.angular_velocity;
    motion.spin_other = own.sign * turned(other.trajectory.angular_velocity());
    motion.rate_own = own.trajectory.speed_of_rotation();
    motion.rate_other = other.trajectory.speed_of_rotation();
    motion.rate_between = length(motion.spin_other - motion.spin_own);
    motion.centres = length(motion.velocity);
    motion.own_from_other = unit * other.scale;
    motion.margin = unit * pair.margin;
    motion.radius = unit * pair.radius * (1 + 0x1p-20);
    return motion;
}

} // namespace

double uniform_scale(const Transform& t) {
    const auto& m = t.m;
    const Vec3 x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]}, z{m[6], m[7], m[8]};
    const double scale = length(x);
    const double allowed = kUneven * scale * scale;
    const bool is_uniform = scale > 0 && std::abs(length_sq(y) - length_sq(x)) <= allowed &&
                            std::abs(length_sq(z) - length_sq(x)) <= allowed &&
                            std::abs(dot(x, y)) <= allowed && std::abs(dot(y, z)) <= allowed &&
                            std::abs(dot(z, x)) <= allowed;
    if (!is_uniform)
        return 0;
    // A rotation to rounding has the scale 1 exactly.
    return std::abs(scale - 1) <= 0x1p-40 ? 1 : scale;
}

MovingPair::MovingPair(const Tree& tree_a, const Transform& model_from_tree_a,
                       const Trajectory& of_a, const Tree& tree_b,
                       const Transform& model_from_tree_b, const Trajectory& of_b, double r)
    : a(make_body(tree_a, model_from_tree_a, of_a)), b(make_body(tree_b, model_from_tree_b, of_b)),
      radius(r) {
    const double turning_a = speed_of_turning(a), turning_b = speed_of_turning(b);
    speed = length(b.trajectory.velocity() - a.trajectory.velocity()) + turning_a + turning_b;
    bend =
        a.trajectory.speed_of_rotation() * turning_a + b.trajectory.speed_of_rotation() * turning_b;
    const double size = size_of(a) + size_of(b) + radius;
    if (!(size < 1e100))
        throw Error(ErrorCode::bad_argument, "motion: coordinates or speeds beyond 1e100");
    margin = 256 * 0x1p-53 * size;
}

double MovingPair::free_time_of_balls(double time, double horizon) const {
    const auto origin = [&](const Body& body) {
        return translation_of(compose(body.trajectory.at(time), body.model_from_tree));
    };
    // Acceleration of a point of a turning body.
    const auto bend_of = [&](const Body& body, const Vec3& x) {
        const double rate = body.trajectory.speed_of_rotation();
        return rate * rate * body.trajectory.axis_distance(x, time);
    };
    const Vec3 at_a = origin(a), at_b = origin(b);
    return free_time(at_b - at_a,
                     b.trajectory.velocity_at(at_b, time) - a.trajectory.velocity_at(at_a, time),
                     bend_of(a, at_a) + bend_of(b, at_b), a.reach + b.reach + reach(), horizon);
}

Moment::Moment(const MovingPair& pair, double t)
    : time(t), world_from_a(pair.a.trajectory.at(t)), world_from_b(pair.b.trajectory.at(t)) {
    const Transform tree_a = compose(world_from_a, pair.a.model_from_tree),
                    tree_b = compose(world_from_b, pair.b.model_from_tree);
    frame = make_pair_frame(pair.a.tree, tree_a, pair.b.tree, tree_b);
    in_a = motion_in(pair.a, unscaled(tree_a, pair.a.scale), pair.b, t, pair);
    in_b = motion_in(pair.b, unscaled(tree_b, pair.b.scale), pair.a, t, pair);
}

} // namespace abut
