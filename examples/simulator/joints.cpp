#include "simulator/joints.h"

namespace simulation {

namespace {

constexpr std::size_t rows_of(JointKind kind) {
    return kind == JointKind::ball ? 3 : 5;
}

} // namespace

Joint::Joint(JointKind kind, BodyNumber a, BodyNumber b, const JointPlace& place,
             std::span<const Body> bodies)
    : kind_(kind), a_(a), b_(b), count_(rows_of(kind)) {
    const Matrix from_a = transposed(rotation_matrix(bodies[a].rotation)),
                 from_b = transposed(rotation_matrix(bodies[b].rotation));
    point_a_ = from_a * (place.point - bodies[a].position);
    point_b_ = from_b * (place.point - bodies[b].position);
    axis_a_ = from_a * unit(place.axis), axis_b_ = from_b * unit(place.axis);
    b_in_a_ = product(conjugate(bodies[a].rotation), bodies[b].rotation);
}

Joint::Error Joint::error(const Body& a, const Body& b) const {
    const Matrix from_a = rotation_matrix(a.rotation), from_b = rotation_matrix(b.rotation);
    Error e;
    e.arm_a = from_a * point_a_, e.arm_b = from_b * point_b_;
    e.axis = from_a * axis_a_;
    e.apart = b.position + e.arm_b - a.position - e.arm_a;
    if (kind_ == JointKind::hinge)
        e.turned = cross(e.axis, from_b * axis_b_);
    if (kind_ == JointKind::slider) {
        // Both bodies use b's point, because a's point slides.
        e.arm_a = e.arm_a + e.apart;
        e.apart = e.apart - dot(e.apart, e.axis) * e.axis;
        const Quaternion turn = product(b.rotation, conjugate(product(a.rotation, b_in_a_)));
        e.turned = (turn[0] < 0 ? -2 : 2) * Vec3{turn[1], turn[2], turn[3]};
    }
    return e;
}

void Joint::prepare(std::span<const Body> bodies) {
    const Body &a = bodies[a_], &b = bodies[b_];
    const Error e = error(a, b);
    const Matrix from_a = rotation_matrix(a.rotation);
    const Vec3 s = from_a * across(axis_a_), t = cross(e.axis, s);
    std::size_t row = 0;
    const auto add = [&](const Row& made, double wrong) {
        const double impulse = rows_[row].impulse;
        rows_[row] = made, rows_[row].impulse = impulse, errors_[row] = wrong;
        ++row;
    };
    const auto keep_point = [&](const Vec3& along) {
        add(point_row(a, b, e.arm_a, e.arm_b, along), dot(along, e.apart));
    };
    const auto keep_turn = [&](const Vec3& about) {
        add(make_row(a, b, {}, about, about), dot(about, e.turned));
    };
    keep_point(s), keep_point(t);
    if (kind_ == JointKind::slider)
        keep_turn(e.axis);
    else
        keep_point(e.axis);
    if (kind_ != JointKind::ball)
        keep_turn(s), keep_turn(t);
}

void Joint::apply_known(std::span<Body> bodies) const {
    for (const Row& row : std::span(rows_).first(count_))
        row.apply(row.impulse, bodies[a_], bodies[b_]);
}

void Joint::solve(std::span<Body> bodies, const Settings& settings, double h, bool springs) {
    Body &a = bodies[a_], &b = bodies[b_];
    const Softness soft =
        springs ? Softness::of(std::min(settings.joint_hertz, 0.25 / h), settings.joint_damping, h)
                : Softness::rigid();
    for (std::size_t i = 0; i < count_; ++i) {
        Row& row = rows_[i];
        row.add_impulse(-row.mass * soft.mass * (row.speed(a, b) + soft.rate * errors_[i]) -
                            soft.impulse * row.impulse,
                        a, b);
    }
}

double Joint::gap(std::span<const Body> bodies) const {
    return length(error(bodies[a_], bodies[b_]).apart);
}
double Joint::twist(std::span<const Body> bodies) const {
    return length(error(bodies[a_], bodies[b_]).turned);
}

} // namespace simulation
