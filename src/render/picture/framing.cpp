#include "render/picture/framing.h"

#include "math/vector.h"

#include <algorithm>

namespace abut {

const char* to_string(NamedView view) {
    switch (view) {
    case NamedView::iso:
        return "iso";
    case NamedView::front:
        return "front";
    case NamedView::back:
        return "back";
    case NamedView::left:
        return "left";
    case NamedView::right:
        return "right";
    case NamedView::top:
        return "top";
    default:
        return "bottom";
    }
}

ViewDirection direction_of(NamedView view, UpAxis up_axis) {
    const Vec3 up = up_vector(up_axis), front = front_direction(up_axis);
    const Vec3 right = cross(front, up);
    switch (view) {
    case NamedView::front:
        return {front, up};
    case NamedView::back:
        return {-front, up};
    case NamedView::left:
        return {right, up};
    case NamedView::right:
        return {-right, up};
    case NamedView::top:
        return {-up, front};
    case NamedView::bottom:
        return {up, front};
    default:
        return {normalized_or_zero(0.8 * front + -0.6 * right + -0.55 * up), up};
    }
}

Camera with_range(Camera camera, const Box3& box) {
    if (is_empty(box))
        return camera;
    const Vec3 forward = normalized_or_zero(camera.forward);
    const double diagonal = length(box.upper - box.lower);
    const Vec3 middle = 0.5 * (box.lower + box.upper);
    const double depth = dot(forward, middle - camera.eye);
    const double off = length(middle - camera.eye);
    camera.far = std::max(depth + diagonal, 0.1 * diagonal) + 6 * diagonal + 1e-6 * off;
    camera.near = std::max(0.5 * (depth - diagonal), 1e-5 * camera.far);
    if (!(camera.far > 0))
        camera.far = 1, camera.near = 1e-5;
    return camera;
}

} // namespace abut
