#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <vector>

namespace abut {

/// How the shells of a surface without a border bound a solid. A shell is a set of triangles that
/// are connected by edges; where more than two triangles meet at an edge, those that enclose matter
/// between them are connected.
///
/// Each shell is taken as oriented outwards, or inwards if it bounds a cavity. A point is inside if
/// these shells wind around it at least once. So overlapping shells are their union.
///
/// The stored orientation tells cavities if it can be trusted: every shell is oriented
/// consistently, all of one side are outermost, and those of the other side lie within them. Then
/// these others bound cavities, and a shell that is oriented as its enclosing shell is part of the
/// union. If it cannot be trusted, a shell bounds a cavity if it lies strictly inside an odd number
/// of others; shells that cross or touch each other are a union.
struct ShellOrientation {
    /// A shell has only one side, so that winding numbers mean nothing: the parity of crossings
    /// tells the inside.
    bool has_parity_only = false;
    /// +1: all stored normals point out of the solid; -1: all point into it; 0: neither.
    int outward = 0;
    /// By triangle: +1 if its stored normal points out of the solid, -1 if it points into it, 0 for
    /// dropped triangles. Empty if `outward` holds for all triangles. If only parity tells the
    /// inside: 0 for dropped triangles, 1 for the others.
    std::vector<std::int8_t> weights;
    /// Two shells may have a common part: then faces of one may lie inside the solid.
    bool may_overlap = false;
    bool are_flat = false;   ///< no shell has a volume
    std::uint32_t count = 0; ///< of shells
};

/// In          dropped: by triangle, those that are no part of the surface; may be empty. The others
///             have no border (CleanSurface::closed).
/// Accuracy    whether a shell is consistent: exact. On which side a shell has its inside: by its
///             volume, to rounding. A shell counts as lying inside others by its vertices, exactly;
///             of more than 4,096 triangles, by some of them.
/// Degenerate  a shell without a volume bounds nothing, whatever its orientation.
/// Cost        O(n log n). If shells are oriented differently, a ray for each vertex of shells
///             that may be cavities.
ShellOrientation orient_shells(const Mesh& mesh, const Topology& topology,
                               const std::vector<bool>& dropped);

} // namespace abut
