#include "peers/peer_swept.h"

#ifdef ABUT_BENCH_EMBREE
#include <algorithm>
#include <embree3/rtcore.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_EMBREE

namespace {

void swept_bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto* step = static_cast<const CcdStep*>(arguments->geometryUserPtr);
    const auto& t = step->start.triangles[arguments->primID];
    Vec3 low = step->end[t[0]], high = low;
    for (const std::uint32_t v : t)
        for (const Vec3& p : {step->start.positions[v], step->end[v]}) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = static_cast<float>(low.x), box.upper_x = static_cast<float>(high.x);
    box.lower_y = static_cast<float>(low.y), box.upper_y = static_cast<float>(high.y);
    box.lower_z = static_cast<float>(low.z), box.upper_z = static_cast<float>(high.z);
}

} // namespace

std::optional<std::size_t> embree_swept_pairs(const CcdStep& step) {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(step.start.triangles.size()));
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): Embree only hands it back
    rtcSetGeometryUserData(geometry, const_cast<CcdStep*>(&step));
    rtcSetGeometryBoundsFunction(geometry, swept_bounds, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    std::size_t pairs = 0;
    const auto count = [](void* sum, RTCCollision* collisions, unsigned number) {
        for (unsigned i = 0; i < number; ++i)
            *static_cast<std::size_t*>(sum) +=
                collisions[i].primID0 < collisions[i].primID1 ? 1 : 0;
    };
    rtcCollide(scene, scene, count, &pairs);
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return pairs;
}

#else

std::optional<std::size_t> embree_swept_pairs(const CcdStep& /*step*/) {
    return std::nullopt;
}

#endif

} // namespace abut::bench
