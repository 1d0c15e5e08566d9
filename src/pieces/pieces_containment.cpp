#include "pieces/pieces_containment.h"

#include "rigid/solid/placed_solid.h"

namespace abut {

namespace {

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
    const PlacedSolid solid(outer.model, outer.model.data().solid(), world_from_outer);
    for (const std::uint32_t v : inner.components) {
        const Vec3 point = apply(world_from_inner, inner.mesh().positions[v]);
        if (solid.contains_off_surface(point))
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
