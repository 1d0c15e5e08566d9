#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// A body of a simulation. Its origin is its centre of mass.
struct SimulatedBody {
    enum class Kind { box, ball, capsule, mesh } kind = Kind::box;
    Vec3 half{};       ///< box: half sides. Capsule: x is half of the axis, along x
    double radius = 0; ///< of a ball or a capsule
    Mesh mesh{};
    Vec3 at{};       ///< without rotation
    double mass = 0; ///< 0: static
};

/// Two bodies that share a point.
struct SimulatedJoint {
    std::size_t a = 0, b = 0;
    Vec3 at{}; ///< at the begin, in the world
};

struct SimulatedScene {
    std::vector<SimulatedBody> bodies;
    std::vector<SimulatedJoint> joints;
    double friction = 0.5;  ///< of two bodies
    double rolling = 0.001; ///< rolling resistance of two bodies: a length in metres
    double gravity = 9.81;  ///< downwards along z
    bool sleep = false;     ///< bodies at rest may fall asleep
};

/// A peer that simulates rigid bodies.
class SimulationPeer {
public:
    virtual ~SimulationPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    virtual void step(double seconds) = 0;
    /// Maps the frame of a body to the world.
    [[nodiscard]] virtual Transform place(std::size_t body) const = 0;
    [[nodiscard]] virtual double speed(std::size_t body) const = 0;
    /// Kinetic and potential energy of all bodies.
    [[nodiscard]] virtual double energy() const = 0;

protected:
    SimulationPeer() = default;
    SimulationPeer(const SimulationPeer&) = default;
    SimulationPeer& operator=(const SimulationPeer&) = default;
};

/// Bullet's world of rigid bodies with its usual settings, in single precision; meshes are GImpact
/// shapes. Null if this program is built without Bullet.
std::unique_ptr<SimulationPeer> make_bullet_simulation(const SimulatedScene& scene);

} // namespace abut::bench
