#include "measure.h"
#include "peers/peer_rigid.h"
#include "placement.h"

#ifdef ABUT_BENCH_EMBREE
#include <algorithm>
#include <embree3/rtcore.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_EMBREE

namespace {

/// A mesh as user geometry, which rtcCollide requires.
class EmbreeModel {
public:
    EmbreeModel(RTCDevice device, const Mesh& mesh)
        : mesh_(mesh), placed_(mesh.positions), scene_(rtcNewScene(device)) {
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
        geometry_ = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(mesh.triangles.size()));
        rtcSetGeometryUserData(geometry_, this);
        rtcSetGeometryBoundsFunction(geometry_, bounds, nullptr);
        rtcAttachGeometry(scene_, geometry_);
    }
    EmbreeModel(const EmbreeModel&) = delete;
    EmbreeModel& operator=(const EmbreeModel&) = delete;
    ~EmbreeModel() {
        rtcReleaseGeometry(geometry_);
        rtcReleaseScene(scene_);
    }

    void place(const Transform& world) {
        for (std::size_t i = 0; i < placed_.size(); ++i)
            placed_[i] = placed(world, mesh_.positions[i]);
        rtcCommitGeometry(geometry_);
        rtcCommitScene(scene_);
    }
    [[nodiscard]] RTCScene scene() const { return scene_; }

private:
    static void bounds(const RTCBoundsFunctionArguments* arguments) {
        const auto* model = static_cast<const EmbreeModel*>(arguments->geometryUserPtr);
        const auto& t = model->mesh_.triangles[arguments->primID];
        const Vec3 &p = model->placed_[t[0]], &q = model->placed_[t[1]], &r = model->placed_[t[2]];
        RTCBounds& box = *arguments->bounds_o;
        box.lower_x = static_cast<float>(std::min({p.x, q.x, r.x}));
        box.lower_y = static_cast<float>(std::min({p.y, q.y, r.y}));
        box.lower_z = static_cast<float>(std::min({p.z, q.z, r.z}));
        box.upper_x = static_cast<float>(std::max({p.x, q.x, r.x}));
        box.upper_y = static_cast<float>(std::max({p.y, q.y, r.y}));
        box.upper_z = static_cast<float>(std::max({p.z, q.z, r.z}));
    }

    const Mesh& mesh_;
    std::vector<Vec3> placed_;
    RTCScene scene_;
    RTCGeometry geometry_;
};

class EmbreePeer final : public RigidPeer {
public:
    EmbreePeer(const Mesh& a, const Mesh& b)
        : device_(rtcNewDevice("threads=1")), a_(device_, a), b_(device_, b) {}
    EmbreePeer(const EmbreePeer&) = delete;
    EmbreePeer& operator=(const EmbreePeer&) = delete;
    ~EmbreePeer() override = default;

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] bool answers(RigidQuery query) const override {
        return query == RigidQuery::all_contacts;
    }
    void place(const PosedPair& poses) override {
        a_.place(poses.a);
        b_.place(poses.b);
    }
    double run(RigidQuery /*query*/, const PosedPair& /*poses*/, double /*tolerance*/) override {
        std::size_t pairs = 0;
        const auto count = [](void* sum, RTCCollision* /*pairs*/, unsigned number) {
            *static_cast<std::size_t*>(sum) += number;
        };
        rtcCollide(a_.scene(), b_.scene(), count, &pairs);
        return static_cast<double>(pairs);
    }

private:
    std::string name_ = "Embree 3, boxes only";
    RTCDevice device_;
    EmbreeModel a_, b_;
};

} // namespace

std::unique_ptr<RigidPeer> make_embree_peer(const Mesh& a, const Mesh& b) {
    return std::make_unique<EmbreePeer>(a, b);
}

std::optional<double> embree_build_seconds(const Mesh& mesh) {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size()));
    for (const Vec3& p : mesh.positions)
        for (const double c : {p.x, p.y, p.z})
            *vertices++ = static_cast<float>(c);
    auto* triangles = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& t : mesh.triangles)
        triangles = std::copy(t.begin(), t.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    const double start = process_seconds();
    rtcCommitScene(scene);
    const double seconds = process_seconds() - start;
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return seconds;
}

#else

std::unique_ptr<RigidPeer> make_embree_peer(const Mesh& /*a*/, const Mesh& /*b*/) {
    return nullptr;
}
std::optional<double> embree_build_seconds(const Mesh& /*mesh*/) {
    return {};
}

#endif

} // namespace abut::bench
