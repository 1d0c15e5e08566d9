#pragma once

#include "rigid/model/clean_surface.h"
#include "rigid/model/solid.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Triangles that bound a solid but for T-junctions: edges that meet without having both ends in common.
struct OpenSolid {
    std::vector<std::uint32_t> triangles;
    std::vector<std::int8_t> weights; ///< of each of them, as Solid::weights
    bool may_overlap = false;         ///< a triangle may have matter on both sides
};
struct OpenSolids {
    std::vector<OpenSolid> solids;
    std::vector<std::uint32_t> rest; ///< the open triangles that bound nothing
    bool has_sheets = false;         ///< hanging triangles bound nothing
};

/// Finds the solids that some triangles of a mesh bound but for T-junctions: those that wind an
/// integral number of times around points beside their largest faces (winding_vote.h).
///
/// In          clean: of the mesh. A solid may have open and hanging triangles: where faces meet at
///             T-junctions, no edge connects them. It may also have copies.
/// Out         all open ones as one solid, if they bound one and wind one way; else sets that are
///             connected by vertices. So a sheet elsewhere in the mesh hides no solid, and a solid that is
///             turned inside out is one by itself; such ones that lie in each other are cavities by turns.
/// Cost        some multiples of kProbes winding numbers of each set; fewer for most sheets.
OpenSolids find_open_solids(const Mesh& mesh, const Topology& topology, const CleanSurface& clean);

/// Returns whether the boxes of open solids, and of the other triangles that have a weight, overlap: then
/// the solids may have a common part.
///
/// In          solid: its weights are set.
bool may_overlap(const Mesh& mesh, const Solid& solid, const std::vector<OpenSolid>& solids);

} // namespace abut
