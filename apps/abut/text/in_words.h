#pragma once

#include <abut/types.h>

#include <string>

/// Numbers as text for people: at most six significant digits, no "-0", and lengths with their
/// unit.
namespace abut::command {

/// Formats a number, such as "0.05" or "1.23457e+06"; "0" for a zero of either sign.
std::string number(double value, int digits = 6);

/// Formats a number that is never more than the value, or never less: for bounds that are proven.
std::string number_below(double value);
std::string number_above(double value);

/// Formats a length, such as "0.05 m".
std::string metres(double value);
/// The same in millimetres below a centimetre, with few digits: "0.01 mm".
std::string short_length(double value);
std::string metres_below(double value);
std::string metres_above(double value);

/// Returns the largest power of ten that is at most a length: a step that rounds it away, and no more.
/// 0 if the length is 0.
double step_below(double length);
/// Formats a coordinate to a multiple of a step that is a power of ten, without trailing zeros: "-0.25".
/// Six significant digits if the step is 0.
std::string to_step(double value, double step);
/// Formats the ends of a box: "(-0.5, 0, 2) to (3, 4, 5) m". What is below a millionth of its diagonal
/// is not shown, nor what rounding cannot tell.
///
/// In          rounding: metres by which coordinates in the box may be off.
std::string box_text(const Vec3& lower, const Vec3& upper, double rounding);

/// Formats a point, such as "(1, 0.5, 0) m".
std::string point(const Vec3& place);

/// Formats a direction, which has no unit, such as "(0, 0, 1)".
std::string direction(const Vec3& way);

} // namespace abut::command
