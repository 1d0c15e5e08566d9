#include "simulator/simulator.h"

#include <abut/error.h>

namespace simulation {

using abut::Error;
using abut::ErrorCode;

Simulator::Simulator(const Settings& settings)
    : settings_(settings), joined_(std::make_shared<std::set<abut::BodyPair>>()),
      world_({.filter = [joined = joined_](abut::BodyId a, abut::BodyId b) {
          return !joined->contains({a, b});
      }}) {}

void Simulator::check(const Material& material) {
    for (const double value : {material.density, material.friction, material.bounce})
        if (!std::isfinite(value) || value < 0)
            throw Error(ErrorCode::bad_argument, "a material's value is negative or not finite");
    if (material.bounce > 1)
        throw Error(ErrorCode::bad_argument, "a material's bounce exceeds 1");
}

BodyNumber Simulator::add_body(abut::BodyId id, const Pose& pose, const Mass& mass,
                               const Material& material) {
    if (material.density > 0 && !(mass.mass > 0 && std::isfinite(mass.mass))) {
        world_.remove(id);
        throw Error(ErrorCode::bad_argument, "a body that moves has no volume");
    }
    Body body;
    body.id = id, body.material = material, body.mass = mass;
    body.rotation = normalised(pose.rotation);
    body.position = pose.translation + rotation_matrix(body.rotation) * mass.centre;
    body.pose = pose;
    body.inverse_mass = mass.mass > 0 ? 1 / mass.mass : 0;
    const abut::Box3 box = world_.box(id);
    for (int corner = 0; corner < 8; ++corner)
        body.reach =
            std::max(body.reach, length(Vec3{(corner & 1) != 0 ? box.lower.x : box.upper.x,
                                             (corner & 2) != 0 ? box.lower.y : box.upper.y,
                                             (corner & 4) != 0 ? box.lower.z : box.upper.z} -
                                        body.position));
    if (id.index >= number_of_.size())
        number_of_.resize(id.index + 1);
    number_of_[id.index] = bodies_.size();
    bodies_.push_back(body);
    return bodies_.size() - 1;
}

void Simulator::join(JointKind kind, BodyNumber a, BodyNumber b, const JointPlace& place) {
    if (a == b || !(length(place.axis) > 0))
        throw Error(ErrorCode::bad_argument, "a joint needs two bodies and an axis");
    joints_.emplace_back(kind, a, b, place, bodies_);
    joined_->insert(
        {std::min(bodies_[a].id, bodies_[b].id), std::max(bodies_[a].id, bodies_[b].id)});
    world_.refilter();
}

void Simulator::wake(BodyNumber body) {
    bodies_[body].asleep = false, bodies_[body].still_for = 0;
}

std::size_t Simulator::awake() const {
    return static_cast<std::size_t>(
        std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.moves(); }));
}

double Simulator::energy() const {
    double sum = 0;
    for (const Body& body : bodies_)
        if (!body.is_static())
            sum += kinetic_energy(body) - body.mass.mass * dot(settings_.gravity, body.position);
    return sum;
}

void Simulator::step(double seconds) {
    if (!(seconds >= 0) || !std::isfinite(seconds))
        throw Error(ErrorCode::bad_argument, "the time of a step is negative or not finite");
    if (awake() == 0)
        return;
    for (Body& body : bodies_) {
        update_inertia(body);
        body.moved = {}, body.turned = {};
    }
    find_contacts(seconds);
    for (int i = 0; i < settings_.substeps; ++i)
        substep(seconds / settings_.substeps);
    contacts_.bounce(bodies_, settings_);
    move_bodies();
    islands_.sleep(bodies_, settings_, seconds);
}

void Simulator::find_contacts(double seconds) {
    contacts_.set(world_.contact_manifolds(settings_.margin), bodies_, number_of_);
    islands_.build(bodies_, contacts_, joints_, settings_, seconds);
    islands_.wake(bodies_);
    contacts_.activate(bodies_, settings_, seconds);
}

/// Moves all bodies by a fraction of the step. The springs of contacts and joints take part in the
/// motion. Then the same constraints are solved without springs, so that no speed remains of them.
/// Source: "soft step" [Catto 2024].
void Simulator::substep(double h) {
    for (Body& body : bodies_)
        if (body.moves())
            body.velocity = body.velocity + h * settings_.gravity;
    const auto each_joint = [&](const auto& work) {
        for (Joint& joint : joints_)
            if (bodies_[joint.a()].moves() || bodies_[joint.b()].moves())
                work(joint);
    };
    each_joint([&](Joint& joint) { joint.prepare(bodies_); });
    each_joint([&](Joint& joint) { joint.apply_known(bodies_); });
    contacts_.apply_known(bodies_);
    for (int i = 0; i < settings_.joint_passes; ++i)
        each_joint([&](Joint& joint) { joint.solve(bodies_, settings_, h, true); });
    contacts_.solve(bodies_, settings_, h, true);
    for (Body& body : bodies_)
        if (body.moves()) {
            drift(body, h);
            update_inertia(body);
        }
    for (int i = 0; i < settings_.joint_passes; ++i)
        each_joint([&](Joint& joint) { joint.solve(bodies_, settings_, h, false); });
    contacts_.solve(bodies_, settings_, h, false);
}

void Simulator::move_bodies() {
    stop_at_impacts();
    for (Body& body : bodies_)
        if (body.moves()) {
            body.pose = current_pose(body);
            world_.move(body.id, body.pose);
        }
}

/// Bodies that move far in a step stop where they first meet another. Bodies that move at most half
/// of the margin are taken to stay where they are, and pairs that touch already are left to the
/// impulses.
void Simulator::stop_at_impacts() {
    constexpr int kRounds = 4; // after them, bodies that still meet do not move at all
    std::vector<double> share(bodies_.size(), 1);
    for (int round = 0; shorten_motions(share, round < kRounds); ++round) {
    }
    for (BodyNumber i = 0; i < bodies_.size(); ++i)
        if (share[i] < 1)
            stop_at(bodies_[i], share[i]);
}

/// Shortens the motions of fast bodies that meet, to the time of impact or to nothing. Returns
/// whether there are any. A body that has been stopped may be in the way of others, so that another
/// round is needed.
bool Simulator::shorten_motions(std::vector<double>& share, bool to_impact) {
    std::vector<abut::BodyMotion> motions;
    std::vector<bool> fast(bodies_.size(), false);
    for (BodyNumber i = 0; i < bodies_.size(); ++i) {
        const Body& body = bodies_[i];
        fast[i] = body.moves() &&
                  length(body.moved) + body.reach * length(body.turned) > 0.5 * settings_.margin;
        if (fast[i])
            motions.push_back({body.id,
                               {body.pose, body.position - body.moved, share[i] * body.moved,
                                share[i] * body.turned}});
    }
    if (motions.empty())
        return false;
    std::vector<double> shorter = share;
    for (const abut::BodyImpact& each : world_.time_of_impact(motions)) {
        const auto way = [&](abut::BodyId id, const Vec3& point) {
            const Body& body = bodies_[number_of_[id.index]];
            const Vec3 arm = point - (body.position - body.moved);
            return share[number_of_[id.index]] * (body.moved + cross(body.turned, arm));
        };
        // Impulses act on bodies that touch already. They also leave a small error in directions
        // in which bodies slide or roll, which is no impact.
        const double time = each.impact.time;
        const Vec3 closing = way(each.a, each.impact.point_a) - way(each.b, each.impact.point_b);
        if ((1 - time) * dot(closing, each.impact.normal) < 0.1 * settings_.margin)
            continue;
        for (const abut::BodyId id : {each.a, each.b})
            if (const BodyNumber i = number_of_[id.index]; fast[i])
                shorter[i] = std::min(shorter[i], to_impact ? time * share[i] : 0);
    }
    stop_together(shorter);
    const bool any = shorter != share;
    share = std::move(shorter);
    return any;
}

/// Joined bodies stop together, and so do bodies that touch, if one of them would go into the other.
void Simulator::stop_together(std::vector<double>& share) const {
    bool again = true;
    const auto stop = [&](BodyNumber a, BodyNumber b) {
        const double least = std::min(share[a], share[b]);
        for (const BodyNumber i : {a, b})
            if (bodies_[i].moves() && share[i] > least)
                share[i] = least, again = true;
    };
    while (again) {
        again = false;
        for (const Joint& joint : joints_)
            stop(joint.a(), joint.b());
        for (const Contact& contact : contacts_.list()) {
            const Body &a = bodies_[contact.a], &b = bodies_[contact.b];
            const double share_a = share[contact.a], share_b = share[contact.b];
            if (!contact.active || share_a == share_b)
                continue;
            for (const ContactPoint& point : contacts_.points(contact)) {
                const Row& row = point.push;
                const double gap = point.gap +
                                   share_b * (dot(row.along, b.moved) + dot(row.turn_b, b.turned)) -
                                   share_a * (dot(row.along, a.moved) + dot(row.turn_a, a.turned));
                if (gap < std::min(0.0, point.gap) - 0.1 * settings_.margin)
                    stop(contact.a, contact.b);
            }
        }
    }
}

/// Puts the body where it was at a fraction of the step. Gravity has not accelerated it beyond that
/// place.
void Simulator::stop_at(Body& body, double share) const {
    const Vec3 back = (1 - share) * body.moved;
    body.position = body.position - back;
    body.rotation = rotated(normalised(body.pose.rotation), share * body.turned);
    const double gained = 2 * dot(settings_.gravity, back),
                 square = dot(body.velocity, body.velocity);
    if (gained > 0)
        body.velocity = std::sqrt(std::max(0.0, 1 - gained / square)) * body.velocity;
}

} // namespace simulation
