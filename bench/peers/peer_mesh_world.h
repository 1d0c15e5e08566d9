#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

/// Bodies that share a few meshes.
struct MeshCrowd {
    std::vector<Mesh> meshes;
    std::vector<std::size_t> mesh_of; ///< of each body
};

/// A peer that finds which meshes touch, from step to step.
class MeshWorldPeer {
public:
    virtual ~MeshWorldPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Moves all bodies. Returns the number of pairs that touch.
    virtual std::size_t step(const std::vector<Transform>& places) = 0;

protected:
    MeshWorldPeer() = default;
    MeshWorldPeer(const MeshWorldPeer&) = default;
    MeshWorldPeer& operator=(const MeshWorldPeer&) = default;
};

/// FCL's dynamic tree of boxes and OBBRSS hierarchies: the first pair of triangles of each two
/// bodies, or all pairs without contact points. Null if this program is built without FCL.
std::unique_ptr<MeshWorldPeer> make_fcl_mesh_world(const MeshCrowd& crowd, bool all_pairs);
/// Bullet's collision world with GImpact meshes, in single precision: contact manifolds. Null if
/// this program is built without Bullet.
std::unique_ptr<MeshWorldPeer> make_bullet_mesh_world(const MeshCrowd& crowd);

} // namespace abut::bench
