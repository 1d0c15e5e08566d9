#include "volume/aabb.h"

#include "math/rounding.h"

#include <cmath>

namespace abut {

float round_down(double v) {
    const auto f = to_float(v);
    return f <= v ? f : std::nextafterf(f, -std::numeric_limits<float>::infinity());
}
float round_up(double v) {
    const auto f = to_float(v);
    return f >= v ? f : std::nextafterf(f, std::numeric_limits<float>::infinity());
}

} // namespace abut
