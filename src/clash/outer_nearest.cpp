#include "clash/outer_nearest.h"

#include "clash/blocks_pair.h"
#include "rigid/model/solid_boundary.h"

#include <limits>

namespace abut {

namespace {

/// The part with the boundary of its solid in place of its mesh, where these differ.
ClashPart outside_of(BlockList& part) {
    const ClashPart& whole = part.part();
    const SolidBoundary* const boundary = part.solid().boundary();
    if (boundary == nullptr)
        return whole;
    return {&boundary->model, nullptr, whole.world_from_mesh, whole.box};
}

std::uint32_t whole_number_of(const WorldSolid& solid, std::uint32_t triangle) {
    return solid.boundary() != nullptr ? solid.boundary()->source[triangle] : triangle;
}

} // namespace

Gap nearest_outside(PartPair& pair) {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    if (a.boundary() == nullptr && b.boundary() == nullptr)
        return pair.nearest(kAny);
    const ClashPart of_a = outside_of(pair.a()), of_b = outside_of(pair.b());
    Gap gap = of_a.blocks != nullptr || of_b.blocks != nullptr
                  ? BlocksPair(of_a, of_b).nearest(kAny)
                  : WholePair(of_a, of_b).nearest(kAny);
    gap.triangle_a = whole_number_of(a, gap.triangle_a),
    gap.triangle_b = whole_number_of(b, gap.triangle_b);
    return gap;
}

} // namespace abut
