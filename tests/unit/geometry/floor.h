#pragma once

#include "math/vector.h"

namespace abut {

/// A right triangle in the plane z = 0 with legs of length 4 along x and y. Its normal points up.
inline const Triangle kFloor{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};

} // namespace abut
