#include "world/solids/write_points.h"

#include "world/solids/four_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut {

namespace {

void drop_beyond_margin(ContactCandidates& candidates, const ContactLimits& limits) {
    const double least = -limits.margin - limits.rounding;
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                    [&](const ContactCandidate& c) { return c.depth() < least; }),
                     candidates.end());
}

} // namespace

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

void keep_four(ContactCandidates& candidates, double rounding,
               std::span<const std::uint64_t> last) {
    if (candidates.size() <= 4) {
        for (std::size_t i = 1; i < candidates.size(); ++i)
            for (std::size_t k = i; k > 0 && candidates[k].depth() > candidates[k - 1].depth(); --k)
                std::swap(candidates[k], candidates[k - 1]);
        return;
    }
    boost::container::small_vector<RegionPoint, 12> points;
    points.reserve(candidates.size());
    for (const ContactCandidate& c : candidates)
        points.push_back({c.x, c.y, c.depth(), c.feature});
    ContactCandidates kept;
    for (const std::size_t i : four_points(std::span(points.data(), points.size()), rounding, last))
        kept.push_back(candidates[i]);
    candidates = kept;
}

void write_points(ContactCandidates& candidates, const ContactFrame& frame,
                  const ContactLimits& limits, ContactManifold& manifold) {
    drop_beyond_margin(candidates, limits);
    keep_four(candidates, limits.rounding, limits.last);
    manifold.normal = frame.normal;
    manifold.region = 0;
    manifold.status = Status::exact;
    manifold.count = static_cast<std::uint32_t>(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const ContactCandidate& from = candidates[i];
        manifold.points[i] = {frame.world(from.x, from.y, from.height_a),
                              frame.world(from.x, from.y, from.height_b), from.depth(),
                              from.feature};
    }
}

} // namespace abut
