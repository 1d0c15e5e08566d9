#pragma once

#include "core/stop.h"
#include "rigid/penetration/contact_regions.h"
#include "rigid/solid/world_solid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

struct DepthSearch {
    /// The comparison that matters: the search goes on until the depth is known to be above it or
    /// not.
    double threshold = 0;
    /// Relative width that [depth, at_most] should have.
    double relative_error = 0.01;
    /// Evaluated points, at most: for the accuracy; to reach a depth at all; for the comparison.
    int accuracy_budget = 1000, reach_budget = 1000, threshold_budget = 20000;
    SearchSteps* steps = nullptr; ///< if given: limits the points of all searches together
};

/// The part of a surface that a search looks at; by default all of it.
struct SurfacePart {
    const RegionCells* cells = nullptr; ///< if given: points that belong to `region`
    std::uint32_t region = 0;
    const std::vector<bool>* contained = nullptr; ///< by triangle; if given, `in_contained` counts
    bool in_contained = false; ///< only triangles that are contained, or only those that are not
    Vec3 origin;               ///< of the points asked for; cells are in the world

    [[nodiscard]] bool takes(std::uint32_t triangle) const {
        return contained == nullptr || (*contained)[triangle] == in_contained;
    }
    [[nodiscard]] bool may_hold(const Vec3& point, double radius) const {
        return cells == nullptr || cells->may_hold(region, point + origin, radius);
    }
};

/// The point of a surface that lies deepest in a solid.
struct DeepestPoint {
    double depth = 0;          ///< that is reached; as given if nothing is deeper
    double at_most = 0;        ///< nothing is deeper than this: proven
    Vec3 on_surface, on_solid; ///< `depth` apart; not set if nothing is deeper than was given
    std::uint32_t surface_triangle = 0, solid_triangle = 0;
};

/// Depth is the distance to the solid's surface, of points inside it.
///
/// In          `starts`: triangles of the surface near which deep points are likely; nothing that
///             is not deeper than `deeper_than` is looked for.
/// Accuracy    depth: reached to rounding; [depth, at_most] encloses the true value (if that is
///             above `deeper_than`) but for rounding, as narrow as asked for unless the budget ends.
/// Source      branch and bound over the boxes of the surface's tree, then over halved triangles.
///             No point of a piece of radius r is deeper than d + r, d being the distance from its
///             middle to any triangle of the solid, nor deeper than its corners' largest distance
///             to one triangle (the distance to a convex set is convex).
DeepestPoint find_deepest_point(const PlacedModel& surface, const WorldSolid& solid,
                                std::span<const std::uint32_t> starts, const SurfacePart& part,
                                const DepthSearch& options, double deeper_than);

} // namespace abut
