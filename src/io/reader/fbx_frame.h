#pragma once

#include "io/reader/node_parts.h"
#include "io/scene/model_frame.h"

#include <assimp/scene.h>
#include <vector>

namespace abut {

/// Reads the unit and axes of an FBX file from its GlobalSettings. Defaults: centimetres and y up.
/// A file with axes other than the two usual ones, y up or z up with the front at -y, is turned to
/// y up: the transforms of its parts are changed, exactly.
FormatFrame read_fbx_frame(const aiScene& scene, std::vector<NodePart>& parts);

} // namespace abut
