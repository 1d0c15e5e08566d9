#include "clash/outer_contacts.h"

#include "geometry/triangle_triangle_distance.h"
#include "rigid/model/solid_boundary.h"

#include <algorithm>
#include <vector>

namespace abut {

namespace {

/// The parts of a triangle on the boundary of its solid.
std::vector<Triangle> outer_parts(const WorldSolid& solid, std::uint32_t triangle) {
    const SolidBoundary* const boundary = solid.boundary();
    if (boundary == nullptr)
        return {solid.world_triangle(triangle)};
    std::vector<Triangle> parts;
    solid.for_each_surface_block(solid.world_box(), [&](const WorldSolid::Block& block) {
        const auto& source = boundary->source;
        const auto [begin, end] = std::equal_range(source.begin(), source.end(), triangle);
        for (auto at = begin; at != end; ++at)
            parts.push_back(
                block.model.world_triangle(static_cast<std::uint32_t>(at - source.begin())));
        return true;
    });
    return parts;
}

} // namespace

bool OuterContacts::holds(const TrianglePair& pair) const {
    // Where faces are cut, their parts are off by rounding.
    const double rounding =
        0x1p-40 * (a_.world_size() + max_abs(a_.middle()) + b_.world_size() + max_abs(b_.middle()));
    const std::vector<Triangle> of_a = outer_parts(a_, pair.a), of_b = outer_parts(b_, pair.b);
    return std::ranges::any_of(of_a, [&](const Triangle& s) {
        return std::ranges::any_of(of_b, [&](const Triangle& t) {
            return triangle_triangle_distance(s, t).distance_sq <= rounding * rounding;
        });
    });
}

} // namespace abut
