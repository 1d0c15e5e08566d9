#pragma once

#include "scenes/plant_builder.h"

#include <functional>
#include <optional>
#include <vector>

/// What is planted: pairs of parts whose relation is known.
namespace abut::scenes {

inline constexpr double kBore = 0.125; ///< radius of planted pipes

/// Two parts around the origin, on y >= 0 and within some two metres; placed as one.
struct Draft {
    ShapeId a, b;
    Transform pose_a, pose_b;
    const char *type_a, *type_b;
    std::optional<double> distance; ///< as PlantedClash::distance
    const char* what;
};

struct ClashRecipes {
    ClashKind kind;
    std::vector<std::function<Draft(PlantBuilder&)>> makers;
};

/// The recipes of every kind, in the order of kClashKinds.
const std::vector<ClashRecipes>& clash_recipes();

/// An upright pipe (along x) that is put through a slab of the plant.
ShapeId planted_riser(PlantBuilder& b);

} // namespace abut::scenes
