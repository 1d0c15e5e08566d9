#pragma once

#include <abut/scene.h>

#include "io/process/stream_cursor.h"

namespace abut {

/// Decodes the part "known" of a reader's result (scene_stream.h) into a scene whose parts are
/// there: its project, its map, and the properties and relations of its parts.
///
/// Errors      as StreamCursor; also for an index out of range, and repeated names or values.
void decode_knowledge(StreamCursor& cursor, Scene& scene);

} // namespace abut
