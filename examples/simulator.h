#pragma once

#include <abut/world.h>

#include "rotation.h"

#include <algorithm>
#include <map>
#include <vector>

/// A small impulse-based simulator of rigid bodies, as an example of a simulation loop with Abut.
///
/// Each step applies forces, finds contacts (`World::penetration`), applies impulses that end
/// approach and cause friction, and moves the bodies. For fast bodies it finds the first impact on
/// their path (`World::time_of_impact`).
namespace drop {

/// Mass and principal moments of inertia about the body's origin, which is its centre of mass. A
/// body with mass 0 is never moved.
struct Inertia {
    double mass = 0;
    Vec3 moments;
};
Inertia inertia_of(const abut::Sphere& sphere, double density);
Inertia inertia_of(const abut::Capsule& capsule, double density); ///< along z
Inertia inertia_of(const abut::Box3& box, double density);

struct Settings {
    Vec3 gravity{0, 0, -9.81};
    double friction = 0.5;
    int iterations = 8;            ///< of the impulses, per step
    double allowed_depth = 0.0005; ///< penetration that is not corrected; a length
    double correction = 0.2;       ///< fraction of the remaining depth that a step corrects
    double most_correction = 1;    ///< maximum speed of this correction
    double contact_drift = 0.01;   ///< length by which a kept contact point may open or slide
};

struct RigidBody {
    abut::BodyId id;
    abut::Pose pose;
    Inertia inertia;
    double size = 0; ///< length that it may move in a step without a test for impacts
    Vec3 velocity, spin;
    /// World frame, for this step: columns of the inverse inertia tensor; and 1 / mass.
    std::array<Vec3, 3> inverse_inertia{};
    double inverse_mass = 0;
};

class Simulator {
public:
    explicit Simulator(const Settings& settings = {}) : settings_(settings) {}

    /// Adds a body whose shape is centred at its centre of mass. Density 0: the body is never
    /// moved. Returns the body's number.
    template <typename Shape>
    std::size_t add(const Shape& shape, const abut::Pose& pose, double density);
    void step(double dt);

    [[nodiscard]] std::vector<RigidBody>& bodies() { return bodies_; }
    [[nodiscard]] abut::World& world() { return world_; }

private:
    /// A point where two bodies touch, kept as long as it stays together. A body that rests on a
    /// face needs several, and each step finds one.
    struct ContactPoint {
        Vec3 on_a, on_b;   ///< in the frames of both bodies
        Vec3 arm_a, arm_b; ///< from the centres to the common point, world frame
        Vec3 apart;        ///< from the point on a to that on b, world frame
        double depth = 0;  ///< minus the component of `apart` along the normal
        double yield = 0;  ///< approach speed that a unit impulse along the normal ends
        double push = 0;   ///< accumulated impulse along the normal
        Vec3 drag;         ///< accumulated impulse of friction
    };
    struct Contact {
        abut::BodyPair pair;
        std::size_t a = 0, b = 0; ///< body numbers
        Vec3 normal;              ///< from a to b
        std::vector<ContactPoint> points;
    };

    void prepare_bodies(double dt);
    void find_contacts();
    void keep_contacts();
    void add_point(Contact& contact, const abut::BodyGap& gap);
    void refresh(const Contact& contact, ContactPoint& point) const;
    void solve(double dt);
    void solve_point(const Contact& contact, ContactPoint& point, double dt);
    void apply(const Contact& contact, const ContactPoint& point, const Vec3& impulse);
    [[nodiscard]] double yield(const Contact& contact, const ContactPoint& point,
                               const Vec3& along) const;
    void move(double dt);
    [[nodiscard]] std::vector<double> free_shares(double dt);

    Settings settings_;
    abut::World world_;
    std::vector<RigidBody> bodies_;
    std::map<abut::BodyId, std::size_t> number_;
    std::vector<Contact> contacts_; ///< sorted by their pairs
};

template <typename Shape>
std::size_t Simulator::add(const Shape& shape, const abut::Pose& pose, double density) {
    abut::BodyOptions options;
    options.is_static = density == 0;
    RigidBody body;
    body.id = world_.add(shape, pose, options);
    body.pose = pose;
    body.inertia = inertia_of(shape, density);
    const abut::Box3 box = world_.box(body.id);
    const Vec3 sides = box.upper - box.lower;
    body.size = 0.25 * std::min({sides.x, sides.y, sides.z});
    number_[body.id] = bodies_.size();
    bodies_.push_back(body);
    return bodies_.size() - 1;
}

} // namespace drop
