#pragma once

#include <abut/types.h>

#include "math/vector.h"

namespace abut {

/// The points that two triangles share.
///
/// In/out      two triangles; count 0 if they share no point. If their planes cross: the segment
///             (or point), directed along n_a x n_b. If they are coplanar: the convex polygon,
///             counter-clockwise as seen from the tip of n_a.
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    which edges meet, hence the number of corners: exact. Each corner lies on its edge
///             to rounding, within 2^-36 of that edge's length of the true one. The corner where an
///             edge meets a triangle's plane is the same, bit for bit, for both triangles of that
///             edge.
/// Cost        some 10 orientation signs. A corner that double precision cannot place (planes that
///             almost coincide) takes some microseconds.
/// Source      intervals as [Guigue, Devillers 2003]. The coplanar case uses the vertices of each
///             triangle in the other and the proper crossings of edges, so that no decision rests
///             on a constructed point.
Intersection triangle_triangle_segment(const Triangle& a, const Triangle& b);

} // namespace abut
