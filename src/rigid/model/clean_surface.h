#pragma once

#include "mesh/topology.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The triangles of a mesh that bound a solid, told from those that only lie about.
struct CleanSurface {
    /// By triangle: it bounds nothing. Empty if every triangle may bound the solid.
    std::vector<bool> dropped;
    /// The triangles that are left have no border, and there is at least one.
    bool closed = false;
    /// The dropped triangles of components that are not closed, whatever is dropped. They may still
    /// bound a solid but for T-junctions.
    std::vector<std::uint32_t> open;
    /// The triangles that hang by an edge of components that are closed without them. They, too, may
    /// bound a solid but for T-junctions, as one that shares an edge with a closed one does.
    std::vector<std::uint32_t> hanging;
    std::vector<std::uint32_t> copies; ///< the dropped triangles of which another copy is left
    /// A dropped triangle is no duplicate of one that is left: it is a surface of its own.
    bool has_sheets = false;
};

/// Drops, in this order,
/// 1. duplicates: triangles of the same three positions as another one. Of copies with one
///    orientation, those go that form a closed surface by themselves, and then those without which
///    the surface around them has no border; one copy always stays. So the face that two shells
///    share stays in both;
/// 2. in components with a border: what hangs by an edge. A triangle with an edge of its own is
///    dropped, again and again. The rest stays if it has no border then; otherwise the component
///    is open.
///
/// In          a mesh whose topology is not closed (see is_closed), so that something may be wrong.
/// Degenerate  triangles with two equal vertices have no edges, and stay: they bound nothing.
/// Accuracy    exact; it does not depend on the order of triangles, but for which of several equal
///             ones stays.
/// Cost        O(n log n).
CleanSurface clean_surface(const Mesh& mesh, const Topology& topology);

} // namespace abut
