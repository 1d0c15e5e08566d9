#include "world/solids/write_points.h"

#include "world/solids/four_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace abut {

double deepest_of(const ContactCandidates& candidates) {
    double depth = -HUGE_VAL;
    for (const ContactCandidate& each : candidates)
        depth = std::max(depth, each.depth());
    return depth;
}

void add_witness(const SolidGap& witness, std::uint64_t name, const ContactFrame& frame,
                 ContactCandidates& candidates) {
    // Far from the origin, the witness points are rounded more than their distance.
    const Vec3 on_a = frame.coordinates(witness.point_a - frame.origin);
    const ContactCandidate added{on_a.x, on_a.y, on_a.z, on_a.z + witness.distance, name};
    const auto same =
        std::find_if(candidates.begin(), candidates.end(),
                     [&](const ContactCandidate& each) { return each.feature == name; });
    if (same != candidates.end())
        *same = added;
    else
        candidates.push_back(added);
}

void write_points(const ContactCandidates& candidates, const ContactFrame& frame,
                  const ContactLimits& limits, ContactManifold& manifold) {
    const double least = -limits.margin - limits.rounding;
    boost::container::small_vector<RegionPoint, 12> points;
    boost::container::small_vector<std::size_t, 12> places; ///< of the points among the candidates
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const ContactCandidate& c = candidates[i];
        if (c.depth() < least)
            continue;
        RegionPoint& point = points.emplace_back();
        point.x = c.x, point.y = c.y, point.depth = c.depth(), point.feature = c.feature;
        places.push_back(i);
    }
    manifold.normal = frame.normal;
    manifold.region = 0;
    manifold.status = Status::exact;
    manifold.count = 0;
    for (const std::size_t i :
         four_points({points.data(), points.size()}, limits.rounding, limits.last)) {
        const ContactCandidate& from = candidates[places[i]];
        ContactPoint& point = manifold.points[manifold.count++];
        point.point_a = frame.world(from.x, from.y, from.height_a);
        point.point_b = frame.world(from.x, from.y, from.height_b);
        point.depth = points[i].depth, point.feature = from.feature;
        point.triangle_a = point.triangle_b = 0;
    }
}

} // namespace abut
