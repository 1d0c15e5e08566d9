#include "rigid/moving_boxes.h"

#include <abut/error.h>

#include "rigid/motion_bounds.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The box's hull in the tree's axes. A node's axes are at right angles to a few parts in 2^24.
TreeBox box_between(const Aabb& box, const NodeFrame& frame, double scale) {
    const auto middle = [&](std::size_t i) { return 0.5 * (double{box.lower[i]} + box.upper[i]); };
    const auto half = [&](std::size_t i) { return 0.5 * (double{box.upper[i]} - box.lower[i]); };
    const Vec3 centre{middle(0), middle(1), middle(2)}, h{half(0), half(1), half(2)};
    const double off = 0x1p-20 * (length(centre) + length(h));
    const auto reach = [&](std::size_t k) {
        const auto& t = frame.turn[k];
        return std::abs(double{t[0]}) * h.x + std::abs(double{t[1]}) * h.y +
               std::abs(double{t[2]}) * h.z + off;
    };
    return {scale * frame.point_to_tree(centre), scale * Vec3{reach(0), reach(1), reach(2)},
            scale * (length(h) + 2 * off)};
}

/// Of a rotation: its transpose takes back.
Vec3 apply_transposed(const Transform& t, const Vec3& v) {
    const auto& m = t.m;
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
Vec3 translation_of(const Transform& t) {
    return {t.m[9], t.m[10], t.m[11]};
}

MovingPair::Body make_body(const Tree& tree, const Transform& model_from_tree,
                           const Motion& motion) {
    // The tree's frame is a rotation times a power of two.
    const auto& m = model_from_tree.m;
    const double scale = std::exp2(std::round(std::log2(length({m[0], m[1], m[2]}))));
    MovingPair::Body body{Trajectory(motion), scale, model_from_tree, {}, {}, {}, 0};
    for (std::size_t i = 0; i < 9; ++i)
        body.model_from_tree.m[i] /= scale;
    const Transform world_from_tree = compose(body.trajectory.at(0), body.model_from_tree);
    body.centre = apply_transposed(world_from_tree,
                                   body.trajectory.centre(0) - translation_of(world_from_tree));
    body.angular_velocity = apply_transposed(world_from_tree, body.trajectory.angular_velocity());
    body.axis = normalized_or_zero(body.angular_velocity);
    if (!tree.empty()) {
        const TreeBox box = root_box(tree, scale);
        body.reach = length(box.centre) + box.radius;
    }
    return body;
}

/// Speed of the fastest point, from its centre's.
double speed_of_turning(const MovingPair::Body& body) {
    return body.trajectory.speed_of_rotation() * (length(body.centre) + body.reach);
}

/// Bounds all coordinates that play a part, and the ways of all points.
double size_of(const MovingPair::Body& body) {
    const Transform& start = body.trajectory.start();
    const double turning = speed_of_turning(body);
    return length(translation_of(start)) + length(translation_of(body.model_from_tree)) +
           body.reach + length(body.trajectory.velocity()) + turning +
           // The centre itself counts only as far as the body turns about it.
           std::min(1.0, body.trajectory.speed_of_rotation()) * length(body.trajectory.centre(0));
}

/// |v| times the matrix whose entries are magnitudes, and times its transpose.
Vec3 apply_magnitude(const std::array<double, 9>& m, const Vec3& v) {
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
}
Vec3 apply_magnitude_transposed(const std::array<double, 9>& m, const Vec3& v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

/// Vector between two boxes with parallel axes, from the first to the second; zero if they overlap.
Vec3 gap_between(const Vec3& offset, const Vec3& half, const Vec3& other_half) {
    const auto gap = [](double d, double h) {
        return std::copysign(std::max(0.0, std::abs(d) - h), d);
    };
    return {gap(offset.x, half.x + other_half.x), gap(offset.y, half.y + other_half.y),
            gap(offset.z, half.z + other_half.z)};
}

/// From a gap between hulls, in any axes: how the boxes approach along it. The turning speeds come
/// in the same axes.
double free_time_along(const Vec3& gap, const Vec3& velocity, const Vec3& spin_a,
                       const Vec3& spin_b, const MovingPair& pair, const Vec3& drift,
                       const MovingBox& a, const MovingBox& b) {
    const double distance = length(gap);
    if (!(distance > pair.margin))
        return 0;
    const Vec3 n = (1 / distance) * gap;
    // Along n, rotation moves a point by (n x spin) . arm.
    const double turn_a = length(cross(n, spin_a)), turn_b = length(cross(n, spin_b));
    const double arm_a = a.centre_arm + a.radius, arm_b = b.centre_arm + b.radius;
    Approach approach;
    approach.gap = distance - pair.margin;
    approach.closing = turn_a * a.radius + turn_b * b.radius - dot(n, velocity);
    approach.bend = turn_a * pair.a.trajectory.speed_of_rotation() * arm_a +
                    turn_b * pair.b.trajectory.speed_of_rotation() * arm_b;
    approach.fastest = turn_a * arm_a + turn_b * arm_b - dot(n, drift);
    return free_time(approach);
}

} // namespace

TreeBox root_box(const Tree& tree, double scale) {
    return box_between(tree.bounds, {}, scale);
}
TreeBox child_box(const Node& node, std::size_t child, double scale) {
    return box_between(node.box(child), node.frame, scale);
}

MovingPair::MovingPair(const Tree& tree_a, const Transform& model_from_tree_a,
                       const Motion& motion_a, const Tree& tree_b,
                       const Transform& model_from_tree_b, const Motion& motion_b)
    : a(make_body(tree_a, model_from_tree_a, motion_a)),
      b(make_body(tree_b, model_from_tree_b, motion_b)) {
    speed = length(b.trajectory.velocity() - a.trajectory.velocity()) + speed_of_turning(a) +
            speed_of_turning(b);
    const double size = size_of(a) + size_of(b);
    if (!(size < 1e100))
        throw Error(ErrorCode::bad_argument, "motion: coordinates or speeds beyond 1e100");
    margin = 256 * 0x1p-53 * size;
}

Moment::Moment(const MovingPair& pair, double t)
    : time(t), world_from_a(pair.a.trajectory.at(t)), world_from_b(pair.b.trajectory.at(t)) {
    const Transform tree_a = compose(world_from_a, pair.a.model_from_tree);
    const Transform tree_b = compose(world_from_b, pair.b.model_from_tree);
    for (std::size_t column = 0; column < 12; column += 3) {
        Vec3 v{tree_b.m[column], tree_b.m[column + 1], tree_b.m[column + 2]};
        if (column == 9)
            v = v - translation_of(tree_a);
        const Vec3 turned = apply_transposed(tree_a, v);
        a_from_b.m[column] = turned.x, a_from_b.m[column + 1] = turned.y,
        a_from_b.m[column + 2] = turned.z;
    }
    for (std::size_t i = 0; i < 9; ++i)
        magnitude[i] = std::abs(a_from_b.m[i]);
    centre_a = pair.a.centre;
    centre_b = apply(a_from_b, pair.b.centre);
    velocity =
        apply_transposed(tree_a, pair.b.trajectory.velocity() - pair.a.trajectory.velocity());
    spin_a = pair.a.angular_velocity;
    spin_b = apply_linear(a_from_b, pair.b.angular_velocity);
}

MovingBox box_of_a(const MovingPair& pair, const Moment& moment, const TreeBox& box) {
    const Vec3 arm = box.centre - pair.a.centre;
    return {box.centre, cross(moment.spin_a, arm),
            box.half,   apply_magnitude_transposed(moment.magnitude, box.half),
            box.radius, length(cross(pair.a.axis, arm))};
}

MovingBox box_of_b(const MovingPair& pair, const Moment& moment, const TreeBox& box) {
    const Vec3 centre = apply(moment.a_from_b, box.centre);
    return {centre,
            moment.velocity + cross(moment.spin_b, centre - moment.centre_b),
            apply_magnitude(moment.magnitude, box.half),
            box.half,
            box.radius,
            length(cross(pair.b.axis, box.centre - pair.b.centre))};
}

double free_time(const MovingPair& pair, const Moment& moment, const MovingBox& a,
                 const MovingBox& b, double enough, double horizon) {
    const Vec3 offset = b.centre - a.centre, velocity = b.velocity - a.velocity;
    const double rate_a = pair.a.trajectory.speed_of_rotation(),
                 rate_b = pair.b.trajectory.speed_of_rotation();
    const double bend = rate_a * rate_a * a.centre_arm + rate_b * rate_b * b.centre_arm;
    const double as_balls =
        free_time(offset, velocity, bend, a.radius + b.radius + pair.margin, horizon);
    if (as_balls > enough)
        return as_balls;
    const double in_a = free_time_along(gap_between(offset, a.half_in_a, b.half_in_a), velocity,
                                        moment.spin_a, moment.spin_b, pair, moment.velocity, a, b);
    const auto in_axes_of_b = [&](const Vec3& v) { return apply_transposed(moment.a_from_b, v); };
    const double in_b =
        free_time_along(gap_between(in_axes_of_b(offset), a.half_in_b, b.half_in_b),
                        in_axes_of_b(velocity), in_axes_of_b(moment.spin_a),
                        pair.b.angular_velocity, pair, in_axes_of_b(moment.velocity), a, b);
    return std::max({as_balls, in_a, in_b});
}

} // namespace abut
