#pragma once

#include <abut/mesh.h>

#include "view/simplify/level_surface.h"

#include <cstdint>
#include <span>

namespace abut {

/// Adds triangles of a mesh to a surface, with normals. A normal is the mean of the faces around the
/// vertex that are within 35 degrees of its own face, weighted by their angles there. A vertex is
/// split where the normals of its faces differ.
///
/// In          triangles: of the mesh, by number; all of them take part in the normals that
///             `around` holds, which must include them. part: index in to.parts.
/// Degenerate  triangles without area are kept; they take part in no normal but their own, +z.
void add_shaded(const Mesh& mesh, const Transform& frame_from_mesh, std::uint32_t part,
                LevelSurface& to);

/// As add_shaded, of some triangles only. The others still take part in the normals.
///
/// In          chosen: numbers of triangles, ascending.
void add_shaded(const Mesh& mesh, std::span<const std::uint32_t> chosen,
                const Transform& frame_from_mesh, std::uint32_t part, LevelSurface& to);

} // namespace abut
