#pragma once

#include <abut/scene.h>

#include <cstddef>
#include <span>
#include <string>

namespace abut {

/// Decodes a reader's result (scene_stream.h). Every count, offset and value is checked before it
/// is used.
///
/// In/out      path: its name is used for Scene::file and for errors. The unit and axes are those
///             of the path; else of the format; else of the options. The unit is applied to the
///             transforms. A repeated part id gets the suffix "#2", "#3", …; an empty name becomes
///             the id.
/// Errors      the error in the stream; Error{reader_failed} if the stream is incomplete or
///             inconsistent; Error{bad_mesh} for an index out of range, a number that is not
///             finite, no triangles or only degenerate ones.
Scene decode_scene(std::span<const std::byte> stream, const ModelPath& path,
                   const ReadOptions& options);

} // namespace abut
