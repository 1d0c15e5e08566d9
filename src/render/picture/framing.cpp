#include "render/picture/framing.h"

#include "math/vector.h"
#include "render/picture/picture_model.h"

#include <cmath>
#include <numbers>

namespace abut {

namespace {

/// The direction in which the front view looks.
Vec3 front_direction(UpAxis up) {
    return up == UpAxis::z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
}

} // namespace

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

std::vector<ViewDirection> directions_around(UpAxis up_axis) {
    const Vec3 up = up_vector(up_axis), front = front_direction(up_axis);
    const Vec3 right = cross(front, up);
    std::vector<ViewDirection> directions;
    for (const double height : {0.45, 0.85, 0.1, -0.4})
        for (int i = 0; i < 12; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5) / 12;
            const Vec3 flat = std::cos(angle) * front + std::sin(angle) * right;
            directions.push_back({normalized_or_zero(flat + -height * up), up});
        }
    return directions;
}

} // namespace abut
