#pragma once

#include "simulator/scenes.h"

namespace simulation {

/// A container, open at the top, with bodies above it: balls, capsules and bricks of about 0.2 m in
/// turn, on a loose lattice, in random orientations. The first five bodies are the container's
/// floor and walls. The inside extends half_width() to either side of the z axis; the floor is at z
/// = 0.
void fill_container(Stage& stage, int bodies);

/// The half width of the container for this number of bodies.
double half_width(int bodies);

} // namespace simulation
