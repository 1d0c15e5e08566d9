#pragma once

#include "clash/classify_pair.h"
#include "rigid/model/model_data.h"
#include "tests/support/shapes.h"

#include <optional>

namespace abut::test {

/// The world box of a placed mesh.
inline Box3 world_box_of(const Mesh& mesh, const Transform& world) {
    Box3 box;
    for (const Vec3& p : mesh.positions)
        extend(box, apply(world, p));
    return box;
}

/// The clash of two placed meshes. `rounding`: of the positions of each.
inline std::optional<Clash> classified(const Mesh& a, const Mesh& b, double touch,
                                       const Transform& world_a = {}, const Transform& world_b = {},
                                       double clearance = 0, double rounding = 0) {
    const Model model_a(a), model_b(b);
    const Box3 box_a = world_box_of(a, world_a), box_b = world_box_of(b, world_b);
    return classify_pair({&model_a, nullptr, world_a, box_a, rounding},
                         {&model_b, nullptr, world_b, box_b, rounding}, clearance, touch);
}

} // namespace abut::test
