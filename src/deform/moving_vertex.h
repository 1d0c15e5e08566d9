#pragma once

#include <abut/types.h>

namespace abut {

/// Where a vertex is at the start and at the end of a step.
struct MovingVertex {
    Vec3 start, end;
};

} // namespace abut
