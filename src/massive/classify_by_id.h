#pragma once

#include "massive/classify_pair.h"

#include <optional>
#include <string_view>

namespace abut {

/// classify_pair, the part whose id comes first being its first: so a pair gets the same answer, to
/// the last bit, in whichever order a file lists its parts. Of equal ids the first is a.
std::optional<Clash> classify_by_id(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                                    std::string_view id_b, double clearance, double touch);

/// The same clash with a and b exchanged: points, direction. What names the parts is the caller's.
void exchange_sides(Clash& clash);

} // namespace abut
