#pragma once

#include <abut/mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Reads one frame of a deforming sequence, PLY (text or binary) or OBJ: vertices as the file has
/// them, in its order, none joined and none left out, so that vertex i of every frame is the same
/// point of the surface.
///
/// Polygons are cut into fans from their first corner, which no motion changes; faces of less than
/// three corners are left out of a PLY file. Everything but vertices and faces is passed over.
/// `read_mesh`, in contrast, joins vertices, and reads more formats, in another process.
///
/// Units       the file's. Positions of text become the nearest double, or, where a PLY file
///             calls them float, a float.
/// Errors      Error, naming the file: file_not_found; unreadable; unsupported (another extension,
///             triangle strips, an index that is a real number); malformed (not of its format, cut
///             short, or going on after its last element); bad_mesh (an index out of range, a
///             coordinate that is not finite or beyond 1e18, no triangles).
/// Cost        linear; memory for the mesh, and some 512 KiB of the file at a time.
Mesh read_frame(const std::string& path);

/// The positions of a frame that has so many vertices and these triangles, as another of its
/// sequence has; none if it has others. They are compared as they are read, and not held again.
///
/// Errors      as read_frame; of a frame that has others, not all are found.
std::optional<std::vector<Vec3>>
read_frame_positions(const std::string& path, std::size_t vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Writes a frame as binary little-endian PLY, atomically, so that `read_frame` gives the same mesh:
/// positions as floats if all of them are floats exactly, else as doubles.
///
/// Errors      Error, naming the file: unsupported (another extension than .ply); bad_mesh (a mesh
///             that read_frame would refuse); cannot_write.
void write_frame(const Mesh& mesh, const std::string& path);

} // namespace abut
