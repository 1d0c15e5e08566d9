#pragma once

#include "mesh/topology.h"
#include "rigid/model/solid.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// How some triangles of a mesh wind around the points beside them.
struct SetWinding {
    /// By triangle of the set: +1 if its normal points out of the solid, -1 if into it, 0 if it lies
    /// inside the solid, with another one that faces the same way on it.
    std::vector<std::int8_t> weights;
    bool is_mixed = false; ///< they wind forwards around some points and backwards around others
    /// A triangle has matter on both sides, or may face another way than its patch: the boundary must be
    /// cut, which tells contradictions.
    bool may_overlap = false;
};

/// Tells whether some triangles bound a solid but for T-junctions, and how they are oriented: they do if
/// they wind an integral number of times around points beside their largest ones, and beside the
/// largest of each flat patch. A patch is a set of triangles that are connected by edges that no third one of
/// them uses, in opposite directions; so it faces one way.
///
/// In          set: numbers of triangles, ascending.
/// Out         none if they bound no solid.
/// Accuracy    of more than 64 flat patches, the smallest are not probed: they face as the others, which
///             must all face one way.
/// Cost        two winding numbers of the set for each probe: of kProbes, and of each flat patch, at
///             most 64. One for most sheets.
std::optional<SetWinding> winding_of(const Mesh& mesh, const Topology& topology,
                                     std::span<const std::uint32_t> set);

/// Returns for each triangle of a set the least index in the set of a triangle of its patch.
///
/// In          flat: triangles of a patch are also coplanar with their neighbours, to a degree.
std::vector<std::uint32_t> patches_of(const Mesh& mesh, const Topology& topology,
                                      std::span<const std::uint32_t> set, bool flat);

/// The largest of some triangles; of equal ones, those of the least numbers.
std::vector<std::uint32_t>
largest_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles, std::size_t count);

} // namespace abut
