#pragma once

#include <abut/types.h>

#include <string>

/// Numbers as people read them: at most six significant digits, no "-0", and a length with its unit.
namespace abut::command {

/// "0.05", "1.23457e+06"; "0" for a zero of either sign.
std::string number(double value, int digits = 6);

/// The same, but never more than the value, or never less: for bounds that are proven.
std::string number_below(double value);
std::string number_above(double value);

/// "0.05 m"
std::string metres(double value);
std::string metres_below(double value);
std::string metres_above(double value);

/// "(1, 0.5, 0) m"
std::string point(const Vec3& place);

/// "(0, 0, 1)": a direction has no unit.
std::string direction(const Vec3& way);

} // namespace abut::command
