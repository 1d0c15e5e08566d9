#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include "clash/clash_identity.h"
#include "tests/support/random.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Random clashes without geometry, for tests of groups.
namespace abut::test {

struct GroupedClashes {
    std::vector<Scene> models;
    ClashReport report;
};

/// Sets the id of a clash.
inline void identify(Clash& clash, const std::vector<Scene>& models) {
    const auto part = [&](std::size_t side) -> const std::string& {
        return models[clash.model.at(side)].parts[clash.part.at(side)].id;
    };
    clash.id = clash_identity(models[clash.model[0]].file, part(0), models[clash.model[1]].file,
                              part(1), clash.kind);
}

/// Up to `count` clashes between the parts of three models, one for each pair. A few parts are in
/// many of them.
inline GroupedClashes some_clashes(Random& random, int count) {
    GroupedClashes all;
    for (const char* const file : {"hvac.ifc", "pipes.ifc", "walls.ifc"}) {
        Scene& scene = all.models.emplace_back();
        scene.file = file;
        for (int i = 0; i < 12; ++i)
            scene.parts.push_back({"id" + std::to_string(i),
                                   "name" + std::to_string(i % 5),
                                   "Type" + std::to_string(i % 3),
                                   0,
                                   {},
                                   {}});
    }
    std::set<std::pair<std::uint64_t, std::uint64_t>> seen;
    for (int i = 0; i < count; ++i) {
        Clash clash;
        for (std::size_t side = 0; side < 2; ++side) {
            clash.model.at(side) = static_cast<std::uint32_t>(random.integer(0, 2));
            clash.part.at(side) =
                static_cast<std::uint32_t>(random.integer(0, random.chance(0.4) ? 2 : 11));
        }
        const auto place = [&](std::size_t side) {
            return std::uint64_t{clash.model.at(side)} << 32 | clash.part.at(side);
        };
        if (place(0) == place(1) || !seen.insert(std::minmax(place(0), place(1))).second)
            continue;
        clash.kind = random.chance(0.2) ? ClashKind::duplicate : ClashKind::hard;
        clash.point_a = random.in_cube(8);
        clash.point_b = clash.point_a;
        clash.distance = -random.uniform(0, 1);
        identify(clash, all.models);
        all.report.clashes.push_back(clash);
    }
    return all;
}

template <typename Element>
void shuffle(Random& random, std::vector<Element>& elements) {
    for (std::size_t i = elements.size(); i > 1; --i)
        std::swap(elements[i - 1],
                  elements[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
}

/// The same clashes with files, parts, clashes and sides in another order.
inline GroupedClashes permuted(Random& random, const GroupedClashes& all) {
    std::vector<std::uint32_t> model_at(all.models.size());
    std::iota(model_at.begin(), model_at.end(), 0U);
    shuffle(random, model_at);
    GroupedClashes other;
    other.report = all.report;
    std::vector<std::uint32_t> new_model(all.models.size());
    std::vector<std::vector<std::uint32_t>> new_part(all.models.size());
    for (std::uint32_t i = 0; i < model_at.size(); ++i) {
        const Scene& scene = all.models[model_at[i]];
        new_model[model_at[i]] = i;
        std::vector<std::uint32_t> part_at(scene.parts.size());
        std::iota(part_at.begin(), part_at.end(), 0U);
        shuffle(random, part_at);
        Scene& turned = other.models.emplace_back(scene);
        new_part[model_at[i]].resize(part_at.size());
        for (std::uint32_t k = 0; k < part_at.size(); ++k) {
            turned.parts[k] = scene.parts[part_at[k]];
            new_part[model_at[i]][part_at[k]] = k;
        }
    }
    for (Clash& clash : other.report.clashes) {
        for (std::size_t side = 0; side < 2; ++side) {
            clash.part.at(side) = new_part[clash.model.at(side)][clash.part.at(side)];
            clash.model.at(side) = new_model[clash.model.at(side)];
        }
        if (random.chance(0.5)) {
            std::swap(clash.model[0], clash.model[1]);
            std::swap(clash.part[0], clash.part[1]);
            std::swap(clash.point_a, clash.point_b);
        }
    }
    shuffle(random, other.report.clashes);
    return other;
}

} // namespace abut::test
