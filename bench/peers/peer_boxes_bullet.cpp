#include "peers/peer_boxes.h"

#ifdef ABUT_BENCH_BULLET
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <LinearMath/btAabbUtil2.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_BULLET

namespace {

/// The inverse of the mean side: Bullet's margins are lengths, made for bodies of size about 1.
double scale_of(std::span<const Box3> boxes) {
    double sum = 0;
    for (const Box3& box : boxes)
        sum += box.upper.x - box.lower.x;
    return sum > 0 ? static_cast<double>(boxes.size()) / sum : 1;
}

btVector3 scaled(const Vec3& p, double scale) {
    return {static_cast<btScalar>(scale * p.x), static_cast<btScalar>(scale * p.y),
            static_cast<btScalar>(scale * p.z)};
}

/// Bullet's broad phases. Their pairs are those of enlarged boxes or of earlier ones, so step()
/// tests the boxes of each pair again.
template <typename Interface>
class BulletBoxes : public BoxPeer {
public:
    template <typename... Arguments>
    BulletBoxes(const char* name, std::span<const Box3> boxes, const Arguments&... arguments)
        : name_(name), scale_(scale_of(boxes)), broad_(arguments...) {
        for (const Box3& box : boxes)
            proxies_.push_back(broad_.createProxy(
                scaled(box.lower, scale_), scaled(box.upper, scale_), 0, this,
                btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter, nullptr));
    }
    ~BulletBoxes() override {
        for (btBroadphaseProxy* proxy : proxies_)
            broad_.destroyProxy(proxy, nullptr);
    }

    [[nodiscard]] std::string name() const override { return name_; }
    std::size_t step(std::span<const Box3> boxes) override {
        for (std::size_t i = 0; i < boxes.size(); ++i)
            broad_.setAabb(proxies_[i], scaled(boxes[i].lower, scale_),
                           scaled(boxes[i].upper, scale_), nullptr);
        broad_.calculateOverlappingPairs(nullptr);
        const auto& pairs = broad_.getOverlappingPairCache()->getOverlappingPairArray();
        std::size_t count = 0;
        for (int i = 0; i < pairs.size(); ++i)
            count +=
                TestAabbAgainstAabb2(pairs[i].m_pProxy0->m_aabbMin, pairs[i].m_pProxy0->m_aabbMax,
                                     pairs[i].m_pProxy1->m_aabbMin, pairs[i].m_pProxy1->m_aabbMax)
                    ? 1
                    : 0;
        return count;
    }

private:
    const char* name_;
    double scale_;
    Interface broad_;
    std::vector<btBroadphaseProxy*> proxies_;
};

std::unique_ptr<BoxPeer> bullet_sweep(std::span<const Box3> boxes) {
    // The world's bounds must be known beforehand: coordinates are quantised within them.
    const double scale = scale_of(boxes);
    return std::make_unique<BulletBoxes<bt32BitAxisSweep3>>(
        "Bullet sweep and prune", boxes, scaled({-2, -2, -2}, scale), scaled({3, 3, 3}, scale),
        static_cast<unsigned>(boxes.size()) + 2);
}
std::unique_ptr<BoxPeer> bullet_tree(std::span<const Box3> boxes) {
    return std::make_unique<BulletBoxes<btDbvtBroadphase>>("Bullet Dbvt", boxes);
}

} // namespace

std::vector<MakeBoxPeer> bullet_box_peers() {
    return {bullet_sweep, bullet_tree};
}

#else

std::vector<MakeBoxPeer> bullet_box_peers() {
    return {};
}

#endif

} // namespace abut::bench
