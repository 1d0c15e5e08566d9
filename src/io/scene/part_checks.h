#pragma once

#include <abut/scene.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace abut {

/// Returns false if a coordinate of a part could leave the range of doubles. In: positions are
/// within the range of floats.
bool stays_finite(const Transform& transform);

/// Returns whether at least one triangle, in world coordinates, has an area. In most meshes the
/// first one has.
///
/// In          indices in range.
bool has_area(const Mesh& mesh, const Transform& world_from_mesh);

/// Makes ids unique. The first part of an id keeps it; later ones get "#2", "#3", …; an empty name
/// becomes the id.
void make_ids_unique(std::vector<Part>& parts);

/// The fault of a mesh, by the mesh's number. It is reported with the first part that uses the
/// mesh.
using MeshFaults = std::unordered_map<std::uint64_t, std::string>;

/// Describes the fault of a position, to follow "vertex 7": a coordinate is not finite, is not
/// finite as a float, or is too large for queries. Null if there is none.
const char* coordinate_fault(const Vec3& position);

/// Adds a fault if a position of the mesh has one.
void find_bad_coordinate(const Mesh& mesh, std::uint64_t number, MeshFaults& faults);

/// Checks a scene.
///
/// Errors      Error{bad_mesh}, naming the file: a part whose mesh is at fault or whose transform
///             is not finite, no triangles or only degenerate ones.
void check_scene(const Scene& scene, const MeshFaults& faults);

} // namespace abut
