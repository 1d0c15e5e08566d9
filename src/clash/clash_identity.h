#pragma once

#include <abut/clash.h>

#include <cstdint>
#include <string_view>

namespace abut {

/// Returns the id of a clash, which is the same in every run. It is a hash of both file names, both
/// part ids and the kind. Folders are left out of the file names, so that an id survives when a
/// model file is moved. The id does not depend on which part is a, on the order of a file's parts
/// or on the order of the files. Files of the same name in different folders are the exception:
/// their order counts.
///
/// Source      [Fowler, Noll, Vo], FNV-1a, 64 bits.
std::uint64_t clash_identity(std::string_view file_a, std::string_view part_a,
                             std::string_view file_b, std::string_view part_b, ClashKind kind);

/// Checks the clearances and touch tolerances of the options and of their rules.
///
/// Errors      Error{bad_argument} if one is negative or not finite.
void require_tolerances(const ClashOptions& options);

/// The largest clearance that the options or one of their rules give to a pair.
double largest_clearance(const ClashOptions& options);

} // namespace abut
