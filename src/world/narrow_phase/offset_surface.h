#pragma once

#include <abut/model.h>
#include <abut/types.h>

#include "world/narrow_phase/body.h"

namespace abut {

/// A surface that stands for all points within a radius of it.
struct OffsetSurface {
    const Model& surface;
    Transform body_from_surface; ///< affine; singular if the body is flat
    double radius = 0;
};

/// The surface of a body, as an offset surface. A ball is its centre and a capsule its axis, each
/// as a triangle without area. The deep inside of a solid is not included.
///
/// In          no deformable and no half-space.
OffsetSurface offset_surface_of(const BodyShape& shape);
OffsetSurface offset_surface_of(const RoundedBox& box);
/// A polyhedron around the shape, whose radii are at most 0.5 % larger.
OffsetSurface offset_surface_of(const CurvedShape& curved);

/// The surface of the cube from -1 to 1 along all axes.
const Model& unit_cube();

} // namespace abut
