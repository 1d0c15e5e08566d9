#pragma once

#include "scenes/plant/plant.h"

namespace abut::scenes {

/// Gives every part a mesh of its own: the same triangles in an order of their own.
void make_distinct(Plant& plant);

} // namespace abut::scenes
