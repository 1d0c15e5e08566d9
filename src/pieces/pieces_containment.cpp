#include "pieces/pieces_containment.h"

#include "math/predicates.h"
#include "rigid/placed_model.h"

#include <cmath>

namespace abut {

namespace {

/// How often the surface winds around a point, as counted along a segment to a point that it does
/// not wind around; nothing if the segment meets an edge or a vertex, and the count says nothing.
std::optional<int> crossings(const PlacedModel& surface, const Vec3& from, const Vec3& to) {
    int count = 0;
    bool clear = true;
    surface.for_each_on_segment(from, to, [&](std::uint32_t slot) {
        const Triangle t = surface.world_slot(slot);
        const int side_from = orient3d(t[0], t[1], t[2], from),
                  side_to = orient3d(t[0], t[1], t[2], to);
        if (side_from * side_to > 0)
            return;
        const int u = orient3d(from, to, t[0], t[1]), v = orient3d(from, to, t[1], t[2]),
                  w = orient3d(from, to, t[2], t[0]);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)))
            return;
        clear = clear && side_from != 0 && side_to != 0 && u != 0 && v != 0 && w != 0;
        count += side_to;
    });
    return clear ? std::optional(count) : std::nullopt;
}

/// Whether the surface winds around a point off it.
bool winds_around(const PlacedModel& surface, const Vec3& point) {
    const double off = length(point - surface.middle());
    if (!(off <= 2 * surface.reach()))
        return false;
    const double far = off + 2 * surface.reach();
    // A segment is unclear with probability next to zero; the limit ends the loop on absurd input.
    for (int k = 1; k < 64; ++k) {
        // Directions with no special relation to each other or to any axis.
        const Vec3 d =
            normalized_or_zero({std::sin(1.7 * k), std::sin(2.3 * k + 1), std::sin(3.1 * k + 2)});
        if (const auto count = crossings(surface, point, point + far * d))
            return *count != 0;
    }
    return false;
}

/// Whether a vertex of a component of the inner solid may lie within the ball around the outer one.
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
