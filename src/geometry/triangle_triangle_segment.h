#pragma once

#include <abut/types.h>

#include "math/vector.h"

namespace abut {

/// The points that two triangles share.
///
/// In/out      two triangles; count 0 if they share no point. Of two triangles whose planes cross,
///             the segment (or point), directed along n_a x n_b; of coplanar ones the convex
///             polygon, counter-clockwise as seen from the tip of n_a.
/// Degenerate  zero-area triangles are the segments or points that they are.
/// Accuracy    which edges meet, hence the number of corners: exact. Each corner lies on its edge
///             to rounding, and is the true one to 2^-36 of that edge's length. The corner where an
///             edge meets a triangle's plane is the same, bit for bit, for both triangles of that
///             edge.
/// Cost        some 10 orientation signs; corners that double precision cannot place (planes that
///             almost coincide) take some microseconds each.
/// Source      intervals as [Guigue, Devillers 2003]; coplanar ones by the vertices of each in the
///             other and the proper crossings of edges, so that no constructed point decides.
Intersection triangle_triangle_segment(const Triangle& a, const Triangle& b);

} // namespace abut
