#include "simulator/islands.h"

#include <limits>
#include <numeric>

namespace simulation {

void Islands::build(std::span<const Body> bodies, const Contacts& contacts,
                    std::span<const Joint> joints, const Settings& settings, double seconds) {
    parent_.resize(bodies.size());
    std::iota(parent_.begin(), parent_.end(), BodyNumber{0});
    is_held_.assign(bodies.size(), false);
    for (const Contact& contact : contacts.list())
        if (contacts.may_touch(contact, bodies, settings, seconds))
            join(bodies, contact.a, contact.b);
    for (const Joint& joint : joints)
        join(bodies, joint.a(), joint.b());
}

BodyNumber Islands::root(BodyNumber body) {
    while (parent_[body] != body) {
        parent_[body] = parent_[parent_[body]]; // halves the path
        body = parent_[body];
    }
    return body;
}

void Islands::join(std::span<const Body> bodies, BodyNumber a, BodyNumber b) {
    if (bodies[a].is_static() || bodies[b].is_static()) {
        is_held_[a] = is_held_[b] = true;
        return;
    }
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
}

void Islands::wake(std::span<Body> bodies) {
    std::vector<bool> awake(bodies.size(), false);
    for (BodyNumber i = 0; i < bodies.size(); ++i)
        if (bodies[i].moves())
            awake[root(i)] = true;
    for (BodyNumber i = 0; i < bodies.size(); ++i)
        if (bodies[i].asleep && awake[root(i)])
            bodies[i].asleep = false, bodies[i].still_for = 0;
}

void Islands::sleep(std::span<Body> bodies, const Settings& settings, double seconds) {
    if (!settings.sleep)
        return;
    std::vector<double> still_for(bodies.size(), std::numeric_limits<double>::infinity());
    for (BodyNumber i = 0; i < bodies.size(); ++i) {
        Body& body = bodies[i];
        if (body.is_static())
            continue;
        const double speed = length(body.velocity) + body.reach * length(body.spin);
        body.still_for = speed < settings.sleep_speed ? body.still_for + seconds : 0;
        still_for[root(i)] = std::min(still_for[root(i)], body.still_for);
    }
    for (BodyNumber i = 0; i < bodies.size(); ++i) {
        Body& body = bodies[i];
        if (body.is_static() || still_for[root(i)] < settings.sleep_after)
            continue;
        body.asleep = true;
        body.velocity = {}, body.spin = {};
    }
}

} // namespace simulation
