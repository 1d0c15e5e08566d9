#include "simulator/simulator.h"

#include <abut/error.h>

#include <string>

namespace simulation {

using abut::Error;
using abut::ErrorCode;

Simulator::Simulator(const Settings& settings)
    : settings_(settings), joined_(std::make_shared<std::set<abut::BodyPair>>()),
      world_({.filter = [joined = joined_](abut::BodyId a, abut::BodyId b) {
          return !joined->contains({a, b});
      }}) {
    check(settings);
}

void Simulator::check(const Settings& settings) {
    if (!std::isfinite(length(settings.gravity)))
        throw Error(ErrorCode::bad_argument, "gravity is not finite");
    if (settings.substeps < 1)
        throw Error(ErrorCode::bad_argument, "a step needs at least one sub-step");
    if (settings.joint_passes < 0)
        throw Error(ErrorCode::bad_argument, "the number of passes over joints is negative");
    for (const double value : {settings.margin, settings.contact_hertz, settings.contact_damping,
                               settings.push_speed, settings.joint_hertz, settings.joint_damping,
                               settings.bounce_speed, settings.sleep_speed, settings.sleep_after})
        if (!std::isfinite(value) || value < 0)
            throw Error(ErrorCode::bad_argument, "a setting is negative or not finite");
}

void Simulator::check(const Material& material) {
    for (const double value :
         {material.density, material.friction, material.bounce, material.rolling})
        if (!std::isfinite(value) || value < 0)
            throw Error(ErrorCode::bad_argument, "a material's value is negative or not finite");
    if (material.bounce > 1)
        throw Error(ErrorCode::bad_argument, "a material's bounce exceeds 1");
}

void Simulator::check(BodyNumber body) const {
    if (body >= bodies_.size())
        throw Error(ErrorCode::bad_argument, "there is no body " + std::to_string(body));
}

BodyNumber Simulator::add_body(abut::BodyId id, const Pose& pose, const Mass& mass,
                               const Material& material) {
    // The inertia of a tiny or thin body may be 0 to rounding, and then has no inverse.
    const double determinant = dot(mass.inertia.x, cross(mass.inertia.y, mass.inertia.z));
    if (material.density > 0 && !(mass.mass > 0 && std::isfinite(mass.mass) && determinant > 0 &&
                                  std::isfinite(determinant))) {
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
    check(a), check(b);
    if (a == b || !(length(place.axis) > 0) || !std::isfinite(length(place.axis)))
        throw Error(ErrorCode::bad_argument, "a joint needs two bodies and an axis");
    if (!std::isfinite(length(place.point)))
        throw Error(ErrorCode::bad_argument, "a joint's point is not finite");
    joints_.emplace_back(kind, a, b, place, bodies_);
    joined_->insert(
        {std::min(bodies_[a].id, bodies_[b].id), std::max(bodies_[a].id, bodies_[b].id)});
    world_.refilter();
}

void Simulator::wake(BodyNumber body) {
    check(body);
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
            sum += mechanical_energy(body, settings_.gravity);
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
    energy_.remember(bodies_, settings_.gravity);
    find_contacts(seconds);
    for (int i = 0; i < settings_.substeps; ++i)
        substep(seconds / settings_.substeps);
    contacts_.bounce(bodies_, settings_);
    move_bodies(seconds);
    energy_.enforce(bodies_, islands_, settings_.gravity);
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

} // namespace simulation
