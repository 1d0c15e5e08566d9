#include "world/narrow_phase/offset_surface.h"

#include <algorithm>
#include <cassert>

namespace abut {

namespace {

const Model& unit_point() {
    static const Model model(Mesh{{{0, 0, 0}}, {{0, 0, 0}}});
    return model;
}

/// A segment along the diagonal, which a transform maps to the one axis with a length.
const Model& unit_segment() {
    static const Model model(Mesh{{{-1, -1, -1}, {1, 1, 1}}, {{0, 1, 1}}});
    return model;
}

} // namespace

const Model& unit_cube() {
    static const Model model(Mesh{{{-1, -1, -1},
                                   {1, -1, -1},
                                   {-1, 1, -1},
                                   {1, 1, -1},
                                   {-1, -1, 1},
                                   {1, -1, 1},
                                   {-1, 1, 1},
                                   {1, 1, 1}},
                                  {{0, 2, 1},
                                   {1, 2, 3},
                                   {4, 5, 6},
                                   {5, 7, 6},
                                   {0, 1, 4},
                                   {1, 5, 4},
                                   {2, 6, 3},
                                   {3, 6, 7},
                                   {0, 4, 2},
                                   {2, 4, 6},
                                   {1, 3, 5},
                                   {3, 7, 5}}});
    return model;
}

OffsetSurface offset_surface_of(const RoundedBox& box) {
    Transform body_from_surface;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = box.half[k] * box.axis[k];
        body_from_surface.m[3 * k] = side.x;
        body_from_surface.m[3 * k + 1] = side.y;
        body_from_surface.m[3 * k + 2] = side.z;
    }
    const Vec3& c = box.centre;
    body_from_surface.m[9] = c.x, body_from_surface.m[10] = c.y, body_from_surface.m[11] = c.z;
    const auto flat = std::count(box.half.begin(), box.half.end(), 0.0);
    const Model& surface = flat == 3 ? unit_point() : flat == 2 ? unit_segment() : unit_cube();
    return {surface, body_from_surface, box.radius};
}

OffsetSurface offset_surface_of(const BodyShape& shape) {
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return offset_surface_of(*box);
    if (const auto* convex = std::get_if<ConvexShape>(&shape))
        return {convex->surface, {}, 0};
    assert(std::holds_alternative<Model>(shape));
    return {std::get<Model>(shape), {}, 0};
}

} // namespace abut
