#include "simulator/contacts.h"

#include <tuple>

namespace simulation {

namespace {

bool is_before(const Contact& a, const Contact& b) {
    return std::tie(a.pair, a.pieces, a.region) < std::tie(b.pair, b.pieces, b.region);
}

/// Returns the softness of the springs between two bodies.
Softness spring(const Body& a, const Body& b, const Settings& settings, double h) {
    const double stiff = a.is_static() || b.is_static() ? 2 : 1;
    const double hertz = stiff * std::min(settings.contact_hertz, 0.125 / h);
    return Softness::of(hertz, settings.contact_damping, h);
}

void apply_spin(const Vec3& change, Body& a, Body& b) {
    a.spin = a.spin - a.inverse_inertia * change;
    b.spin = b.spin + b.inverse_inertia * change;
}

} // namespace

void Contacts::set(std::span<const abut::ContactManifold> manifolds, std::span<const Body> bodies,
                   std::span<const BodyNumber> number_of) {
    const std::vector<Contact> old = std::move(contacts_);
    const std::vector<ContactPoint> old_points = std::move(points_);
    contacts_.clear(), points_.clear();
    contacts_.reserve(manifolds.size()), points_.reserve(4 * manifolds.size());
    for (const abut::ContactManifold& manifold : manifolds)
        if (length(manifold.normal) > 0) // else no direction separates the bodies
            add(manifold, number_of[manifold.a.index], number_of[manifold.b.index], bodies);
    std::stable_sort(contacts_.begin(), contacts_.end(), is_before);
    keep_impulses(old, old_points);
}

void Contacts::add(const abut::ContactManifold& manifold, BodyNumber number_a, BodyNumber number_b,
                   std::span<const Body> bodies) {
    const Body &a = bodies[number_a], &b = bodies[number_b];
    Contact contact;
    contact.pair = {manifold.a, manifold.b}, contact.region = manifold.region;
    contact.pieces = {manifold.piece_a, manifold.piece_b};
    contact.a = number_a, contact.b = number_b;
    contact.friction = std::sqrt(a.material.friction * b.material.friction);
    contact.bounce = std::max(a.material.bounce, b.material.bounce);
    contact.rolling = std::max(a.material.rolling, b.material.rolling);
    if (contact.rolling > 0 && !(a.is_static() && b.is_static()))
        contact.roll_inertia = inverse(a.inverse_inertia + b.inverse_inertia);
    contact.first = static_cast<std::uint32_t>(points_.size()), contact.count = manifold.count;
    contacts_.push_back(contact);

    const Vec3 &n = manifold.normal, t = across(n);
    for (const abut::ContactPoint& found : std::span(manifold.points).first(manifold.count)) {
        // Both bodies use one point, so that impulses conserve angular momentum.
        const Vec3 place = 0.5 * (found.point_a + found.point_b);
        const Vec3 arm_a = place - a.position, arm_b = place - b.position;
        ContactPoint point;
        point.name = found.feature, point.gap = -found.depth;
        point.push = point_row(a, b, arm_a, arm_b, n);
        point.drag = {point_row(a, b, arm_a, arm_b, t), point_row(a, b, arm_a, arm_b, cross(n, t))};
        point.approach = -point.push.speed(a, b);
        points_.push_back(point);
    }
}

/// Regions and points of the last step begin with the impulses that they had then.
void Contacts::keep_impulses(std::span<const Contact> old,
                             std::span<const ContactPoint> old_points) {
    auto before = old.begin();
    for (Contact& contact : contacts_) {
        while (before != old.end() && is_before(*before, contact))
            ++before;
        if (before == old.end() || is_before(contact, *before))
            continue;
        contact.roll = before->roll;
        const auto known = old_points.subspan(before->first, before->count);
        for (ContactPoint& point : std::span(points_).subspan(contact.first, contact.count)) {
            const auto same = std::find_if(known.begin(), known.end(), [&](const ContactPoint& p) {
                return p.name == point.name;
            });
            if (same == known.end())
                continue;
            point.push.impulse = same->push.impulse;
            const Vec3 drag = same->drag[0].impulse * same->drag[0].along +
                              same->drag[1].impulse * same->drag[1].along;
            for (Row& row : point.drag)
                row.impulse = dot(drag, row.along);
        }
    }
}

bool Contacts::may_touch(const Contact& contact, std::span<const Body> bodies,
                         const Settings& settings, double seconds) const {
    const Body &a = bodies[contact.a], &b = bodies[contact.b];
    const double fall = length(settings.gravity) * seconds * seconds;
    const auto list = points(contact);
    return std::any_of(list.begin(), list.end(), [&](const ContactPoint& point) {
        return point.gap + seconds * point.push.speed(a, b) <= fall;
    });
}

void Contacts::activate(std::span<const Body> bodies, const Settings& settings, double seconds) {
    for (Contact& contact : contacts_)
        contact.active = (bodies[contact.a].moves() || bodies[contact.b].moves()) &&
                         may_touch(contact, bodies, settings, seconds);
}

void Contacts::apply_known(std::span<Body> bodies) const {
    for (const Contact& contact : contacts_) {
        if (!contact.active)
            continue;
        Body &a = bodies[contact.a], &b = bodies[contact.b];
        apply_spin(contact.roll, a, b);
        for (const ContactPoint& point : points(contact)) {
            point.push.apply(point.push.impulse, a, b);
            for (const Row& row : point.drag)
                row.apply(row.impulse, a, b);
        }
    }
}

void Contacts::solve(std::span<Body> bodies, const Settings& settings, double h, bool springs) {
    for (Contact& contact : contacts_) {
        if (!contact.active)
            continue;
        Body &a = bodies[contact.a], &b = bodies[contact.b];
        solve_rolling(contact, a, b);
        solve_friction(contact, a, b);
        const Softness soft = springs ? spring(a, b, settings, h) : Softness::rigid();
        for (ContactPoint& point : std::span(points_).subspan(contact.first, contact.count)) {
            Row& row = point.push;
            const double gap = point.gap + row.moved(a, b);
            // Points that are apart may close their gap. Others are pushed apart.
            double change = 0;
            if (gap > 0)
                change = -row.mass * (row.speed(a, b) + gap / h);
            else
                change = -row.mass * soft.mass *
                             (row.speed(a, b) + std::max(soft.rate * gap, -settings.push_speed)) -
                         soft.impulse * row.impulse;
            row.add_impulse(std::max(change, -row.impulse), a, b);
            point.most_push = std::max(point.most_push, row.impulse);
        }
    }
}

/// Coulomb's law: friction is at most `friction` times the push.
void Contacts::solve_friction(const Contact& contact, Body& a, Body& b) {
    for (ContactPoint& point : std::span(points_).subspan(contact.first, contact.count)) {
        auto& [s, t] = point.drag;
        double new_s = s.impulse - s.mass * s.speed(a, b),
               new_t = t.impulse - t.mass * t.speed(a, b);
        const double square = new_s * new_s + new_t * new_t,
                     most = contact.friction * point.push.impulse;
        if (square > most * most) {
            const double scale = most / std::sqrt(square);
            new_s *= scale, new_t *= scale;
        }
        s.add_impulse(new_s - s.impulse, a, b);
        t.add_impulse(new_t - t.impulse, a, b);
    }
}

/// Rolling resistance: the angular impulse is at most `rolling` times the push.
void Contacts::solve_rolling(Contact& contact, Body& a, Body& b) const {
    if (contact.rolling == 0)
        return;
    double push = 0;
    for (const ContactPoint& point : points(contact))
        push += point.push.impulse;
    Vec3 roll = contact.roll - contact.roll_inertia * (b.spin - a.spin);
    const double size = length(roll), most = contact.rolling * push;
    if (size > most)
        roll = (most / size) * roll;
    apply_spin(roll - contact.roll, a, b);
    contact.roll = roll;
}

void Contacts::bounce(std::span<Body> bodies, const Settings& settings) {
    for (const Contact& contact : contacts_) {
        if (!contact.active || contact.bounce == 0)
            continue;
        Body &a = bodies[contact.a], &b = bodies[contact.b];
        for (ContactPoint& point : std::span(points_).subspan(contact.first, contact.count)) {
            if (point.approach < settings.bounce_speed || point.most_push == 0)
                continue;
            const double change =
                point.push.mass * (contact.bounce * point.approach - point.push.speed(a, b));
            point.push.add_impulse(std::max(change, -point.push.impulse), a, b);
        }
    }
}

std::size_t Contacts::touching_points() const {
    return static_cast<std::size_t>(
        std::count_if(points_.begin(), points_.end(),
                      [](const ContactPoint& point) { return point.push.impulse > 0; }));
}

double Contacts::deepest() const {
    double depth = 0;
    for (const ContactPoint& point : points_)
        depth = std::max(depth, -point.gap);
    return depth;
}

} // namespace simulation
