#pragma once

#include <abut/progress.h>

#include "core/hash.h"

#include <cstdint>
#include <string>

namespace abut {

/// The properties of a file by which a change is noticed.
struct ModelFile {
    std::string path; ///< absolute
    std::uint64_t bytes = 0;
    std::int64_t modified = 0; ///< nanoseconds since 1970
};

/// The path without links and dots. The file need not exist.
std::string absolute_path(const std::string& file);

/// Reads these properties of a file.
///
/// Errors      Error, naming the file: file_not_found, unreadable, malformed if it is empty.
ModelFile look_at(const std::string& file);

/// The hash of a file's content.
///
/// Errors      Error{unreadable}; Error{interrupted}.
/// Cost        one pass over the file.
Hash128 content_hash(const std::string& file, const Progress& progress);

} // namespace abut
