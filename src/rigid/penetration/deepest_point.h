#pragma once

#include "core/stop.h"
#include "rigid/penetration/contact_regions.h"
#include "rigid/solid/world_solid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

struct DepthSearch {
    /// The search continues until it knows whether the depth is above this.
    double threshold = 0;
    /// Relative width of [depth, at_most] to be reached.
    double relative_error = 0.01;
    /// Limits on evaluated points: for the accuracy; to reach any depth at all; for the threshold.
    int accuracy_budget = 1000, reach_budget = 1000, threshold_budget = 20000;
    SearchSteps* steps = nullptr; ///< if given: limits the steps of all searches together
};

/// The part of a surface to be searched; by default all of it.
struct SurfacePart {
    const RegionCells* cells = nullptr; ///< if given: only points that belong to `region`
    std::uint32_t region = 0;
    const std::vector<bool>* contained = nullptr; ///< by triangle; if given, `in_contained` selects
    bool in_contained = false; ///< only triangles that are contained, or only the others
    Vec3 origin;               ///< of the points' frame; cells are in world coordinates
    /// If not empty: by triangle of the searched surface, its number in `contained`.
    std::span<const std::uint32_t> numbers;

    [[nodiscard]] bool takes(std::uint32_t triangle) const {
        return contained == nullptr ||
               (*contained)[numbers.empty() ? triangle : numbers[triangle]] == in_contained;
    }
    [[nodiscard]] bool may_hold(const Vec3& point, double radius) const {
        return cells == nullptr || cells->may_hold(region, point + origin, radius);
    }
};

/// The point of a surface that lies deepest in a solid.
struct DeepestPoint {
    double depth = 0;          ///< reached; the given `deeper_than` if nothing is deeper
    double at_most = 0;        ///< proven: nothing is deeper
    Vec3 on_surface, on_solid; ///< `depth` apart; not set if nothing is deeper than given
    std::uint32_t surface_triangle = 0, solid_triangle = 0;
};

/// Finds the point of a surface that lies deepest in a solid. The depth of a point inside is its
/// distance to the solid's surface.
///
/// In          `starts`: triangles of the surface near which deep points are likely. `deeper_than`:
///             points that are not deeper are not searched for.
/// Accuracy    depth is reached, to rounding. [depth, at_most] encloses the true value, to
///             rounding, if that is above `deeper_than`; it is as narrow as asked for unless the
///             budget is used up.
/// Source      branch and bound over the boxes of the surface's tree, then over bisected triangles.
///             A piece of radius r whose centre has the distance d from any triangle of the solid
///             holds no point deeper than d + r. Nor is any point deeper than the largest distance
///             of the piece's corners from one triangle: the distance to a convex set is convex.
DeepestPoint find_deepest_point(const PlacedModel& surface, const WorldSolid& solid,
                                std::span<const std::uint32_t> starts, const SurfacePart& part,
                                const DepthSearch& options, double deeper_than);

} // namespace abut
