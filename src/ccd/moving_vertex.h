#pragma once

#include <abut/types.h>

namespace abut {

/// A vertex in linear motion during a step.
struct MovingVertex {
    Vec3 start, end;
};

} // namespace abut
