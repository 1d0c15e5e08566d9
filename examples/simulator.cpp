#include "simulator.h"

#include <algorithm>
#include <numbers>

namespace drop {

namespace {

/// Returns the change of spin by an angular impulse, I^-1 times the impulse.
Vec3 spin_from(const RigidBody& body, const Vec3& angular_impulse) {
    const auto& column = body.inverse_inertia;
    return angular_impulse.x * column[0] + angular_impulse.y * column[1] +
           angular_impulse.z * column[2];
}

} // namespace

Inertia inertia_of(const abut::Sphere& sphere, double density) {
    const double r = sphere.radius, mass = density * 4 / 3 * std::numbers::pi * r * r * r;
    const double moment = 0.4 * mass * r * r;
    return {mass, {moment, moment, moment}};
}

Inertia inertia_of(const abut::Capsule& capsule, double density) {
    const double r = capsule.radius, l = length(capsule.axis.b - capsule.axis.a);
    const double rod = density * std::numbers::pi * r * r * l,
                 ends = density * 4 / 3 * std::numbers::pi * r * r * r;
    // A cylinder and two half balls, whose centres of mass lie 3/8 r beyond its ends.
    const double along = rod * r * r / 2 + 0.4 * ends * r * r;
    const double across =
        rod * (3 * r * r + l * l) / 12 + ends * (0.4 * r * r + l * l / 4 + 3 * r * l / 8);
    return {rod + ends, {across, across, along}};
}

Inertia inertia_of(const abut::Box3& box, double density) {
    const Vec3 d = box.upper - box.lower;
    const double mass = density * d.x * d.y * d.z, k = mass / 12;
    return {
        mass,
        {k * (d.y * d.y + d.z * d.z), k * (d.z * d.z + d.x * d.x), k * (d.x * d.x + d.y * d.y)}};
}

void Simulator::step(double dt) {
    prepare_bodies(dt);
    find_contacts();
    solve(dt);
    move(dt);
}

void Simulator::prepare_bodies(double dt) {
    for (RigidBody& body : bodies_) {
        if (body.inertia.mass == 0)
            continue;
        body.velocity = body.velocity + dt * settings_.gravity;
        body.inverse_mass = 1 / body.inertia.mass;
        // R I^-1 R^T
        const Transform& t = world_.world_from_body(body.id);
        const Vec3& moments = body.inertia.moments;
        const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 own = turned_back(t, axes[k]);
            body.inverse_inertia[k] =
                turned(t, {own.x / moments.x, own.y / moments.y, own.z / moments.z});
        }
    }
}

void Simulator::find_contacts() {
    keep_contacts();
    std::vector<Contact> found;
    auto kept = contacts_.begin(); // both lists are sorted
    for (const abut::BodyGap& gap : world_.penetration()) {
        const abut::BodyPair pair{gap.a, gap.b};
        kept = std::find_if(kept, contacts_.end(),
                            [&](const Contact& contact) { return !(contact.pair < pair); });
        Contact contact;
        if (kept != contacts_.end() && kept->pair == pair)
            contact = std::move(*kept);
        contact.pair = pair;
        contact.a = number_.at(gap.a), contact.b = number_.at(gap.b);
        // Impulses remembered along another direction are useless along this one.
        if (dot(contact.normal, gap.normal) < 0.97)
            contact.points.clear();
        contact.normal = gap.normal;
        add_point(contact, gap);
        found.push_back(std::move(contact));
    }
    contacts_ = std::move(found);
}

/// Drops contact points that have separated or slid apart.
void Simulator::keep_contacts() {
    for (Contact& contact : contacts_) {
        for (ContactPoint& point : contact.points)
            refresh(contact, point);
        std::erase_if(contact.points, [&, n = contact.normal](const ContactPoint& point) {
            const Vec3 slid = point.apart - dot(point.apart, n) * n;
            return -point.depth > settings_.contact_drift || length(slid) > settings_.contact_drift;
        });
    }
}

void Simulator::add_point(Contact& contact, const abut::BodyGap& gap) {
    constexpr std::size_t kMostPoints = 4;
    ContactPoint point;
    const auto local = [&](std::size_t body, const Vec3& p) {
        const Transform& t = world_.world_from_body(bodies_[body].id);
        return turned_back(t, p - origin(t));
    };
    point.on_a = local(contact.a, gap.point_a), point.on_b = local(contact.b, gap.point_b);
    refresh(contact, point);
    const auto nearness = [&](const ContactPoint& p) { return length(p.on_b - point.on_b); };
    const auto near = std::min_element(
        contact.points.begin(), contact.points.end(),
        [&](const ContactPoint& p, const ContactPoint& q) { return nearness(p) < nearness(q); });
    // The point is known, or there are too many: the new point takes over the old one's impulses.
    if (near != contact.points.end() &&
        (nearness(*near) < settings_.contact_drift || contact.points.size() == kMostPoints)) {
        point.push = near->push, point.drag = near->drag;
        *near = point;
    } else {
        contact.points.push_back(point);
    }
}

void Simulator::refresh(const Contact& contact, ContactPoint& point) const {
    const Transform &world_a = world_.world_from_body(bodies_[contact.a].id),
                    &world_b = world_.world_from_body(bodies_[contact.b].id);
    const Vec3 a = origin(world_a) + turned(world_a, point.on_a),
               b = origin(world_b) + turned(world_b, point.on_b);
    // Both bodies use one point, so that impulses conserve angular momentum.
    const Vec3 between = 0.5 * (a + b);
    point.arm_a = between - origin(world_a), point.arm_b = between - origin(world_b);
    point.apart = b - a;
    point.depth = -dot(point.apart, contact.normal);
}

/// Applies impulses to one contact after the other, repeatedly, until they converge. Source:
/// sequential impulses [Catto 2005].
void Simulator::solve(double dt) {
    for (Contact& contact : contacts_)
        for (ContactPoint& point : contact.points) {
            point.yield = yield(contact, point, contact.normal);
            apply(contact, point, point.push * contact.normal + point.drag);
        }
    for (int i = 0; i < settings_.iterations; ++i)
        for (Contact& contact : contacts_)
            for (ContactPoint& point : contact.points)
                solve_point(contact, point, dt);
}

void Simulator::solve_point(const Contact& contact, ContactPoint& point, double dt) {
    const RigidBody &a = bodies_[contact.a], &b = bodies_[contact.b];
    const auto approach = [&] {
        return b.velocity + cross(b.spin, point.arm_b) - a.velocity - cross(a.spin, point.arm_a);
    };
    // Points that have opened may close within the step; deep ones are pushed apart.
    const double depth = point.depth - settings_.allowed_depth;
    double target = 0;
    if (depth > 0)
        target = std::min(settings_.correction * depth / dt, settings_.most_correction);
    else if (point.depth < 0)
        target = point.depth / dt;
    const Vec3& n = contact.normal;
    const double push = std::max(0.0, point.push + (target - dot(approach(), n)) / point.yield);
    apply(contact, point, (push - point.push) * n);
    point.push = push;

    Vec3 sliding = approach();
    sliding = sliding - dot(sliding, n) * n;
    const double speed = length(sliding);
    if (speed == 0)
        return;
    Vec3 drag = point.drag - (1 / yield(contact, point, (1 / speed) * sliding)) * sliding;
    drag = drag - dot(drag, n) * n;
    if (const double size = length(drag); size > settings_.friction * point.push)
        drag = (settings_.friction * point.push / size) * drag;
    apply(contact, point, drag - point.drag);
    point.drag = drag;
}

void Simulator::apply(const Contact& contact, const ContactPoint& point, const Vec3& impulse) {
    RigidBody &a = bodies_[contact.a], &b = bodies_[contact.b];
    a.velocity = a.velocity - a.inverse_mass * impulse;
    a.spin = a.spin - spin_from(a, cross(point.arm_a, impulse));
    b.velocity = b.velocity + b.inverse_mass * impulse;
    b.spin = b.spin + spin_from(b, cross(point.arm_b, impulse));
}

/// Returns the relative speed at the point that a unit impulse along a direction causes.
double Simulator::yield(const Contact& contact, const ContactPoint& point,
                        const Vec3& along) const {
    const RigidBody &a = bodies_[contact.a], &b = bodies_[contact.b];
    const Vec3 turn_a = cross(point.arm_a, along), turn_b = cross(point.arm_b, along);
    return a.inverse_mass + b.inverse_mass + dot(turn_a, spin_from(a, turn_a)) +
           dot(turn_b, spin_from(b, turn_b));
}

void Simulator::move(double dt) {
    const std::vector<double> free = free_shares(dt);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        RigidBody& body = bodies_[i];
        if (body.inertia.mass == 0)
            continue;
        const double t = free[i] * dt;
        body.pose.translation = body.pose.translation + t * body.velocity;
        body.pose.rotation = rotated(body.pose.rotation, t * body.spin);
        world_.move(body.id, body.pose);
    }
}

/// Returns the fraction of its motion that each body may make. A body that moves far in a step
/// stops where it first meets another.
std::vector<double> Simulator::free_shares(double dt) {
    std::vector<double> free(bodies_.size(), 1);
    std::vector<abut::BodyMotion> motions;
    bool any_fast = false;
    for (const RigidBody& body : bodies_)
        if (body.inertia.mass > 0) {
            any_fast = any_fast || length(body.velocity) * dt > body.size;
            motions.push_back(
                {body.id, {body.pose, body.pose.translation, dt * body.velocity, dt * body.spin}});
        }
    if (!any_fast)
        return free;
    for (const abut::BodyImpact& each : world_.time_of_impact(motions))
        for (const abut::BodyId id : {each.a, each.b}) {
            const std::size_t i = number_.at(id);
            // Impulses handle bodies that are already in contact. The body goes slightly beyond the
            // impact, so that the next step finds a contact.
            if (each.impact.time > 0 && length(bodies_[i].velocity) * dt > bodies_[i].size)
                free[i] =
                    std::min(free[i], each.impact.time + settings_.allowed_depth /
                                                             (length(bodies_[i].velocity) * dt));
        }
    return free;
}

} // namespace drop
