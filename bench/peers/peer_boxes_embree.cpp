#include "peers/peer_boxes.h"

#ifdef ABUT_BENCH_EMBREE
#include <embree3/rtcore.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_EMBREE

namespace {

/// A scene of boxes that is rebuilt each step and collided with itself. The tree's bounds are
/// floats, not rounded outward.
class EmbreeBoxes : public BoxPeer {
public:
    EmbreeBoxes(const char* name, RTCBuildQuality quality, std::span<const Box3> boxes)
        : name_(name), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)),
          geometry_(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER)) {
        rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(boxes.size()));
        rtcSetGeometryUserData(geometry_, this);
        rtcSetGeometryBoundsFunction(geometry_, bounds, nullptr);
        rtcSetGeometryBuildQuality(geometry_, quality);
        rtcAttachGeometry(scene_, geometry_);
        rtcSetSceneBuildQuality(scene_, quality);
    }
    ~EmbreeBoxes() override {
        rtcReleaseGeometry(geometry_);
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    [[nodiscard]] std::string name() const override { return name_; }
    std::size_t step(std::span<const Box3> boxes) override {
        boxes_ = boxes;
        pairs_.clear();
        rtcCommitGeometry(geometry_);
        rtcCommitScene(scene_);
        rtcCollide(scene_, scene_, collect, this);
        return pairs_.size();
    }

private:
    static void bounds(const RTCBoundsFunctionArguments* arguments) {
        const auto& self = *static_cast<const EmbreeBoxes*>(arguments->geometryUserPtr);
        const Box3& box = self.boxes_[arguments->primID];
        RTCBounds& to = *arguments->bounds_o;
        to.lower_x = static_cast<float>(box.lower.x), to.upper_x = static_cast<float>(box.upper.x);
        to.lower_y = static_cast<float>(box.lower.y), to.upper_y = static_cast<float>(box.upper.y);
        to.lower_z = static_cast<float>(box.lower.z), to.upper_z = static_cast<float>(box.upper.z);
    }
    /// Receives candidate pairs of leaves. Each pair comes in both orders, and each box with
    /// itself.
    static void collect(void* user, RTCCollision* collisions, unsigned count) {
        auto& self = *static_cast<EmbreeBoxes*>(user);
        for (unsigned i = 0; i < count; ++i) {
            const unsigned a = collisions[i].primID0, b = collisions[i].primID1;
            if (a < b && overlap(self.boxes_[a], self.boxes_[b]))
                self.pairs_.emplace_back(a, b);
        }
    }
    static bool overlap(const Box3& a, const Box3& b) {
        return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
               b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
    }

    const char* name_;
    RTCDevice device_;
    RTCScene scene_;
    RTCGeometry geometry_;
    std::span<const Box3> boxes_;
    std::vector<std::pair<unsigned, unsigned>> pairs_;
};

std::unique_ptr<BoxPeer> make_medium(std::span<const Box3> boxes) {
    return std::make_unique<EmbreeBoxes>("Embree, rebuilt", RTC_BUILD_QUALITY_MEDIUM, boxes);
}
std::unique_ptr<BoxPeer> make_low(std::span<const Box3> boxes) {
    return std::make_unique<EmbreeBoxes>("Embree, rebuilt by Morton order", RTC_BUILD_QUALITY_LOW,
                                         boxes);
}

} // namespace

std::vector<MakeBoxPeer> embree_box_peers() {
    return {make_medium, make_low};
}

#else

std::vector<MakeBoxPeer> embree_box_peers() {
    return {};
}

#endif

} // namespace abut::bench
