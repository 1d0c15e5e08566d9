#pragma once

#include <abut/clash.h>

#include <cstdint>
#include <string_view>

namespace abut {

/// The same clash has the same number in every run: a hash of both files' names, without folders,
/// so that an id survives that a model moves, of both parts' ids, and of the kind. Which of the parts
/// is a makes no difference, nor does the order of a file's parts or of the files: but for files of
/// one name in different folders, which keep theirs.
///
/// Source      [Fowler, Noll, Vo], FNV-1a, 64 bits.
std::uint64_t clash_identity(std::string_view file_a, std::string_view part_a,
                             std::string_view file_b, std::string_view part_b, ClashKind kind);

/// Errors      Error{bad_argument} if a tolerance is no length.
void require_tolerances(const ClashOptions& options);

/// The largest clearance that a pair may have.
double largest_clearance(const ClashOptions& options);

} // namespace abut
