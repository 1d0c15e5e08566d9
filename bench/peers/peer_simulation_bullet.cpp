#include "peers/peer_simulation.h"

#ifdef ABUT_BENCH_BULLET
#include "peers/bullet_convert.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_BULLET

namespace {

class BulletSimulation final : public SimulationPeer {
public:
    explicit BulletSimulation(const SimulatedScene& scene)
        : dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &solver_, &configuration_), gravity_(scene.gravity),
          sleep_(scene.sleep) {
        btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
        world_.setGravity({0, 0, static_cast<btScalar>(-scene.gravity)});
        for (const SimulatedBody& body : scene.bodies)
            add(body, scene);
        for (const SimulatedJoint& joint : scene.joints)
            join(joint);
    }
    ~BulletSimulation() override {
        for (const auto& joint : joints_)
            world_.removeConstraint(joint.get());
        for (const auto& body : bodies_)
            world_.removeRigidBody(body.get());
    }
    BulletSimulation(const BulletSimulation&) = delete;
    BulletSimulation& operator=(const BulletSimulation&) = delete;

    [[nodiscard]] std::string name() const override {
        return fmt::format("Bullet {}, float", btGetVersion());
    }
    void step(double seconds) override {
        world_.stepSimulation(static_cast<btScalar>(seconds), 0); // one step of this length
    }
    [[nodiscard]] Transform place(std::size_t body) const override {
        const btTransform& t = bodies_[body]->getWorldTransform();
        Transform result;
        std::size_t element = 0;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                result.m[element++] = column < 3 ? t.getBasis()[row][column] : t.getOrigin()[row];
        return result;
    }
    [[nodiscard]] double speed(std::size_t body) const override {
        return static_cast<double>(bodies_[body]->getLinearVelocity().length());
    }
    [[nodiscard]] double energy() const override {
        double sum = 0;
        for (const auto& body : bodies_) {
            if (body->isStaticObject())
                continue;
            const double mass = 1 / static_cast<double>(body->getInvMass());
            const btVector3 &v = body->getLinearVelocity(),
                            w = body->getAngularVelocity() * body->getWorldTransform().getBasis(),
                            inverse = body->getInvInertiaDiagLocal();
            sum += 0.5 * mass * static_cast<double>(v.length2()) +
                   mass * gravity_ * static_cast<double>(body->getWorldTransform().getOrigin().z());
            for (int axis = 0; axis < 3; ++axis)
                sum += 0.5 * static_cast<double>(w[axis] * w[axis]) /
                       static_cast<double>(inverse[axis]);
        }
        return sum;
    }

private:
    std::unique_ptr<btCollisionShape> shape_of(const SimulatedBody& body) {
        switch (body.kind) {
        case SimulatedBody::Kind::box:
            return std::make_unique<btBoxShape>(to_bullet(body.half));
        case SimulatedBody::Kind::ball:
            return std::make_unique<btSphereShape>(static_cast<btScalar>(body.radius));
        case SimulatedBody::Kind::capsule:
            return std::make_unique<btCapsuleShapeX>(static_cast<btScalar>(body.radius),
                                                     static_cast<btScalar>(2 * body.half.x));
        case SimulatedBody::Kind::mesh:
            break;
        }
        meshes_.push_back(std::make_unique<btTriangleMesh>());
        for (const auto& t : body.mesh.triangles)
            meshes_.back()->addTriangle(to_bullet(body.mesh.positions[t[0]]),
                                        to_bullet(body.mesh.positions[t[1]]),
                                        to_bullet(body.mesh.positions[t[2]]));
        auto shape = std::make_unique<btGImpactMeshShape>(meshes_.back().get());
        shape->updateBound();
        return shape;
    }
    void add(const SimulatedBody& body, const SimulatedScene& scene) {
        shapes_.push_back(shape_of(body));
        btVector3 inertia(0, 0, 0);
        const auto mass = static_cast<btScalar>(body.mass);
        if (body.mass > 0)
            shapes_.back()->calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
        const double friction = std::sqrt(scene.friction); // of two bodies: the product
        info.m_friction = static_cast<btScalar>(friction);
        // Bullet takes the sum of each body's value times the other body's friction.
        info.m_rollingFriction = static_cast<btScalar>(0.5 * scene.rolling / friction);
        info.m_spinningFriction = info.m_rollingFriction;
        info.m_startWorldTransform = btTransform(btQuaternion::getIdentity(), to_bullet(body.at));
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        if (!sleep_)
            bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
    }
    void join(const SimulatedJoint& joint) {
        btRigidBody &a = *bodies_[joint.a], &b = *bodies_[joint.b];
        const btVector3 at = to_bullet(joint.at);
        joints_.push_back(std::make_unique<btPoint2PointConstraint>(
            a, b, a.getWorldTransform().inverse() * at, b.getWorldTransform().inverse() * at));
        constexpr bool kDoNotCollide = true;
        world_.addConstraint(joints_.back().get(), kDoNotCollide);
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    double gravity_;
    bool sleep_;
    std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

} // namespace

std::unique_ptr<SimulationPeer> make_bullet_simulation(const SimulatedScene& scene) {
    return std::make_unique<BulletSimulation>(scene);
}

#else

std::unique_ptr<SimulationPeer> make_bullet_simulation(const SimulatedScene& /*scene*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
