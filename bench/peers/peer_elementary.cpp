#include "peers/peer_elementary.h"

#ifdef ABUT_BENCH_FCL
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

bool has_fcl_elementary() {
    return true;
}

std::optional<double> fcl_elementary_impact(const ElementaryPair& pair) {
    using FclPoint = fcl::Vector3<double>;
    const auto point = [](const Vec3& p) { return FclPoint(p.x, p.y, p.z); };
    const auto &s = pair.start, &e = pair.end;
    double time = 0;
    FclPoint place;
    // FCL takes the vertex last.
    const bool hit =
        pair.kind == ElementaryKind::vertex_face
            ? fcl::detail::Intersect<double>::intersect_VF(point(s[1]), point(s[2]), point(s[3]),
                                                           point(s[0]), point(e[1]), point(e[2]),
                                                           point(e[3]), point(e[0]), &time, &place)
            : fcl::detail::Intersect<double>::intersect_EE(point(s[0]), point(s[1]), point(s[2]),
                                                           point(s[3]), point(e[0]), point(e[1]),
                                                           point(e[2]), point(e[3]), &time, &place);
    return hit ? std::optional(time) : std::nullopt;
}

#else

bool has_fcl_elementary() {
    return false;
}
std::optional<double> fcl_elementary_impact(const ElementaryPair& /*pair*/) {
    return std::nullopt;
}

#endif

} // namespace abut::bench
