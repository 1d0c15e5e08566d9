#pragma once

#include "scenes/plant/plant_builder.h"

#include <functional>
#include <optional>
#include <vector>

/// The planted clashes: pairs of parts whose relation is known.
namespace abut::scenes {

inline constexpr double kBore = 0.125; ///< radius of planted pipes

/// Two parts near the origin, with y >= 0 and within some two metres. They are placed together.
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

/// The recipes of every kind but `undecided`, in the order of kClashKinds.
const std::vector<ClashRecipes>& clash_recipes();

/// A pipe (along x) that is planted upright through a slab of the plant.
ShapeId planted_riser(PlantBuilder& b);

} // namespace abut::scenes
