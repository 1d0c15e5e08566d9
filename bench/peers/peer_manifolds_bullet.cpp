#include "peers/peer_manifolds.h"

#ifdef ABUT_BENCH_BULLET
#include "peers/bullet_convert.h"

#include <btBulletCollisionCommon.h>
#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_BULLET

namespace {

std::unique_ptr<btCollisionShape> bullet_shape(const ContactBody& body) {
    if (body.kind == ContactBody::Kind::box)
        return std::make_unique<btBoxShape>(to_bullet(body.half));
    if (body.kind == ContactBody::Kind::capsule)
        return std::make_unique<btCapsuleShapeZ>(static_cast<btScalar>(body.radius),
                                                 static_cast<btScalar>(2 * body.half.z));
    if (body.kind == ContactBody::Kind::ball)
        return std::make_unique<btSphereShape>(static_cast<btScalar>(body.radius));
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& point : body.points)
        hull->addPoint(to_bullet(point), false);
    hull->recalcLocalAabb();
    return hull;
}

/// A static mesh of Bullet and the arrays that it reads.
struct BulletMesh {
    explicit BulletMesh(const Mesh& mesh) {
        for (const Vec3& p : mesh.positions)
            vertices.push_back(to_bullet(p));
        for (const auto& t : mesh.triangles)
            for (const std::uint32_t v : t)
                indices.push_back(static_cast<int>(v));
        arrays = std::make_unique<btTriangleIndexVertexArray>(
            static_cast<int>(mesh.triangles.size()), indices.data(), 3 * sizeof(int),
            static_cast<int>(vertices.size()), &vertices[0].m_floats[0], sizeof(btVector3));
    }
    std::vector<btVector3> vertices;
    std::vector<int> indices;
    std::unique_ptr<btTriangleIndexVertexArray> arrays;
};

class BulletManifolds final : public ManifoldPeer {
public:
    BulletManifolds(const std::vector<ContactBody>& bodies, double margin) {
        world_.setForceUpdateAllAabbs(false);
        for (const ContactBody& body : bodies) {
            if (body.kind == ContactBody::Kind::mesh) {
                meshes_.push_back(std::make_unique<BulletMesh>(body.mesh));
                shapes_.push_back(
                    std::make_unique<btBvhTriangleMeshShape>(meshes_.back()->arrays.get(), true));
            } else {
                shapes_.push_back(bullet_shape(body));
            }
            objects_.push_back(std::make_unique<btCollisionObject>());
            btCollisionObject& object = *objects_.back();
            object.setCollisionShape(shapes_.back().get());
            if (margin != kOwnMargin)
                object.setContactProcessingThreshold(static_cast<btScalar>(margin));
            if (body.is_static)
                object.setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
            else
                object.setCollisionFlags(0);
            object.setActivationState(DISABLE_DEACTIVATION);
            world_.addCollisionObject(
                &object,
                body.is_static ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter,
                body.is_static ? btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter
                               : btBroadphaseProxy::AllFilter);
        }
    }
    ~BulletManifolds() override {
        for (const auto& object : objects_)
            world_.removeCollisionObject(object.get());
    }
    BulletManifolds(const BulletManifolds&) = delete;
    BulletManifolds& operator=(const BulletManifolds&) = delete;

    [[nodiscard]] std::string name() const override {
        return fmt::format("Bullet {}, float", btGetVersion());
    }
    std::size_t step(const std::vector<Pose>& poses) override {
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const auto& q = poses[i].rotation;
            const auto at = [&](std::size_t k) { return static_cast<btScalar>(q[k]); };
            objects_[i]->setWorldTransform(
                btTransform(btQuaternion(at(1), at(2), at(3), at(0)).normalized(),
                            to_bullet(poses[i].translation)));
        }
        world_.performDiscreteCollisionDetection();
        std::size_t points = 0;
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
            points += static_cast<std::size_t>(
                dispatcher_.getManifoldByIndexInternal(i)->getNumContacts());
        return points;
    }

private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broad_phase_;
    btCollisionWorld world_{&dispatcher_, &broad_phase_, &configuration_};
    std::vector<std::unique_ptr<BulletMesh>> meshes_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

} // namespace

std::unique_ptr<ManifoldPeer> make_bullet_manifolds(const std::vector<ContactBody>& bodies,
                                                    double margin) {
    return std::make_unique<BulletManifolds>(bodies, margin);
}

#else

std::unique_ptr<ManifoldPeer> make_bullet_manifolds(const std::vector<ContactBody>& /*bodies*/,
                                                    double /*margin*/) {
    return {};
}

#endif

} // namespace abut::bench
