#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include "scenes/random.h"

#include <array>

namespace abut::bench {

/// In [0, 1).
double unit(scenes::Random& random);

/// Uniform over all rotations.
/// Source      [Shoemake 1992].
std::array<double, 4> random_rotation(scenes::Random& random);

/// Uniform over the unit sphere.
Vec3 random_direction(scenes::Random& random);

/// Box of the placed vertices.
Box3 box_of(const Mesh& mesh, const Transform& placement);

/// Moves the middle of the box to the origin and scales its diagonal to 1.
void normalise(Mesh& mesh);

} // namespace abut::bench
