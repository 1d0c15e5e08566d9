#include "world/schedule/turning_surface.h"

#include "convex/support/support_gap.h"
#include "world/narrow_phase/solid_gap.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <optional>

namespace abut {

namespace {

using NearTriangles = boost::container::static_vector<Triangle, 256>;

/// The triangles that may be at most a distance from the solid; none if there are too many.
std::optional<NearTriangles> triangles_within(double distance, const PlacedModel& model,
                                              const SupportShape& solid) {
    NearTriangles found;
    bool too_many = false;
    model.for_each_overlap(grown(box_around(solid), distance), [&](std::uint32_t slot) {
        too_many = too_many || found.size() == found.capacity();
        if (!too_many)
            found.push_back(model.world_slot(slot));
    });
    return too_many ? std::nullopt : std::optional(found);
}

/// Bounds the distance of a triangle's points from a point.
double swing_of(const Vec3& point, const Triangle& triangle) {
    double farthest = 0;
    for (const Vec3& corner : triangle)
        farthest = std::max(farthest, length(corner - point));
    return farthest * (1 + 0x1p-40);
}

} // namespace

double time_with_room(const TurningSurface& surface, const TurningSolid& solid, double free,
                      double fastest, double margin, double horizon) {
    // Few triangles now promise that there are not too many in a longer time.
    constexpr double kMore = 16;
    constexpr std::size_t kFew = 16;
    double proven = 0;
    for (double time = std::min(kMore * free, horizon);; time = std::min(kMore * time, horizon)) {
        const double near = fastest * time + margin;
        const auto triangles = triangles_within(near, surface.model, solid.solid);
        if (!triangles)
            return proven;
        double room = time;
        for (const Triangle& each : *triangles) {
            const SupportShape triangle = support_of(each);
            Vec3 direction;
            const SupportGap gap =
                support_gap(triangle, solid.solid, near, SupportDepths::no, direction);
            if (gap.distance > near)
                continue;
            const TurningSolid turning{triangle, surface.centre, surface.velocity,
                                       surface.angular_velocity, swing_of(surface.centre, each)};
            room = longest_with_room(turning, solid, gap.normal, margin, room);
        }
        proven = std::max(proven, room);
        if (room < time || time == horizon || triangles->size() > kFew)
            return proven;
    }
}

} // namespace abut
