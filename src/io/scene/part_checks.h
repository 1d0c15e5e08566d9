#pragma once

#include <abut/scene.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace abut {

/// False if a coordinate of a part could leave the range of doubles. Positions are in the range of
/// floats.
bool stays_finite(const Transform& transform);

/// Whether one triangle at least, in world coordinates, is not exactly degenerate. In any usual
/// mesh the first one is.
///
/// In          indices in range.
bool has_area(const Mesh& mesh, const Transform& world_from_mesh);

/// The first part of an id keeps it; those after it get "#2", "#3", …; an empty name becomes the
/// id.
void make_ids_unique(std::vector<Part>& parts);

/// What is wrong with a mesh, by its number; reported with the name of the first part that uses it.
using MeshFaults = std::unordered_map<std::uint64_t, std::string>;

/// What is wrong with a position, to follow "vertex 7": a coordinate is not finite, would not be as
/// a float, or is beyond what queries take. Null: nothing.
const char* coordinate_fault(const Vec3& position);

/// Adds a fault if a position has one.
void find_bad_coordinate(const Mesh& mesh, std::uint64_t number, MeshFaults& faults);

/// Errors      Error{bad_mesh}, naming the file: a part whose mesh is at fault or whose transform
///             is not finite, no triangle at all or only degenerate ones.
void check_scene(const Scene& scene, const MeshFaults& faults);

} // namespace abut
