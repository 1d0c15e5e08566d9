#pragma once

#include "io/reader/stream_writer.h"

#include <string>

namespace abut {

/// Reads a model file with Assimp and writes one part for each node with triangles.
///
/// Nothing is written before the whole file has been read successfully.
///
/// Errors      Fault; std::exception from the libraries.
void read_model(const std::string& file, StreamWriter& writer);

} // namespace abut
