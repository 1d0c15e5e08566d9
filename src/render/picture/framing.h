#pragma once

#include <abut/picture.h>

namespace abut {

/// Directions of a named view: where it looks, and what is up in the picture.
struct ViewDirection {
    Vec3 towards, up;
};
ViewDirection direction_of(NamedView view, UpAxis up);

/// Returns the camera that looks in a direction and whose picture all boxes just fit into.
///
/// In          boxes: empty ones are ignored; lens: field of view and size.
Camera fit_boxes(std::span<const Box3> boxes, const ViewDirection& direction, const Camera& lens);

/// Sets the clipping distances of a camera so that a whole box is drawn.
Camera with_range(Camera camera, const Box3& box);

/// Directions from all around and mostly from above, for the choice of the best.
std::vector<ViewDirection> directions_around(UpAxis up);

} // namespace abut
