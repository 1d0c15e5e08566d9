#pragma once

#include <abut/camera.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <span>
#include <vector>

namespace abut {

/// A direction to look in, and the direction that is up in the picture.
struct ViewDirection {
    Vec3 towards, up;
};

Vec3 up_vector(UpAxis up);

/// The direction in which the front view looks.
Vec3 front_direction(UpAxis up);

/// The corner of a box that is upper along x, y and z where the bits 1, 2 and 4 of `i` are set.
Vec3 corner_of(const Box3& box, int i);

/// Returns the camera that looks in a direction and whose picture all boxes just fit into.
///
/// In          boxes: empty ones are ignored; lens: field of view and size.
Camera fit_boxes(std::span<const Box3> boxes, const ViewDirection& direction, const Camera& lens);

/// Directions from all around and mostly from above, for the choice of the best.
std::vector<ViewDirection> directions_around(UpAxis up);

} // namespace abut
