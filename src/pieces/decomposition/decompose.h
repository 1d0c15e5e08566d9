#pragma once

#include <abut/model.h>

#include "pieces/decomposition/surface_graph.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The triangles of each convex piece of a solid: each triangle is in one piece.
using Pieces = std::vector<std::vector<std::uint32_t>>;

/// Parts the surface of a solid into patches that lie on the boundaries of their own convex hulls,
/// with all hulls inside of the solid.
///
/// So the union of the hulls lies between the surface and the solid: of two solids that share no
/// point it has the same distance as the surfaces.
///
/// In          a solid and the graph of its surface.
/// Accuracy    exact: signs decide what is convex, and that no triangle enters a hull. A triangle
///             alone is always a piece.
/// Degenerate  a triangle without an area is a piece of its own where it joins no other.
/// Cost        for each triangle, the neighbours of a corner, the faces that its new vertex sees, and
///             a search of the tree; sometimes all of the hull, whose size is limited. A component
///             that is convex as a whole: O(n log n).
/// Source      [Ehmann, Lin 2001]. Differs: exact signs; a hull that would leave the solid ends the
///             growth, where the paper lets hulls do so and has virtual faces in every query.
Pieces decompose(const Model& solid, const SurfaceGraph& surface);

} // namespace abut
