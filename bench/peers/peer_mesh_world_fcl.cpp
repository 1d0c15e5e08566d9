#include "peers/peer_mesh_world.h"

#ifdef ABUT_BENCH_FCL
#include "peers/fcl_model.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

class FclMeshWorld final : public MeshWorldPeer {
public:
    FclMeshWorld(const MeshCrowd& crowd, bool all_pairs)
        : most_(all_pairs ? std::size_t{1} << 30U : 1) {
        std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> models;
        for (const Mesh& mesh : crowd.meshes) {
            models.push_back(fcl_model<fcl::OBBRSSd>(mesh));
            models.back()->computeLocalAABB();
        }
        std::vector<fcl::CollisionObjectd*> all;
        for (const std::size_t mesh : crowd.mesh_of) {
            bodies_.push_back(std::make_unique<fcl::CollisionObjectd>(models[mesh]));
            all.push_back(bodies_.back().get());
        }
        manager_.registerObjects(all);
        manager_.setup();
    }
    [[nodiscard]] std::string name() const override { return "FCL"; }
    std::size_t step(const std::vector<Transform>& places) override {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            bodies_[i]->setTransform(fcl_transform(places[i]));
            bodies_[i]->computeAABB();
        }
        manager_.update();
        touching_ = 0;
        manager_.collide(this, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self) {
            auto& world = *static_cast<FclMeshWorld*>(self);
            const fcl::CollisionRequestd request(world.most_, false);
            fcl::CollisionResultd result;
            world.touching_ += fcl::collide(a, b, request, result) > 0 ? 1 : 0;
            return false;
        });
        return touching_;
    }

private:
    std::size_t most_; ///< pairs of triangles
    std::size_t touching_ = 0;
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> bodies_;
    fcl::DynamicAABBTreeCollisionManagerd manager_;
};

} // namespace

std::unique_ptr<MeshWorldPeer> make_fcl_mesh_world(const MeshCrowd& crowd, bool all_pairs) {
    return std::make_unique<FclMeshWorld>(crowd, all_pairs);
}

#else

std::unique_ptr<MeshWorldPeer> make_fcl_mesh_world(const MeshCrowd& /*crowd*/, bool /*all*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
