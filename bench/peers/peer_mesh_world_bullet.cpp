#include "peers/peer_mesh_world.h"

#ifdef ABUT_BENCH_BULLET
#include "peers/bullet_convert.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_BULLET

namespace {

class BulletMeshWorld final : public MeshWorldPeer {
public:
    explicit BulletMeshWorld(const MeshCrowd& crowd)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &configuration_) {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        for (const Mesh& mesh : crowd.meshes) {
            triangles_.push_back(std::make_unique<btTriangleMesh>());
            const auto point = [&](std::uint32_t corner) {
                return to_bullet(mesh.positions[corner]);
            };
            for (const auto& t : mesh.triangles)
                triangles_.back()->addTriangle(point(t[0]), point(t[1]), point(t[2]));
            shapes_.push_back(std::make_unique<btGImpactMeshShape>(triangles_.back().get()));
            shapes_.back()->setMargin(0);
            shapes_.back()->updateBound();
        }
        for (const std::size_t mesh : crowd.mesh_of) {
            bodies_.push_back(std::make_unique<btCollisionObject>());
            bodies_.back()->setCollisionShape(shapes_[mesh].get());
            world_.addCollisionObject(bodies_.back().get());
        }
    }
    ~BulletMeshWorld() override {
        for (const auto& body : bodies_)
            world_.removeCollisionObject(body.get());
    }
    BulletMeshWorld(const BulletMeshWorld&) = delete;
    BulletMeshWorld& operator=(const BulletMeshWorld&) = delete;

    [[nodiscard]] std::string name() const override { return "Bullet GImpact"; }
    std::size_t step(const std::vector<Transform>& places) override {
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            bodies_[i]->setWorldTransform(to_bullet(places[i]));
        world_.performDiscreteCollisionDetection();
        std::size_t touching = 0;
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
            touching += dispatcher_.getManifoldByIndexInternal(i)->getNumContacts() > 0 ? 1 : 0;
        return touching;
    }

private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btCollisionWorld world_;
    std::vector<std::unique_ptr<btTriangleMesh>> triangles_;
    std::vector<std::unique_ptr<btGImpactMeshShape>> shapes_;
    std::vector<std::unique_ptr<btCollisionObject>> bodies_;
};

} // namespace

std::unique_ptr<MeshWorldPeer> make_bullet_mesh_world(const MeshCrowd& crowd) {
    return std::make_unique<BulletMeshWorld>(crowd);
}

#else

std::unique_ptr<MeshWorldPeer> make_bullet_mesh_world(const MeshCrowd& /*crowd*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
