#pragma once

#include <abut/scene.h>

#include <cstddef>
#include <span>
#include <string>

namespace abut {

/// A reader's result (scene_stream.h) as a scene; every count, offset and value is checked before
/// it is used.
///
/// In/out      path: its name is that of Scene::file and of errors; its unit and axes, else the
///             format's, else those of the options hold, and the unit is applied to the transforms.
///             A part id that occurs again gets "#2", "#3", …; an empty name
///             becomes the id.
/// Errors      the error that the stream holds; Error{reader_failed} if the stream is not whole and
///             sound; Error{bad_mesh} for an index out of range, a number that is not finite, no
///             triangle at all or only degenerate ones.
Scene decode_scene(std::span<const std::byte> stream, const ModelPath& path,
                   const ReadOptions& options);

} // namespace abut
