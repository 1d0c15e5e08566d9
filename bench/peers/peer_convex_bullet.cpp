#include "peers/peer_convex.h"

#ifdef ABUT_BENCH_BULLET
#include "peers/bullet_convert.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <btBulletCollisionCommon.h>
#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_BULLET

namespace {

std::unique_ptr<btConvexHullShape> bullet_shape(const Convex& body) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (const Vec3& p : body.vertices())
        shape->addPoint(to_bullet(p), false);
    shape->recalcLocalAabb();
    shape->setMargin(0);
    return shape;
}

class BulletConvexPeer final : public ConvexPeer {
public:
    BulletConvexPeer(const Convex& a, const Convex& b) : a_(bullet_shape(a)), b_(bullet_shape(b)) {}

    [[nodiscard]] std::string name() const override {
        return fmt::format("Bullet {}, GJK/EPA, float", btGetVersion());
    }
    void set_poses(const std::vector<PosedPair>& poses) override {
        inputs_.clear();
        for (const PosedPair& p : poses) {
            btDiscreteCollisionDetectorInterface::ClosestPointInput input;
            input.m_transformA = to_bullet(p.a);
            input.m_transformB = to_bullet(p.b);
            inputs_.push_back(input);
        }
    }
    double distance(std::size_t pose) override { return std::max(0.0, query(pose, nullptr)); }
    double penetration(std::size_t pose) override { return -query(pose, &epa_); }

private:
    double query(std::size_t pose, btConvexPenetrationDepthSolver* solver) {
        btGjkPairDetector detector(a_.get(), b_.get(), &simplex_, solver);
        btPointCollector result;
        detector.getClosestPoints(inputs_[pose], result, nullptr);
        return result.m_hasResult ? static_cast<double>(result.m_distance) : 0;
    }

    std::unique_ptr<btConvexHullShape> a_, b_;
    std::vector<btDiscreteCollisionDetectorInterface::ClosestPointInput> inputs_;
    btVoronoiSimplexSolver simplex_; // keeps the last direction, as Bullet does between steps
    btGjkEpaPenetrationDepthSolver epa_;
};

} // namespace

std::unique_ptr<ConvexPeer> make_bullet_convex(const Convex& a, const Convex& b) {
    return std::make_unique<BulletConvexPeer>(a, b);
}

#else

std::unique_ptr<ConvexPeer> make_bullet_convex(const Convex& /*a*/, const Convex& /*b*/) {
    return {};
}

#endif

} // namespace abut::bench
