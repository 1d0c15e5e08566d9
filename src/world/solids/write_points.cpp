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
    manifold.normal = frame.normal;
    manifold.region = 0;
    manifold.status = Status::exact;
    manifold.count = 0;
    const double least = -limits.margin - limits.rounding;
    const auto write = [&](const ContactCandidate& from) {
        ContactPoint& point = manifold.points[manifold.count++];
        point.point_a = frame.world(from.x, from.y, from.height_a);
        point.point_b = frame.world(from.x, from.y, from.height_b);
        point.depth = from.depth(), point.feature = from.feature;
        point.triangle_a = point.triangle_b = 0;
    };
    if (candidates.size() == 1) {
        if (candidates[0].depth() >= least)
            write(candidates[0]);
        return;
    }
    boost::container::small_vector<RegionPoint, 12> points;
    boost::container::small_vector<std::size_t, 12> places; ///< of the points among the candidates
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const ContactCandidate& c = candidates[i];
        if (c.depth() < least)
            continue;
        points.push_back({c.x, c.y, c.depth(), c.feature});
        places.push_back(i);
    }
    for (const std::size_t i :
         four_points({points.data(), points.size()}, limits.rounding, limits.last))
        write(candidates[places[i]]);
}

} // namespace abut
