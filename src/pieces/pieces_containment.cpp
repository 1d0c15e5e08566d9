#include "pieces/pieces_containment.h"

#include "rigid/solid/world_solid.h"

#include <cmath>

namespace abut {

namespace {

/// Returns whether the surface winds around a point that is not on it.
bool winds_around(const PlacedModel& surface, const Vec3& point) {
    const double off = length(point - surface.middle());
    if (!(off <= 2 * surface.reach()))
        return false;
    const double far = off + 2 * surface.reach();
    // A segment is undecided with probability almost 0; the limit only ends the loop on absurd
    // input.
    for (int k = 1; k < 64; ++k) {
        // Directions in general position to each other and to all axes.
        const Vec3 d =
            normalized_or_zero({std::sin(1.7 * k), std::sin(2.3 * k + 1), std::sin(3.1 * k + 2)});
        if (const auto count = crossings(surface, point, point + far * d))
            return *count != 0;
    }
    return false;
}

/// Returns whether a vertex of an inner component may lie in the ball around the outer solid.
bool may_contain(const ConvexPiecesData& inner, const Transform& world_from_inner,
                 const ConvexPiecesData& outer, const Transform& world_from_outer) {
    const HullNode& root = outer.tree.nodes[0];
    const Vec3 middle = apply(world_from_outer, root.middle);
    const double reach = stretch_of(world_from_outer).most * root.radius * (1 + 0x1p-20);
    for (const std::uint32_t v : inner.components)
        if (length(apply(world_from_inner, inner.mesh().positions[v]) - middle) <= reach)
            return true;
    return false;
}

std::optional<Vec3> contained(const ConvexPiecesData& inner, const Transform& world_from_inner,
                              const ConvexPiecesData& outer, const Transform& world_from_outer) {
    if (!may_contain(inner, world_from_inner, outer, world_from_outer))
        return std::nullopt;
    const PlacedModel surface(outer.model, world_from_outer);
    for (const std::uint32_t v : inner.components) {
        const Vec3 point = apply(world_from_inner, inner.mesh().positions[v]);
        if (winds_around(surface, point))
            return point;
    }
    return std::nullopt;
}

} // namespace

std::optional<Vec3> contained_point(const PlacedPieces& placed) {
    auto point = contained(placed.b, placed.world_from_b, placed.a, placed.world_from_a);
    return point ? point : contained(placed.a, placed.world_from_a, placed.b, placed.world_from_b);
}

} // namespace abut
