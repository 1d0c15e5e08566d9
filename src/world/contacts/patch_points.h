#pragma once

#include <abut/model_contacts.h>

#include "world/contacts/convex_faces.h"
#include "world/contacts/surface_patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A place where a convex solid lies over a surface.
struct PatchPoint {
    Vec3 on_surface, on_solid; ///< on one line along the direction, in the solid's frame
    double depth = 0;
    std::uint64_t feature = 0;
    double x = 0, y = 0; ///< across the direction
    /// Vertices of the solid come before those of the surface, edges of both and places on faces.
    std::uint8_t rank = 0;
    std::uint32_t triangle = 0; ///< of the surface
};

struct PatchLimits {
    double margin = 0;
    double rounding = 0; ///< bounds that of positions in the solid's frame
};

/// Finds the corners of the region in which a solid is at most the margin away from triangles that look
/// the same way, with depths along that direction.
///
/// In          up: unit vector from the surface to the solid. solid_is_a: for the names.
void find_patch_points(const ConvexFaces& solid, std::span<const PatchTriangle* const> part,
                       const Vec3& up, bool solid_is_a, const PatchLimits& limits,
                       std::vector<PatchPoint>& points);

/// Adds the place where a solid and a surface are nearest to each other, if an edge or a vertex of either
/// body is there. Its name is that of the vertex of the solid or of the surface; else of two edges.
void add_place_of_features(const Vec3& on_surface, const Vec3& on_solid, const Vec3& up,
                           std::span<const PatchTriangle* const> part, const ConvexFaces& solid,
                           bool solid_is_a, std::vector<PatchPoint>& points);

} // namespace abut
