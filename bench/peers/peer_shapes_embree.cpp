#include "peers/peer_shapes.h"

#ifdef ABUT_BENCH_EMBREE
#include <embree3/rtcore.h>
#include <limits>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_EMBREE

namespace {

class EmbreeRays : public RayPeer {
public:
    explicit EmbreeRays(const Mesh& mesh)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                              RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                              mesh.positions.size()));
        for (const Vec3& p : mesh.positions)
            for (const double c : {p.x, p.y, p.z})
                *v++ = static_cast<float>(c);
        auto* t = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), mesh.triangles.size()));
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t vertex : triangle)
                *t++ = vertex;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(scene_);
    }
    ~EmbreeRays() override {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeRays(const EmbreeRays&) = delete;
    EmbreeRays& operator=(const EmbreeRays&) = delete;

    [[nodiscard]] double first_hit(const Ray& ray) const override {
        RTCIntersectContext context{};
        rtcInitIntersectContext(&context);
        RTCRayHit r{};
        r.ray.org_x = static_cast<float>(ray.origin.x);
        r.ray.org_y = static_cast<float>(ray.origin.y);
        r.ray.org_z = static_cast<float>(ray.origin.z);
        r.ray.dir_x = static_cast<float>(ray.direction.x);
        r.ray.dir_y = static_cast<float>(ray.direction.y);
        r.ray.dir_z = static_cast<float>(ray.direction.z);
        r.ray.tfar = std::numeric_limits<float>::infinity();
        r.ray.mask = ~0U;
        r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &r);
        return r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<double>::infinity()
                                                       : double{r.ray.tfar};
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

} // namespace

std::unique_ptr<RayPeer> make_embree_rays(const Mesh& mesh) {
    return std::make_unique<EmbreeRays>(mesh);
}

#else

std::unique_ptr<RayPeer> make_embree_rays(const Mesh& /*mesh*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
