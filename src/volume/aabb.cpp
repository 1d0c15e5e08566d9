#include "volume/aabb.h"

#include "math/rounding.h"

#include <bit>
#include <cstdint>

namespace abut {

namespace {

/// The float that is `steps` floats above. Without branches: whether a number is rounded up or down
/// is a coin toss. The sign of zero matters: the float above -0 is +0.
float moved(float f, std::int32_t steps) {
    const auto in_order = [](std::int32_t bits) { return bits ^ (bits >> 31 & 0x7fffffff); };
    return std::bit_cast<float>(in_order(in_order(std::bit_cast<std::int32_t>(f)) + steps));
}

} // namespace

// A number that is not 0 is rounded to a zero of its own sign, so that `moved` steps to the least
// float of that sign, not to the other zero.
float round_down(double v) {
    const auto f = to_float(v);
    return moved(f, -static_cast<std::int32_t>(f > v));
}
float round_up(double v) {
    const auto f = to_float(v);
    return moved(f, static_cast<std::int32_t>(f < v));
}

} // namespace abut
