#pragma once

#include "clash/part_pair.h"

namespace abut {

/// Returns the nearest points of two parts whose surfaces do not meet. Faces that lie inside their own
/// solid do not count (WorldSolid::boundary): one part may lie in the other.
Gap nearest_outside(PartPair& pair);

} // namespace abut
