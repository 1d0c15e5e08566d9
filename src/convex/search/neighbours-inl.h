// Tests whether the neighbours of a polytope's feature lie behind it along a direction.

// Included once for each target.
#if defined(ABUT_CONVEX_NEIGHBOURS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_CONVEX_NEIGHBOURS_INL_H
#undef ABUT_CONVEX_NEIGHBOURS_INL_H
#else
#define ABUT_CONVEX_NEIGHBOURS_INL_H
#endif

#include "convex/hull/climb-inl.h"
#include "convex/hull/placed_xyz-inl.h"
#include "convex/search/voronoi_marching.h"

#include <algorithm>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// The most by which a neighbour lies further along n than the feature, which is perpendicular to
/// n: negative if the body lies behind the feature.
HWY_INLINE double excess_along(const PlacedXyz& side, const HullFeature& f, const Xyz& n) {
    const Polytope& p = side.polytope();
    const Vec3 direction = to_vec3(side.pulled_back(n));
    const HullVertex& v = p.vertices[f.vertex];
    if (f.kind == Feature::edge) {
        const auto excess = [&](std::uint32_t edge)
                                HWY_ATTR { return dot(direction, p.to(edge) - v.at); };
        return std::max(excess(p.after(v, f.edge)), excess(p.before(v, f.edge)));
    }
    // All neighbours of a triangle lie on one side of it: the farthest one tells which.
    const bool is_face = f.kind == Feature::face;
    const rings::HighestNeighbour h = rings::highest_neighbour(p, v, direction, is_face);
    return is_face ? h.least : h.most;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
