#pragma once

#include <abut/types.h>

namespace abut {

/// The position of a vertex at the start and at the end of a step.
struct MovingVertex {
    Vec3 start, end;
};

} // namespace abut
