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

/// Reads one frame of a deforming sequence from PLY (text or binary) or OBJ. The vertices are those
/// of the file, in its order. None is joined and none is left out, so vertex i of every frame is
/// the same point of the surface.
///
/// A polygon is cut into a fan from its first corner, so that its motion does not change the cut.
/// Faces of a PLY file with fewer than three corners are left out. Everything but vertices and
/// faces is ignored. `read_mesh`, in contrast, joins vertices and reads more formats in another
/// process.
///
/// Units       the file's. A position in text becomes the nearest double, or the nearest float
///             where a PLY file declares it as float.
/// Errors      Error, naming the file: file_not_found; unreadable; unsupported (another extension,
///             triangle strips, an index that is a real number); malformed (not of its format, cut
///             short, or with data after its last element); bad_mesh (an index out of range, a
///             coordinate that is not finite or beyond 1e18, no triangles).
/// Cost        linear; memory for the mesh and about 512 KiB of the file at a time.
Mesh read_frame(const std::string& path);

/// Returns the positions of a frame if it has this number of vertices and these triangles, as
/// another frame of its sequence has; else nothing. The triangles are compared while they are read,
/// and not stored again.
///
/// Errors      as `read_frame`; if the triangles differ, not every fault of the file is found.
std::optional<std::vector<Vec3>>
read_frame_positions(const std::string& path, std::size_t vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Writes a frame as binary little-endian PLY, atomically. `read_frame` then returns the same mesh.
/// The positions are stored as floats if all of them are exact as floats, else as doubles.
///
/// Errors      Error, naming the file: unsupported (another extension than .ply); bad_mesh (a mesh
///             that `read_frame` would refuse); cannot_write.
void write_frame(const Mesh& mesh, const std::string& path);

} // namespace abut
