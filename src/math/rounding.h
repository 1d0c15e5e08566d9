#pragma once

namespace abut {

/// The largest relative error of one operation in double precision, rounded to nearest.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// The nearest float. Every conversion from double to float goes through this function.
///
/// g++ 12 turns two such conversions side by side, if they are converted back to double, into one
/// vector operation, and then drops both: the double keeps all its digits
/// (docs/decisions/0024-rounding-to-float.md). The empty statement hides the value from that step.
inline float to_float(double value) {
    auto rounded = static_cast<float>(value);
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__SSE2__)
    asm("" : "+x"(rounded));
#else
    asm("" : "+m"(rounded));
#endif
#endif
    return rounded;
}

} // namespace abut
