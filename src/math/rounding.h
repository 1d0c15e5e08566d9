#pragma once

namespace abut {

/// The largest relative error of one operation in double precision, rounded to nearest.
inline constexpr double kUnitRoundoff = 0x1p-53;

} // namespace abut
