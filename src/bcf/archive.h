#pragma once

#include <abut/bcf.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Returns the files of a zip archive, without folders, sorted by name.
///
/// Errors      Error{malformed}, naming the file and the entry.
std::vector<BcfEntry> unpack_archive(const std::string& bytes, const std::string& file,
                                     const BcfLimits& limits);

/// Returns a zip archive of these entries, sorted by name, with equal times.
///
/// Errors      Error{bad_argument} if two entries have one name, or a name leads out of the archive.
std::string pack_archive(std::vector<BcfEntry> entries);

/// Returns the name of the entry that a relative path means, seen from a folder of the archive; none
/// if it leads out of the archive.
std::optional<std::string> entry_of(std::string_view folder, std::string_view path);

} // namespace abut
