#pragma once

namespace abut {

/// Decodes the geometry that a file holds as decode_request.h says, with Draco and meshoptimizer,
/// until one piece cannot be decoded.
///
/// Errors      std::bad_alloc; std::runtime_error if the file cannot be read or written.
/// Cost        one piece in memory at a time.
void decode_geometry(int descriptor);

} // namespace abut
