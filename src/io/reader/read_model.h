#pragma once

#include "io/reader/stream_writer.h"

#include <string>

namespace abut {

/// Reads a model file with Assimp and writes its parts, one a node with triangles.
///
/// Nothing is written before the whole file is known to be readable.
///
/// Errors      Fault; std::exception from the libraries.
void read_model(const std::string& file, StreamWriter& writer);

} // namespace abut
