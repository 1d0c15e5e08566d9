#pragma once

#include <abut/model.h>

#include "pieces/decomposition/surface_graph.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The triangles of each convex piece of a solid: each triangle is in one piece.
using Pieces = std::vector<std::vector<std::uint32_t>>;

/// Decomposes the surface of a solid into patches that lie on the boundaries of their own convex
/// hulls, with all hulls inside the solid.
///
/// So the union of the hulls lies between the surface and the solid. Two solids that share no point
/// have the same distance as these unions.
///
/// In          a solid and the graph of its surface.
/// Accuracy    exact: signs decide what is convex, and that no triangle enters a hull. A single
///             triangle is always a piece.
/// Degenerate  a triangle without area, or one that the solid drops (Solid::weights), is a piece of its own if it joins no other.
/// Cost        for each triangle: the neighbours of a corner, the faces that its new vertex sees,
///             and a search of the tree; sometimes a pass over the hull, whose size is limited. For
///             a component that is convex as a whole: O(n log n).
/// Source      [Ehmann, Lin 2001], SWIFT++. Differs: exact signs. A hull that would leave the solid
///             ends the growth; in the paper it may leave the solid, at the price of virtual faces
///             in every query.
Pieces decompose(const Model& solid, const SurfaceGraph& surface);

} // namespace abut
