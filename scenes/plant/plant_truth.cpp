#include "scenes/plant/plant.h"

#include <nlohmann/json.hpp>

namespace abut {

std::string plant_truth_json(const Plant& plant) {
    using nlohmann::ordered_json;
    ordered_json counts = ordered_json::object();
    for (const ClashKind kind : kClashKinds) {
        if (kind == ClashKind::undecided)
            continue; // none is planted
        counts[to_string(kind)] = 0;
    }
    ordered_json clashes = ordered_json::array();
    for (const PlantedClash& clash : plant.truth) {
        counts[to_string(clash.kind)] = counts[to_string(clash.kind)].get<int>() + 1;
        ordered_json distance; // null if it is not known exactly
        if (clash.distance) {
            distance = *clash.distance;
        }
        clashes.push_back({{"kind", to_string(clash.kind)},
                           {"a", clash.a},
                           {"b", clash.b},
                           {"distance", distance},
                           {"what", clash.what}});
    }
    const ordered_json root{{"seed", plant.options.seed},
                            {"parts", plant.scene.parts.size()},
                            {"triangles", plant.triangles},
                            {"clearance", plant.options.clearance},
                            {"separation", plant.separation},
                            {"counts", counts},
                            {"clashes", clashes}};
    return root.dump(2) + "\n";
}

} // namespace abut
