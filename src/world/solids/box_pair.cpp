#include "world/solids/box_pair.h"

#include "geometry/least_box_overlap.h"
#include "world/solids/box_region.h"
#include "world/solids/four_points.h"

#include <cstddef>

namespace abut {

namespace {

void write_region(const BoxRegion& region, const Vec3& normal, const ContactLimits& limits,
                  ContactManifold& manifold) {
    manifold.normal = normal;
    for (const std::size_t i :
         four_points({region.corners.data(), region.count}, limits.rounding, limits.last)) {
        const RegionPoint& corner = region.corners[i];
        const Vec3 on_reference = region.on_reference(i), way = corner.depth * normal;
        ContactPoint& point = manifold.points[manifold.count++];
        point.point_a = region.reference_is_a ? on_reference : on_reference + way;
        point.point_b = region.reference_is_a ? on_reference - way : on_reference;
        point.depth = corner.depth, point.feature = corner.feature;
    }
}

} // namespace

BoxContact contact_of_boxes(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                            KnownSeparation& separation, std::vector<ContactManifold>& manifolds) {
    const BoxAxes axes(a, b);
    const LeastOverlap least = least_overlap(a, b, axes, limits.margin + limits.rounding);
    if (least.overlap < -limits.margin) {
        separation.axis = least.axis;
        return least.overlap < -limits.margin - limits.rounding ? BoxContact::apart
                                                                : BoxContact::unknown;
    }
    separation.axis = kNoAxis;
    // Corners beyond the margin, to rounding, are no contact points.
    const BoxRegion region(a, b, axes, least, -limits.margin - limits.rounding);
    if (!(region.deepest >= least.overlap - limits.rounding))
        return BoxContact::unknown;
    write_region(region, least.normal, limits, manifolds.emplace_back());
    return BoxContact::written;
}

} // namespace abut
