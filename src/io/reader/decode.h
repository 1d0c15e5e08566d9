#pragma once

namespace abut {

/// Decodes the geometry in a file that decode_request.h describes, with Draco and meshoptimizer.
/// Stops at the first job that cannot be decoded.
///
/// Errors      std::bad_alloc; std::runtime_error if the file cannot be read or written.
/// Cost        one job in memory at a time.
void decode_geometry(int descriptor);

} // namespace abut
