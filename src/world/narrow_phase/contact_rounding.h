#pragma once

#include "world/narrow_phase/narrow_phase.h"

// When bodies whose gap is rounded touch.
namespace abut {

/// The rounding of a gap, relative to the sizes of both bodies. A coordinate of a placed body is a
/// sum of three products, rounded by at most 2^-51 of its size; a gap is a difference of two such
/// coordinates along a direction that is rounded as much. Searches end at about 2^-48 (kRoundings of
/// support_pair.cpp) of the sizes and of the distance of the centres, which for bodies that touch is
/// at most the sizes again.
inline constexpr double kContactRounding = 0x1p-46;

/// A body's share of the rounding of a gap. Two bodies touch if their gap is computed as at most the
/// sum of their shares: the gap of bodies that touch is computed as 0, give or take rounding, and
/// differently by each way to compute it, so that without this allowance the way would decide.
double contact_share(const Model& model);
double contact_share(const ConvexShape& convex);
inline double contact_share(const RoundedBox& box) {
    return kContactRounding * (box.half[0] + box.half[1] + box.half[2] + box.radius);
}
double contact_share(const CurvedShape& curved);
double contact_share(const PlaneShape& plane);
/// At least the share of any body. A world's boxes are larger by it, so that bodies that touch are a
/// pair.
double contact_share(const BodyShape& shape, const Box3& own_bounds);

/// The rounding of the gap of two bodies: the sum of their shares. 0 for surfaces and convex bodies
/// among themselves: that they touch is exact, and how their gap is computed agrees with that.
double contact_rounding(const PlacedBody& a, const PlacedBody& b);

/// Whether one solid comes before another in an order that does not depend on how they were added to
/// a world. So the gap of two solids of one kind is computed the same whichever of them is a.
bool comes_before(const RoundedBox& a, const Transform& world_from_a, const RoundedBox& b,
                  const Transform& world_from_b);
bool comes_before(const CurvedShape& a, const Transform& world_from_a, const CurvedShape& b,
                  const Transform& world_from_b);

} // namespace abut
