#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include "scenes/random.h"

#include <array>

namespace abut::bench {

/// A number in [0, 1).
double unit(scenes::Random& random);

/// A random rotation, uniform over all rotations.
///
/// Source      [Shoemake 1992].
std::array<double, 4> random_rotation(scenes::Random& random);

/// A random direction, uniform over the unit sphere.
Vec3 random_direction(scenes::Random& random);

/// Rotates further, about an axis.
std::array<double, 4> turned(const std::array<double, 4>& rotation, const Vec3& axis,
                             double degrees);

Vec3 placed(const Transform& t, const Vec3& p);
/// Makes the box enclose the point.
void extend(Box3& box, const Vec3& p);
/// The box of the placed vertices.
Box3 box_of(const Mesh& mesh, const Transform& placement);

/// Moves the middle of the mesh's box to the origin, and scales the diagonal to 1.
void normalise(Mesh& mesh);

} // namespace abut::bench
