#pragma once

#include "arguments/common.h"
#include "scenes/plant/plant.h"

#include <string>

namespace abut::command {

/// Writes a plant to FILE.glb and its true clashes to FILE.truth.json; prints the latter.
int make_plant_files(const std::string& out, const PlantOptions& options,
                     const CommonOptions& common);

} // namespace abut::command
