#pragma once

#include "clash/building/building_source.h"
#include "clash/building/shown_parts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// A mesh as parts of one detail show it.
struct ShownMesh {
    std::uint32_t mesh = 0; ///< index in BuildingSource::meshes()
    PartDetail detail = PartDetail::rest;
    std::uint32_t uses = 0; ///< parts that show it so
    double scale = 1;       ///< metres per unit of the mesh, the largest of its parts
    double share = 1;       ///< of its triangles that the page may have
};

/// Bytes that a triangle takes in a packed building, with its share of the vertices. Measured.
inline constexpr double kBytesPerTriangle = 6;

/// Divides the bytes of a page among the meshes: sets their shares. Clashing parts come first; a
/// detail passes on what it does not need. Within a detail, meshes of many triangles lose the most.
///
/// Out         returns, by detail, the share of all triangles that the page may have.
std::array<double, kPartDetails> share_triangles(const BuildingSource& source, double most_bytes,
                                                 std::vector<ShownMesh>& meshes);

} // namespace abut
