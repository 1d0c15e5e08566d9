#pragma once

#include "world/curved/curved_patch.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

/// A place where a curved solid is over a surface, or inside it; relative to the solid's centre.
struct CurvedPlace {
    Vec3 on_surface, on_solid; ///< on one line along the normal
    double depth = 0;
    std::uint64_t feature = 0; ///< as if the solid were a
    std::uint32_t triangle = 0;
};

/// A direction in which a solid is nearest to a part of a surface, or leaves it soonest, among all directions
/// that this part has: the normal of a face, or one between those of the faces at an edge or a vertex.
struct CurvedSeed {
    Vec3 up;                ///< unit vector from the surface to the solid
    double depth = 0;       ///< how far the solid must move to leave this part; negative: a gap
    std::uint32_t body = 0; ///< that of NearTriangle
    std::uint32_t begin = 0, end = 0; ///< its places
};

struct CurvedSeeds {
    std::vector<CurvedSeed> seeds;
    std::vector<CurvedPlace> places;
};

/// Where a line along `up` meets a triangle; none if it passes by it.
///
/// In          up: not along the triangle. rounding: such a place may lie so far beyond an edge.
std::optional<Vec3> foot_on(const NearTriangle& t, const Vec3& from, const Vec3& up,
                            double rounding);

/// Finds the directions of all faces, edges and vertices near a solid.
///
/// In          solid: with its centre at the origin.
/// Source      the depth along n at a point q of the surface is n . q + h(-n), with h the support function. On the
///             arc of directions across an edge it has one minimum, found by the sign of its slope.
void find_seeds(const SupportShape& solid, const CurvedPatch& patch, const PatchBounds& bounds,
                CurvedSeeds& found);

} // namespace abut
