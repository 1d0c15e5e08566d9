#include "peers/peer_robot.h"

#ifdef ABUT_BENCH_BULLET

#include "peers/bullet_convert.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>
#include <set>
#include <vector>

namespace abut::bench {

namespace {

/// Triangle meshes (GImpact) in a collision world with a dynamic tree. Bullet has no distance of two
/// meshes.
class BulletRobot : public RobotPeer, btOverlapFilterCallback {
public:
    explicit BulletRobot(const Robot& robot)
        : pairs_(robot.pairs().begin(), robot.pairs().end()), dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &configuration_) {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        broad_phase_.getOverlappingPairCache()->setOverlapFilterCallback(this);
        const RobotDescription& description = robot.description();
        for (std::uint32_t link = 0; link < description.links.size(); ++link)
            for (const RobotShape& shape : description.links[link].shapes)
                add(link, shape);
    }
    ~BulletRobot() override {
        for (const auto& body : bodies_)
            world_.removeCollisionObject(body->object.get());
    }
    BulletRobot(const BulletRobot&) = delete;
    BulletRobot& operator=(const BulletRobot&) = delete;
    [[nodiscard]] std::string name() const override { return "Bullet"; }

    bool collide(std::span<const Transform> links) override {
        for (const auto& body : bodies_)
            body->object->setWorldTransform(to_bullet(links[body->link]) * body->place);
        world_.performDiscreteCollisionDetection();
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
            const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(i);
            for (int k = 0; k < manifold->getNumContacts(); ++k)
                if (manifold->getContactPoint(k).getDistance() <= 0)
                    return true;
        }
        return false;
    }
    double distance(std::span<const Transform> /*links*/) override { return 0; }

private:
    struct Body {
        std::vector<btScalar> vertices;
        std::vector<int> triangles;
        std::unique_ptr<btTriangleIndexVertexArray> arrays;
        std::unique_ptr<btGImpactMeshShape> shape;
        std::unique_ptr<btCollisionObject> object;
        std::uint32_t link = 0;
        btTransform place;
    };

    void add(std::uint32_t link, const RobotShape& shape) {
        auto body = std::make_unique<Body>();
        for (const Vec3& p : shape.mesh.positions)
            for (const double v : {p.x, p.y, p.z})
                body->vertices.push_back(static_cast<btScalar>(v));
        for (const auto& triangle : shape.mesh.triangles)
            for (const std::uint32_t corner : triangle)
                body->triangles.push_back(static_cast<int>(corner));
        body->arrays = std::make_unique<btTriangleIndexVertexArray>(
            static_cast<int>(shape.mesh.triangles.size()), body->triangles.data(),
            static_cast<int>(3 * sizeof(int)), static_cast<int>(shape.mesh.positions.size()),
            body->vertices.data(), static_cast<int>(3 * sizeof(btScalar)));
        body->shape = std::make_unique<btGImpactMeshShape>(body->arrays.get());
        body->shape->setMargin(0);
        body->shape->updateBound();
        body->object = std::make_unique<btCollisionObject>();
        body->object->setCollisionShape(body->shape.get());
        body->object->setUserIndex(static_cast<int>(link));
        body->link = link;
        body->place = to_bullet(shape.link_from_shape);
        world_.addCollisionObject(body->object.get());
        bodies_.push_back(std::move(body));
    }
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
        const auto link = [](const btBroadphaseProxy* proxy) {
            return static_cast<std::uint32_t>(
                static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
        };
        return pairs_.contains(std::minmax(link(a), link(b)));
    }

    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btCollisionWorld world_;
    std::vector<std::unique_ptr<Body>> bodies_;
};

} // namespace

std::unique_ptr<RobotPeer> make_bullet_robot(const Robot& robot) {
    return std::make_unique<BulletRobot>(robot);
}

} // namespace abut::bench

#else

namespace abut::bench {

std::unique_ptr<RobotPeer> make_bullet_robot(const Robot& /*robot*/) {
    return nullptr;
}

} // namespace abut::bench

#endif
