#pragma once

#include <abut/progress.h>

#include "core/hash.h"

#include <cstdint>
#include <string>

namespace abut {

/// What tells whether a file has changed.
struct ModelFile {
    std::string path; ///< absolute
    std::uint64_t bytes = 0;
    std::int64_t modified = 0; ///< nanoseconds since 1970
};

/// Without links and dots; the file need not be there.
std::string absolute_path(const std::string& file);

/// Errors      Error, naming the file: file_not_found, unreadable, malformed if it is empty.
ModelFile look_at(const std::string& file);

/// Errors      Error{unreadable}; Error{interrupted}.
/// Cost        one pass over the file.
Hash128 content_hash(const std::string& file, const Progress& progress);

} // namespace abut
