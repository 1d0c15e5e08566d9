#include "scenes/rigid_bodies.h"

#include "scenes/deforming/deforming.h"
#include "scenes/deforming/frame.h"
#include "scenes/deforming/surfaces.h"

#include <algorithm>
#include <utility>

namespace abut::scenes {

namespace {

constexpr int kIterations = 12;
/// The part of a penetration that one frame removes.
constexpr double kRecovery = 0.2;
/// Metres per second. Slower contacts do not bounce, so that piles come to rest.
constexpr double kSlow = 0.3;

/// The rotation after `seconds` of spin, to first order.
std::array<double, 4> spun(const std::array<double, 4>& q, const Vec3& spin, double seconds) {
    const Vec3 v{q[1], q[2], q[3]}, half = scaled(spin, seconds / 2);
    const Vec3 turned = add(v, add(scaled(half, q[0]), cross(half, v)));
    return {q[0] - dot(half, v), turned.x, turned.y, turned.z};
}

std::array<double, 4> normalised(const std::array<double, 4>& q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

} // namespace

RigidBodies::RigidBodies(std::vector<RigidBody> bodies, const RigidSettings& settings)
    : bodies_(std::move(bodies)), settings_(settings), surface_(Mesh{}) {
    replace(std::move(bodies_));
}

void RigidBodies::replace(std::vector<RigidBody> bodies) {
    bodies_ = std::move(bodies);
    mesh_ = {};
    body_of_.clear();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        append(mesh_, bodies_[b].shape);
        body_of_.resize(mesh_.positions.size(), static_cast<std::uint32_t>(b));
    }
    gather();
    surface_.set_mesh(mesh_);
}

void RigidBodies::step() {
    start_ = mesh_.positions;
    for (RigidBody& body : bodies_)
        if (body.inverse_mass > 0)
            body.velocity = add(body.velocity, scaled(settings_.gravity, kFrameSeconds));
    hold_apart_near();
    move();
    bounce();
}

void RigidBodies::hold_apart_near() {
    std::vector<Touch> touches;
    surface_.set_motion(start_, start_);
    for (const FeaturePair& pair : self_within(surface_, settings_.thickness)) {
        const auto contact = contact_of(surface_, pair, start_);
        auto touch = contact ? touch_of(*contact, start_) : std::nullopt;
        if (!touch)
            continue;
        const double gap = dot(touch->normal, contact->offset(start_));
        touch->least_speed = -gap / kFrameSeconds * (gap < 0 ? kRecovery : 1);
        touches.push_back(*touch);
    }
    solve(touches);
}

void RigidBodies::bounce() {
    std::vector<Touch> touches;
    surface_.set_motion(start_, mesh_.positions);
    for (const FeatureImpact& impact : self_impacts(surface_).list) {
        const auto contact = contact_of(surface_, impact);
        auto touch = contact ? touch_of(*contact, mesh_.positions) : std::nullopt;
        if (!touch)
            continue;
        const double approach = -dot(touch->normal, relative_velocity(*touch));
        touch->least_speed = approach > kSlow ? settings_.restitution * approach : 0;
        if (approach > 0)
            touches.push_back(*touch);
    }
    solve(touches);
}

/// Returns nothing if both features belong to one body, or if neither body can move.
std::optional<RigidBodies::Touch> RigidBodies::touch_of(const Contact& contact,
                                                        std::span<const Vec3> positions) const {
    Touch touch;
    touch.a = body_of_[contact.vertices[0]];
    touch.b = body_of_[contact.vertices[3]];
    const RigidBody &a = bodies_[touch.a], &b = bodies_[touch.b];
    if (touch.a == touch.b || a.inverse_mass + b.inverse_mass == 0)
        return std::nullopt;
    touch.normal = contact.normal;
    // For features that have passed each other, the normal points the wrong way. A face's outside
    // corrects it or, for two edges, the direction between the bodies' centres.
    const bool to_face = contact.kind == ElementaryKind::vertex_face;
    const auto& [p, q, r, s] = contact.vertices;
    const Vec3 outward =
        to_face ? cross(subtract(positions[r], positions[q]), subtract(positions[s], positions[q]))
                : subtract(a.pose.translation, b.pose.translation);
    const bool centres_tell = a.inverse_mass > 0 && b.inverse_mass > 0;
    if ((to_face || centres_tell) && dot(outward, touch.normal) < 0)
        touch.normal = scaled(touch.normal, -1);
    Vec3 at_a, at_b;
    for (std::size_t i = 0; i < 4; ++i) {
        Vec3& at = i < contact.first_count() ? at_a : at_b;
        at = add(at, scaled(positions[contact.vertices[i]], std::abs(contact.weights[i])));
    }
    touch.arm_a = subtract(at_a, a.pose.translation);
    touch.arm_b = subtract(at_b, b.pose.translation);
    return touch;
}

Vec3 RigidBodies::relative_velocity(const Touch& touch) const {
    const RigidBody &a = bodies_[touch.a], &b = bodies_[touch.b];
    return subtract(add(a.velocity, cross(a.spin, touch.arm_a)),
                    add(b.velocity, cross(b.spin, touch.arm_b)));
}

/// The change of speed that a unit impulse causes along its direction.
double RigidBodies::mobility(const Touch& touch, const Vec3& direction) const {
    const auto of = [&](const RigidBody& body, const Vec3& arm) {
        const Vec3 lever = cross(arm, direction);
        return body.inverse_mass + body.inverse_inertia * dot(lever, lever);
    };
    return of(bodies_[touch.a], touch.arm_a) + of(bodies_[touch.b], touch.arm_b);
}

void RigidBodies::kick(const Touch& touch, const Vec3& impulse) {
    const auto change = [&](RigidBody& body, const Vec3& arm, double sign) {
        body.velocity = add(body.velocity, scaled(impulse, sign * body.inverse_mass));
        body.spin = add(body.spin, scaled(cross(arm, impulse), sign * body.inverse_inertia));
    };
    change(bodies_[touch.a], touch.arm_a, 1);
    change(bodies_[touch.b], touch.arm_b, -1);
}

void RigidBodies::solve(const std::vector<Touch>& touches) {
    for (int i = 0; i < kIterations; ++i)
        for (const Touch& touch : touches) {
            const Vec3 before = relative_velocity(touch);
            const double missing = touch.least_speed - dot(touch.normal, before);
            if (missing <= 0)
                continue;
            const double impulse = missing / mobility(touch, touch.normal);
            kick(touch, scaled(touch.normal, impulse));
            const Vec3 now = relative_velocity(touch);
            const Vec3 sliding = subtract(now, scaled(touch.normal, dot(touch.normal, now)));
            const double rate = norm(sliding);
            if (rate == 0)
                continue;
            const Vec3 direction = scaled(sliding, 1 / rate);
            kick(touch, scaled(direction, -std::min(rate / mobility(touch, direction),
                                                    settings_.friction * impulse)));
        }
}

void RigidBodies::move() {
    for (RigidBody& body : bodies_) {
        body.pose.translation = add(body.pose.translation, scaled(body.velocity, kFrameSeconds));
        body.pose.rotation = normalised(spun(body.pose.rotation, body.spin, kFrameSeconds));
    }
    gather();
}

void RigidBodies::gather() {
    std::size_t next = 0;
    for (const RigidBody& body : bodies_) {
        const Transform world_from_body(body.pose);
        for (const Vec3& p : body.shape.positions)
            mesh_.positions[next++] = on_float_grid(apply(world_from_body, p));
    }
}

} // namespace abut::scenes
