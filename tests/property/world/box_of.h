#pragma once

#include <abut/types.h>

namespace abut::test {

/// The box with these half extents, centred at the origin.
inline Box3 box_of(double x, double y, double z) {
    return {{-x, -y, -z}, {x, y, z}};
}

} // namespace abut::test
