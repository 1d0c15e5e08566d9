#pragma once

#include <abut/model.h>
#include <abut/types.h>

#include "world/body.h"

namespace abut {

/// A surface, and all that lies within a radius of it.
struct OffsetSurface {
    const Model& surface;
    Transform body_from_surface; ///< affine, and without an inverse where the body is flat
    double radius = 0;
};

/// The surface of the body's points, but for what lies deep within a solid: of a ball its centre, of a
/// capsule its axis, each as a triangle without area.
///
/// In          no deformable.
OffsetSurface offset_surface_of(const BodyShape& shape);
OffsetSurface offset_surface_of(const RoundedBox& box);

/// The surface of the cube from -1 to 1 on all axes.
const Model& unit_cube();

} // namespace abut
