#include "world/contacts/walls.h"

#include "core/borrowed.h"
#include "rigid/manifold/region_names.h"

namespace abut {

void append_walls(std::span<const ContactManifold> walls, RegionsOfPair& last,
                  std::vector<ContactManifold>& manifolds) {
    if (walls.empty())
        last.manifolds.clear();
    if (walls.size() < 2 && last.manifolds.empty()) {
        manifolds.insert(manifolds.end(), walls.begin(), walls.end());
        return;
    }
    static thread_local std::vector<ModelManifold> memory;
    Borrowed<std::vector<ModelManifold>> borrowed(memory);
    std::vector<ModelManifold>& regions = *borrowed;
    regions.clear();
    for (const ContactManifold& wall : walls) {
        ModelManifold& region = regions.emplace_back();
        region.normal = wall.normal, region.count = wall.count, region.points = wall.points;
    }
    name_regions(regions, &last.manifolds);
    for (const ModelManifold& region : regions) {
        ContactManifold& manifold = manifolds.emplace_back();
        manifold.normal = region.normal, manifold.region = region.region;
        manifold.count = region.count, manifold.points = region.points;
    }
    last.manifolds.assign(regions.begin(), regions.end());
    last.placements = {};
}

} // namespace abut
