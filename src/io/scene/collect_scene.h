#pragma once

#include <abut/scene.h>

#include "io/scene/scene_source.h"

#include <cstdint>
#include <string>

namespace abut {

class ReadWatch;

/// Joins vertices at equal positions (-0 equals 0), in the order of their first occurrence.
///
/// In          indices in range.
void join_vertices(Mesh& mesh);

/// Reads one mesh of a source and joins its vertices.
///
/// Errors      as SceneSource::read; Fault bad_mesh for an index out of range.
Mesh collect_mesh(const SceneSource& source, std::uint32_t mesh);

/// Reads a whole source into memory, as read_scene returns it.
///
/// Errors      as collect_mesh; Error of read_scene, naming the file; Error of the watch.
Scene collect_scene(const SceneSource& source, const std::string& file, const ReadWatch& watch);

} // namespace abut
