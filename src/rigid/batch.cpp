#include <abut/batch.h>

#include "rigid/in_parallel.h"

#include <cstdint>

namespace abut {

std::vector<Contacts> collide(const Model& a, const Model& b, std::span<const Placement> placements,
                              const CollideOptions& options) {
    const CollideOptions each = of_each(options);
    return in_parallel<Contacts>(
        options.progress, "placements", placements.size(), [&](std::size_t i) {
            return collide(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
        });
}

std::vector<Gap> distance(const Model& a, const Model& b, std::span<const Placement> placements,
                          const DistanceOptions& options) {
    const DistanceOptions each = of_each(options);
    return in_parallel<Gap>(options.progress, "placements", placements.size(), [&](std::size_t i) {
        return distance(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
    });
}

std::vector<bool> within(const Model& a, const Model& b, std::span<const Placement> placements,
                         double tolerance, const WithinOptions& options) {
    // Bits of a vector<bool> share bytes, so each thread first writes a byte of its own.
    const auto answers = in_parallel<std::uint8_t>(
        options.progress, "placements", placements.size(), [&](std::size_t i) {
            const auto& [world_from_a, world_from_b] = placements[i];
            return static_cast<std::uint8_t>(within(a, world_from_a, b, world_from_b, tolerance));
        });
    return {answers.begin(), answers.end()};
}

std::vector<Impact> time_of_impact(const Model& a, const Model& b,
                                   std::span<const MotionPair> motions,
                                   const ImpactOptions& options) {
    const ImpactOptions each = of_each(options);
    return in_parallel<Impact>(
        options.progress, "times of impact", motions.size(),
        [&](std::size_t i) { return time_of_impact(a, motions[i].a, b, motions[i].b, each); });
}

} // namespace abut
