#pragma once

#include <abut/clash.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Shared code of the clash report writers: untrusted text, kinds, and the parts of a clash.
namespace abut {

/// Returns the text with every ill-formed sequence replaced by U+FFFD, one for each maximal subpart
/// of a character [Unicode 15, table 3-8].
std::string valid_utf8(std::string_view text);

/// Returns the kind of that name; none if the text names no kind.
std::optional<ClashKind> clash_kind_of(std::string_view text);

/// Returns part a (side 0) or b (side 1) of a clash.
/// Errors      Error{bad_argument} if the clash refers to a model or a part that does not exist.
const Part& part_of(const Clash& clash, int side, const std::vector<Scene>& models);

/// How far the numbers of a clash may be off: by the rounding of its parts, or by that of doubles.
struct ClashRounding {
    double distance = 0, points = 0, direction = 0;
};
ClashRounding rounding_of_numbers(const Clash& clash);

/// Returns a number without digits that rounding has made: rounded to the largest power of ten that is at
/// most `rounding`. The text has no trailing zeros, and no exponent unless rounding is 0 or the number is
/// beyond 1e15.
std::string rounded_text(double value, double rounding);
/// The number that rounded_text() writes.
double rounded(double value, double rounding);

} // namespace abut
