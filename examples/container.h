#pragma once

#include "simulator.h"
#include "surfaces.h"

namespace drop {

/// A container, open at the top, and bodies above it: balls, capsules and bricks of about 0.2 in turn, on
/// a loose lattice, turned at random. The first five bodies are the container's floor and walls,
/// whose inside is half_width() wide on either side of the z axis; the floor is at z = 0.
Surfaces fill_container(Simulator& simulator, int bodies);

/// Of the container for so many bodies.
double half_width(int bodies);

} // namespace drop
