#pragma once

#include "clash/classify_pair.h"

#include <optional>
#include <string_view>

namespace abut {

/// Calls classify_pair with the part whose id sorts first as its first argument, and exchanges the
/// sides of the result if needed. A pair therefore gets the same answer, to the last bit, in
/// whichever order a file lists its parts. If the ids are equal, a stays first.
std::optional<Clash> classify_by_id(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                                    std::string_view id_b, double clearance, double touch);

/// Exchanges the witness points of a and b and negates the direction. The caller exchanges the
/// members that name the parts.
void exchange_sides(Clash& clash);

} // namespace abut
