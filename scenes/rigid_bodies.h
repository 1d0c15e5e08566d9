#pragma once

#include <abut/deformable.h>
#include <abut/mesh.h>

#include "scenes/deforming/contact.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut::scenes {

/// Units: metres and seconds.
struct RigidBody {
    Mesh shape; ///< closed, facing outward, about the centre of mass
    Pose pose;
    Vec3 velocity;
    Vec3 spin;                  ///< radians per second about an axis
    double inverse_mass = 0;    ///< 0: the body is never pushed
    double inverse_inertia = 0; ///< the same about every axis
};

struct RigidSettings {
    Vec3 gravity{0, -9.81, 0};
    double thickness = 0.005; ///< features closer than this rest on each other
    double restitution = 0.5; ///< part of the speed that a bounce returns
    double friction = 0.3;    ///< Coulomb's coefficient
};

/// Rigid bodies in one mesh, in the given order. A body that meets another in a frame moves on to
/// the end of that frame and bounces in the next. So frames contain impacts and shallow
/// penetrations.
///
/// Source      sequential impulses on the features that a query finds. Features near each other at
///             the start of a frame may not approach by more than their gap.
class RigidBodies {
public:
    RigidBodies(std::vector<RigidBody> bodies, const RigidSettings& settings);

    /// The current frame. Its positions are exact as floats.
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const std::vector<RigidBody>& bodies() const { return bodies_; }
    /// Advances by one frame.
    void step();
    /// Replaces the bodies.
    void replace(std::vector<RigidBody> bodies);

private:
    /// Two bodies at a place where they are near each other or have met.
    struct Touch {
        std::uint32_t a = 0, b = 0;
        Vec3 normal;            ///< from b towards a
        Vec3 arm_a, arm_b;      ///< from the centres to the points
        double least_speed = 0; ///< smallest allowed speed along the normal
    };

    std::optional<Touch> touch_of(const Contact& contact, std::span<const Vec3> positions) const;
    void hold_apart_near();
    void bounce();
    void solve(const std::vector<Touch>& touches);
    [[nodiscard]] Vec3 relative_velocity(const Touch& touch) const;
    [[nodiscard]] double mobility(const Touch& touch, const Vec3& direction) const;
    void kick(const Touch& touch, const Vec3& impulse);
    void move();
    void gather();

    std::vector<RigidBody> bodies_;
    RigidSettings settings_;
    Mesh mesh_; ///< the current frame
    std::vector<std::uint32_t> body_of_;
    std::vector<Vec3> start_; ///< positions at the start of the frame
    Deformable surface_;
};

} // namespace abut::scenes
