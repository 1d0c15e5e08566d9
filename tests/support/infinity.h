#pragma once

#include <limits>

namespace abut::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace abut::test
