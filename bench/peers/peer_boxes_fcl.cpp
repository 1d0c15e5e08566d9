#include "peers/peer_boxes.h"

#ifdef ABUT_BENCH_FCL
#include <fcl/fcl.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

/// A collision object whose bounds can be set directly.
class Boundary : public fcl::CollisionObjectd {
public:
    Boundary() : fcl::CollisionObjectd(std::make_shared<fcl::Boxd>(1, 1, 1)) {}
    void set(const Box3& box) {
        aabb = fcl::AABBd(fcl::Vector3d(box.lower.x, box.lower.y, box.lower.z),
                          fcl::Vector3d(box.upper.x, box.upper.y, box.upper.z));
    }
};

template <typename Manager>
class FclBoxes : public BoxPeer {
public:
    FclBoxes(const char* name, std::span<const Box3> boxes) : name_(name), bodies_(boxes.size()) {
        std::vector<fcl::CollisionObjectd*> all;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            bodies_[i].set(boxes[i]);
            all.push_back(&bodies_[i]);
        }
        manager_.registerObjects(all);
        manager_.setup();
    }

    [[nodiscard]] std::string name() const override { return name_; }
    std::size_t step(std::span<const Box3> boxes) override {
        pairs_.clear();
        for (std::size_t i = 0; i < boxes.size(); ++i)
            bodies_[i].set(boxes[i]);
        manager_.update();
        manager_.collide(this, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self) {
            static_cast<FclBoxes*>(self)->pairs_.emplace_back(a, b);
            return false;
        });
        return pairs_.size();
    }

private:
    const char* name_;
    std::vector<Boundary> bodies_;
    Manager manager_;
    std::vector<std::pair<fcl::CollisionObjectd*, fcl::CollisionObjectd*>> pairs_;
};

std::unique_ptr<BoxPeer> fcl_tree(std::span<const Box3> boxes) {
    return std::make_unique<FclBoxes<fcl::DynamicAABBTreeCollisionManagerd>>("FCL dynamic tree",
                                                                             boxes);
}
std::unique_ptr<BoxPeer> fcl_sweep(std::span<const Box3> boxes) {
    return std::make_unique<FclBoxes<fcl::SSaPCollisionManagerd>>("FCL sweep on one axis", boxes);
}

} // namespace

std::vector<MakeBoxPeer> fcl_box_peers() {
    return {fcl_tree, fcl_sweep};
}

#else

std::vector<MakeBoxPeer> fcl_box_peers() {
    return {};
}

#endif

} // namespace abut::bench
