#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/reach_search.h"

#include <span>

namespace abut {

/// How two surfaces lie to each other, up to a tolerance t.
///
/// All answers are the same for models that are moved together without rounding, and for either
/// order of a and b. Where the difference between a length and t is below the rounding, the length
/// counts as t.
struct ToleranceSearch {
    double tolerance = 0;           ///< t, positive
    std::uint32_t budget = 100'000; ///< pieces of faces that may be examined, for each question
    /// Along these, of any length, the surfaces' extents may show soon what needs no search. They do
    /// not change what is proven.
    std::span<const Vec3> directions{};
};

/// Bounds the rounding of a length between two surfaces, with that of their world positions: a product
/// with a matrix is off by a few roundings of the largest coordinate.
double rounding_of_lengths(const WorldSolid& a, const WorldSolid& b);

/// Decides whether no surface point of a solid lies deeper than t in the other one. One of the two
/// may be no solid: then only its points count.
///
/// Out         found: if it fails, a surface point that lies deeper, in the world.
Proof nowhere_deeper(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options,
                     Vec3* found = nullptr);

/// How deep a surface point of one part lies in another one, at most.
struct SolidDepth {
    double depth = 0;   ///< of the point; 0 if none was found
    double at_most = 0; ///< no point is deeper, to rounding; infinite if the budget did not suffice
    Vec3 point;         ///< a surface point, in the world
};

/// Finds the surface point of a solid that lies deepest in the other one. One of the two may be no solid:
/// then only its points count.
///
/// In          known: a depth that some point has. Points that are hardly deeper are not searched for.
///             options: below its tolerance, no difference of depths matters.
/// Accuracy    at_most is the largest of the tolerance and, 2^-20 larger, the depth and the known depth; or
///             infinite.
/// Source      a search that raises its limit (reach_search.h).
SolidDepth solid_depth(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options,
                       double known);

/// Decides whether the common part of two solids holds no ball of a diameter above t.
///
/// In          no surface point of one lies deeper than t in the other.
/// Out         found: if it fails, the middle of such a ball, in the world.
/// Accuracy    `fails` is exact: there is a ball of a larger diameter. `holds`: there is none of a
///             diameter above (1 + 2^-6) t.
/// Source      If there is such a ball, one of the same size touches a surface from inside. The
///             centres of balls that touch are on the surface, moved inward by their radius
///             (ball_centres.h).
Proof nowhere_thicker(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options,
                      Vec3* found = nullptr);

/// Decides whether each surface is everywhere within t of the other one.
Proof everywhere_near(const WorldSolid& a, const WorldSolid& b, const ToleranceSearch& options);

/// Returns whether the extents of both along some direction prove that no point of one lies deeper
/// than t in the other, and that the common part is nowhere thicker than t: along it, a ends at most
/// t beyond the begin of b.
///
/// In          directions: of any length.
bool extents_overlap_little(const WorldSolid& a, const WorldSolid& b,
                            std::span<const Vec3> directions, double tolerance);

} // namespace abut
