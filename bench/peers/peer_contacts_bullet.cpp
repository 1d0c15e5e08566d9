#include "peers/peer_contacts.h"

#ifdef ABUT_BENCH_BULLET

#include "peers/bullet_convert.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>
#include <vector>

namespace abut::bench {

namespace {

/// Counts the contacts of one test.
struct ContactCount final : btCollisionWorld::ContactResultCallback {
    std::size_t count = 0;
    btScalar addSingleResult(btManifoldPoint& /*point*/, const btCollisionObjectWrapper* /*a*/,
                             int /*part_a*/, int /*index_a*/, const btCollisionObjectWrapper* /*b*/,
                             int /*part_b*/, int /*index_b*/) override {
        ++count;
        return 0;
    }
};

class BulletContacts final : public ContactPeer {
public:
    explicit BulletContacts(const Mesh& mesh)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &configuration_) {
        // contactPairTest asks the table for closest points, which GImpact does not fill itself.
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        dispatcher_.registerClosestPointsCreateFunc(GIMPACT_SHAPE_PROXYTYPE,
                                                    GIMPACT_SHAPE_PROXYTYPE, &create_);
        for (const Vec3& p : mesh.positions)
            for (const double x : {p.x, p.y, p.z})
                vertices_.push_back(static_cast<btScalar>(x));
        for (const auto& t : mesh.triangles)
            for (const std::uint32_t corner : t)
                corners_.push_back(static_cast<int>(corner));
        arrays_ = std::make_unique<btTriangleIndexVertexArray>(
            static_cast<int>(mesh.triangles.size()), corners_.data(),
            static_cast<int>(3 * sizeof(int)), static_cast<int>(mesh.positions.size()),
            vertices_.data(), static_cast<int>(3 * sizeof(btScalar)));
        shape_ = std::make_unique<btGImpactMeshShape>(arrays_.get());
        shape_->setMargin(0);
        shape_->updateBound();
        a_.setCollisionShape(shape_.get());
        b_.setCollisionShape(shape_.get());
    }
    [[nodiscard]] std::string name() const override { return "Bullet GImpact"; }
    std::size_t contacts(const Transform& a, const Transform& b) override {
        a_.setWorldTransform(to_bullet(a));
        b_.setWorldTransform(to_bullet(b));
        ContactCount counted;
        world_.contactPairTest(&a_, &b_, counted);
        return counted.count;
    }

private:
    btGImpactCollisionAlgorithm::CreateFunc create_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btCollisionWorld world_;
    std::vector<btScalar> vertices_;
    std::vector<int> corners_;
    std::unique_ptr<btTriangleIndexVertexArray> arrays_;
    std::unique_ptr<btGImpactMeshShape> shape_;
    btCollisionObject a_, b_;
};

} // namespace

std::unique_ptr<ContactPeer> make_bullet_contacts(const Mesh& mesh) {
    return std::make_unique<BulletContacts>(mesh);
}

} // namespace abut::bench

#else

namespace abut::bench {

std::unique_ptr<ContactPeer> make_bullet_contacts(const Mesh& /*mesh*/) {
    return nullptr;
}

} // namespace abut::bench

#endif
