#pragma once

#include "suites/rigid_scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::bench {

enum class RigidQuery : std::uint8_t { first_contact, all_contacts, distance, within };

/// Another library on one pair of meshes.
class RigidPeer {
public:
    virtual ~RigidPeer() = default;

    [[nodiscard]] virtual const std::string& name() const = 0;
    [[nodiscard]] virtual bool answers(RigidQuery query) const = 0;
    /// Called once for each pose, untimed: prepares what the library needs after a model has moved.
    virtual void place(const PosedPair& /*poses*/) {}
    /// Returns the number of contacts (at most 1 for first_contact), the distance, or 1 if within
    /// `tolerance`.
    virtual double run(RigidQuery query, const PosedPair& poses, double tolerance) = 0;

protected:
    RigidPeer() = default;
    RigidPeer(const RigidPeer&) = default;
    RigidPeer& operator=(const RigidPeer&) = default;
};

/// FCL with each of its volumes. Empty if this program is built without FCL.
std::vector<std::unique_ptr<RigidPeer>> make_fcl_peers(const Mesh& a, const Mesh& b);
/// CGAL's trees of triangles with exact predicates. Null if built without CGAL.
std::unique_ptr<RigidPeer> make_cgal_peer(const Mesh& a, const Mesh& b);
/// Embree's collision of two scenes: pairs of leaf boxes, without tests of the triangles in them.
/// Null if built without Embree.
std::unique_ptr<RigidPeer> make_embree_peer(const Mesh& a, const Mesh& b);

/// Seconds that Embree takes to build a triangle tree of medium quality on one thread.
std::optional<double> embree_build_seconds(const Mesh& mesh);
/// Seconds that FCL takes to build its OBBRSS tree, and the tree's bytes.
struct FclBuild {
    double seconds = 0, bytes = 0;
};
std::optional<FclBuild> fcl_build(const Mesh& mesh);

} // namespace abut::bench
