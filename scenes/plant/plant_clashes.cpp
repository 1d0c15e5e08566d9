#include "scenes/clash_drafts.h"
#include "scenes/plant/plant_unit.h"

#include <array>
#include <fmt/format.h>

namespace abut::scenes {
namespace {

void plant_at(PlantBuilder& b, const Draft& draft, const Transform& site, ClashKind kind,
              int number) {
    const std::string name = fmt::format("planted {} {}", to_string(kind), number);
    const std::uint32_t first =
        b.plant(draft.a, after(site, draft.pose_a), draft.type_a, name + " A");
    const std::uint32_t second =
        b.plant(draft.b, after(site, draft.pose_b), draft.type_b, name + " B");
    b.record(kind, first, second, draft.distance, draft.what);
}

/// A random spot in a random storey, turned by a random quarter turn.
Transform random_site(PlantBuilder& b, const Unit& unit) {
    constexpr std::array<Vec3, 4> kTurns{Vec3{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
    const int i = b.random.below(unit.bays_x), k = b.random.below(unit.bays_z);
    const int f = b.random.below(unit.floors);
    const Vec3 p{b.random.uniform(1, kBay - 1), b.random.uniform(b.gap, 2.75),
                 b.random.uniform(1, kBay - 1)};
    const Vec3 spot = unit.in_bay(i, k, f, p);
    return turned(b.random.pick(kTurns), kY, spot);
}

/// Plants an upright pipe through an existing slab. This is the only planted kind whose partner
/// belongs to the plant itself.
bool plant_pipe_through_slab(PlantBuilder& b, const Unit& unit, int number) {
    const ShapeId riser = planted_riser(b);
    for (int attempt = 0; attempt < 64; ++attempt) {
        const auto slab =
            static_cast<std::uint32_t>(b.random.below(static_cast<int>(b.parts().size())));
        const Part& part = b.parts()[slab];
        if (part.type != "IfcSlab" || part.world_from_mesh.m[10] <= unit.origin.y) {
            continue; // not the floor of a storey
        }
        const std::vector<Box3>& cover = b.shape(part.mesh).cover;
        const Box3 area =
            moved(part.world_from_mesh,
                  cover[static_cast<std::size_t>(b.random.below(static_cast<int>(cover.size())))]);
        const double inset = 2 * kBore;
        if (area.upper.x - area.lower.x < 4 * inset || area.upper.z - area.lower.z < 4 * inset) {
            continue;
        }
        const Transform pose = along(
            kY, {b.random.uniform(area.lower.x + inset, area.upper.x - inset), area.lower.y - 0.5,
                 b.random.uniform(area.lower.z + inset, area.upper.z - inset)});
        if (b.free(riser, pose, slab)) {
            const std::uint32_t index = b.plant(riser, pose, "IfcPipeSegment",
                                                fmt::format("planted hard {} riser", number));
            b.record(ClashKind::hard, index, slab, {},
                     "pipe through a floor slab without an opening");
            return true;
        }
    }
    return false;
}

} // namespace

void plant_clashes(PlantBuilder& b, const std::vector<Unit>& units, const Vec3& laydown) {
    const std::size_t kinds = b.options.clearance < 16 * kGrid ? 4 : 5;
    int outside = 0;
    for (int n = 0; n < b.options.clashes; ++n) {
        const auto index = static_cast<std::size_t>(n);
        const ClashRecipes& recipe = clash_recipes()[index % kinds];
        const std::size_t turn_of_kind = index / kinds;
        const Unit& unit = units[index % units.size()];
        if (recipe.kind == ClashKind::hard && turn_of_kind % 6 == 5 &&
            plant_pipe_through_slab(b, unit, n + 1)) {
            continue;
        }
        const Draft draft = recipe.makers[turn_of_kind % recipe.makers.size()](b);
        bool planted = false;
        for (int attempt = 0; attempt < 32 && !planted; ++attempt) {
            const Transform site = random_site(b, unit);
            if (b.free(draft.a, after(site, draft.pose_a)) &&
                b.free(draft.b, after(site, draft.pose_b))) {
                plant_at(b, draft, site, recipe.kind, n + 1);
                planted = true;
            }
        }
        // If the building is too full for all clashes, the rest lies in rows beside the plant,
        // where there is always room.
        if (!planted) {
            const int column = outside % 32, row = outside / 32;
            const Vec3 spot = add(laydown, {3.0 * column, b.gap, -3.0 * row});
            plant_at(b, draft, at(spot), recipe.kind, n + 1);
            ++outside;
        }
    }
}

} // namespace abut::scenes
