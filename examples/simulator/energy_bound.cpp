#include "simulator/energy_bound.h"

namespace simulation {

namespace {

/// A group of bodies, and sums over its bodies.
struct Group {
    double gain = 0, kinetic = 0;
    double mass = 0;
    Vec3 moment, momentum;        ///< about the origin
    Vec3 centre, velocity;        ///< of mass
    Matrix inertia = kZeroMatrix; ///< about the centre
    Vec3 angular_momentum, spin;  ///< about the centre
    bool is_free = true;          ///< no static body holds it
};

/// Returns the inertia of a unit mass at an arm.
Matrix point_inertia(const Vec3& arm) {
    return dot(arm, arm) * Matrix{} + -1 * outer_square(arm);
}

} // namespace

double mechanical_energy(const Body& body, const Vec3& gravity) {
    return kinetic_energy(body) - body.mass.mass * dot(gravity, body.position);
}

void EnergyBound::remember(std::span<const Body> bodies, const Vec3& gravity) {
    before_.assign(bodies.size(), 0);
    for (BodyNumber i = 0; i < bodies.size(); ++i)
        if (!bodies[i].is_static())
            before_[i] = mechanical_energy(bodies[i], gravity);
}

void EnergyBound::enforce(std::span<Body> bodies, Islands& islands, const Vec3& gravity) const {
    std::vector<Group> groups(bodies.size()); // by the root of the group
    const auto each = [&](const auto& work) {
        for (BodyNumber i = 0; i < bodies.size(); ++i)
            if (bodies[i].moves())
                work(bodies[i], groups[islands.root(i)], i);
    };
    each([&](const Body& body, Group& group, BodyNumber i) {
        group.gain += mechanical_energy(body, gravity) - before_[i];
        group.kinetic += kinetic_energy(body);
        group.mass += body.mass.mass;
        group.moment = group.moment + body.mass.mass * body.position;
        group.momentum = group.momentum + body.mass.mass * body.velocity;
        group.is_free = group.is_free && !islands.is_held(i);
    });
    constexpr double kRounding = 1e-14; // of a sum over thousands of bodies
    const auto has_gained = [](const Group& group) {
        return group.gain > kRounding * group.kinetic;
    };
    for (Group& group : groups)
        if (has_gained(group) && group.is_free) {
            group.centre = (1 / group.mass) * group.moment;
            group.velocity = (1 / group.mass) * group.momentum;
        }
    each([&](const Body& body, Group& group, BodyNumber) {
        if (!has_gained(group) || !group.is_free)
            return;
        const Vec3 arm = body.position - group.centre;
        const Matrix inertia = world_inertia(body);
        group.inertia = group.inertia + inertia + body.mass.mass * point_inertia(arm);
        group.angular_momentum = group.angular_momentum + inertia * body.spin +
                                 body.mass.mass * cross(arm, body.velocity - group.velocity);
    });
    for (Group& group : groups)
        if (has_gained(group) && group.is_free) {
            group.spin = inverse(group.inertia) * group.angular_momentum;
            group.kinetic -= 0.5 * (group.mass * dot(group.velocity, group.velocity) +
                                    dot(group.spin, group.angular_momentum));
        }
    each([&](Body& body, Group& group, BodyNumber) {
        if (!has_gained(group))
            return;
        const double left = group.kinetic > 0 ? std::max(0.0, 1 - group.gain / group.kinetic) : 0;
        const double scale = std::sqrt(left);
        const Vec3 rigid = group.velocity + cross(group.spin, body.position - group.centre);
        body.velocity = rigid + scale * (body.velocity - rigid);
        body.spin = group.spin + scale * (body.spin - group.spin);
    });
}

} // namespace simulation
