#pragma once

#include <abut/world.h>

#include "simulator/contacts.h"
#include "simulator/energy_bound.h"
#include "simulator/islands.h"
#include "simulator/joints.h"

#include <memory>
#include <set>
#include <span>
#include <vector>

/// A simulator of rigid bodies, as an example of a simulation loop with Abut.
///
/// Each step finds contacts (`World::contact_manifolds`), moves the bodies in sub-steps with
/// impulses at contacts and joints, and stops fast bodies at their first impact
/// (`World::time_of_impact`). docs/simulation-loop.md explains it.
namespace simulation {

class Simulator {
public:
    /// Errors      abut::Error{bad_argument} if a setting is not finite or is negative, or if there
    ///             are no sub-steps.
    explicit Simulator(const Settings& settings = {});

    /// Adds a sphere, a capsule, a box, a cylinder, a cone, a `Convex` or a `Model`.
    ///
    /// Errors      abut::Error{bad_argument} as `World::add`; if a value of the material is not
    ///             finite or negative, or `bounce` exceeds 1; if a body of positive density has no
    ///             volume, or so little that its inertia has no inverse in double precision.
    template <typename Shape>
    BodyNumber add(const Shape& shape, const Pose& pose, const Material& material = {});

    /// Joins two bodies. They then do not collide with each other.
    ///
    /// Errors      abut::Error{bad_argument} if the bodies are the same, or a number is not that of a
    ///             body, or the place is not finite, or the axis has no length.
    void join(JointKind kind, BodyNumber a, BodyNumber b, const JointPlace& place);

    /// Lets time pass. Steps of one length are best: the springs of contacts depend on it, so that a
    /// stack rises and sinks as it changes. A negative or infinite time is Error{bad_argument}.
    void step(double seconds);

    /// Call it after a change of a body's velocity, because the body may be asleep. A number that is
    /// not that of a body is Error{bad_argument}.
    void wake(BodyNumber body);

    [[nodiscard]] std::span<Body> bodies() { return bodies_; }
    [[nodiscard]] std::span<const Body> bodies() const { return bodies_; }
    [[nodiscard]] std::span<const Joint> joints() const { return joints_; }
    [[nodiscard]] const Contacts& contacts() const { return contacts_; }
    [[nodiscard]] abut::World& world() { return world_; }
    [[nodiscard]] std::size_t awake() const; ///< number of bodies that are not static or asleep
    /// Kinetic energy, and potential energy relative to the origin.
    [[nodiscard]] double energy() const;

private:
    /// An impact, and the shares of their motions after which the bodies have it; 0 for a body that
    /// is taken to stay.
    struct FoundImpact {
        abut::BodyImpact met;
        double share_a = 0, share_b = 0;
    };

    static void check(const Settings& settings);
    static void check(const Material& material);
    void check(BodyNumber body) const;
    BodyNumber add_body(abut::BodyId id, const Pose& pose, const Mass& mass,
                        const Material& material);
    void find_contacts(double seconds);
    void substep(double h);
    void move_bodies(double seconds);
    std::vector<double> shares_to_impacts(std::vector<FoundImpact>& impacts);
    bool go_on(std::span<const FoundImpact> impacts, std::vector<double>& left);
    bool shorten_motions(std::vector<double>& share, bool to_impact,
                         std::vector<FoundImpact>& impacts);
    [[nodiscard]] bool is_reached(const FoundImpact& impact, std::span<const double> share) const;
    void collide(const abut::BodyImpact& met);
    void stop_together(std::vector<double>& share) const;
    static void stop_at(Body& body, double share);
    void lose_fall(Body& body, const Vec3& back) const;

    Settings settings_;
    std::shared_ptr<std::set<abut::BodyPair>> joined_; ///< pairs that do not collide
    abut::World world_;
    std::vector<Body> bodies_;
    std::vector<BodyNumber> number_of_; ///< by BodyId::index
    std::vector<Joint> joints_;
    Contacts contacts_;
    Islands islands_;
    EnergyBound energy_;
};

template <typename Shape>
BodyNumber Simulator::add(const Shape& shape, const Pose& pose, const Material& material) {
    check(material);
    const bool is_static = material.density == 0;
    const Mass mass = is_static ? Mass{} : mass_of(shape, material.density);
    return add_body(world_.add(shape, pose, {.is_static = is_static}), pose, mass, material);
}

} // namespace simulation
