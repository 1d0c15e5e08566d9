// How the simulator keeps fast bodies from passing through others: after the sub-steps, it moves the
// bodies only as far as they meet nothing (`World::time_of_impact`), and lets them collide there.

#include "simulator/simulator.h"

namespace simulation {

/// Moves the bodies in the world to where the sub-steps have brought them. Bodies that move far stop
/// where they first meet another, and collide there. They then use the rest of the step.
void Simulator::move_bodies(double seconds) {
    constexpr int kMotions = 3; // of a body that meets others again and again
    // A body that an impact wakes moves from the next step on.
    std::vector<double> left(bodies_.size(), 0);
    for (BodyNumber i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].moves())
            left[i] = seconds;
    for (int motion = 0; motion < kMotions; ++motion) {
        std::vector<FoundImpact> impacts;
        const std::vector<double> share = shares_to_impacts(impacts);
        for (BodyNumber i = 0; i < bodies_.size(); ++i) {
            Body& body = bodies_[i];
            if (!body.moves())
                continue;
            if (share[i] < 1) {
                stop_at(body, share[i]);
                if (motion == 0) // gravity does not act in the rest of the step
                    lose_fall(body, (1 - share[i]) * body.moved);
            }
            body.pose = current_pose(body);
            world_.move(body.id, body.pose);
            body.moved = {}, body.turned = {};
            left[i] *= 1 - share[i];
        }
        for (const FoundImpact& each : impacts)
            if (is_reached(each, share))
                collide(each.met);
        if (motion + 1 < kMotions && !go_on(impacts, left))
            break;
    }
}

/// Moves the bodies that were stopped at impacts through the rest of their step. Returns whether
/// there are any. Joined bodies stay, because their joints are not solved on the way.
bool Simulator::go_on(std::span<const FoundImpact> impacts, std::vector<double>& left) {
    std::vector<bool> goes(bodies_.size(), false);
    for (const FoundImpact& each : impacts)
        for (const abut::BodyId id : {each.met.a, each.met.b})
            goes[number_of_[id.index]] = true;
    for (const Joint& joint : joints_)
        goes[joint.a()] = goes[joint.b()] = false;
    bool any = false;
    for (BodyNumber i = 0; i < bodies_.size(); ++i)
        if (goes[i] && bodies_[i].moves() && left[i] > 0) {
            drift(bodies_[i], left[i]);
            update_inertia(bodies_[i]);
            any = true;
        }
    return any;
}

/// Returns the share of its motion that each body can do: fast bodies stop where they first meet
/// another. Bodies that move at most half of the margin are taken to stay where they are, and
/// pairs that touch already are left to the contacts.
std::vector<double> Simulator::shares_to_impacts(std::vector<FoundImpact>& impacts) {
    constexpr int kRounds = 4; // after them, bodies that still meet do not move at all
    std::vector<double> share(bodies_.size(), 1);
    for (int round = 0; shorten_motions(share, round < kRounds, impacts); ++round) {
    }
    return share;
}

/// Returns whether both bodies get as far as the impact. A body may be stopped before it, at another
/// impact or together with a body that it touches.
bool Simulator::is_reached(const FoundImpact& impact, std::span<const double> share) const {
    return share[number_of_[impact.met.a.index]] >= impact.share_a &&
           share[number_of_[impact.met.b.index]] >= impact.share_b;
}

/// Gives both bodies the impulse of an impact. The contacts of the next step may lack its point or
/// have another normal: without the impulse, bodies that slide along each other could be stopped
/// again in every step.
void Simulator::collide(const abut::BodyImpact& met) {
    const BodyNumber number_a = number_of_[met.a.index], number_b = number_of_[met.b.index];
    islands_.join(bodies_, number_a, number_b);
    Body &a = bodies_[number_a], &b = bodies_[number_b];
    const Vec3 place = 0.5 * (met.impact.point_a + met.impact.point_b);
    const Row row = point_row(a, b, place - a.position, place - b.position, met.impact.normal);
    const double approach = -row.speed(a, b);
    if (!(approach > 0))
        return;
    const double bounce =
        approach < settings_.bounce_speed ? 0 : std::max(a.material.bounce, b.material.bounce);
    row.apply(row.mass * (1 + bounce) * approach, a, b);
    for (Body* body : {&a, &b})
        if (body->asleep)
            body->asleep = false, body->still_for = 0;
}

/// Shortens the motions of fast bodies that meet, to the time of impact or to nothing. Returns
/// whether there are any, and adds their impacts. A body that has been stopped may be in the way of
/// others, so that another round is needed.
bool Simulator::shorten_motions(std::vector<double>& share, bool to_impact,
                                std::vector<FoundImpact>& impacts) {
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
        const auto shorten = [&](abut::BodyId id) {
            const BodyNumber i = number_of_[id.index];
            const double stop = fast[i] && to_impact ? time * share[i] : 0;
            if (fast[i])
                shorter[i] = std::min(shorter[i], stop);
            return stop;
        };
        const double share_a = shorten(each.a), share_b = shorten(each.b);
        impacts.push_back({each, share_a, share_b});
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

/// Puts the body where it was at a fraction of its motion. It keeps its angular momentum.
void Simulator::stop_at(Body& body, double share) {
    const Vec3 momentum = world_inertia(body) * body.spin;
    body.position = body.position - (1 - share) * body.moved;
    body.rotation = rotated(normalised(body.pose.rotation), share * body.turned);
    update_inertia(body);
    body.spin = body.inverse_inertia * momentum;
}

/// Takes away the speed that gravity has given the body on a way that it has not gone.
void Simulator::lose_fall(Body& body, const Vec3& back) const {
    const double gained = 2 * dot(settings_.gravity, back),
                 square = dot(body.velocity, body.velocity);
    if (gained > 0)
        body.velocity = std::sqrt(std::max(0.0, 1 - gained / square)) * body.velocity;
}

} // namespace simulation
