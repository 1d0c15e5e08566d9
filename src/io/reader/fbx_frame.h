#pragma once

#include "io/reader/node_parts.h"
#include "io/scene/model_frame.h"

#include <assimp/scene.h>
#include <vector>

namespace abut {

/// The unit and axes of an FBX file, from its GlobalSettings: centimetres and y up where it says
/// nothing. A file with other axes than the usual two, y up or z up with the front at -y, is turned
/// to y up: its parts' transforms are, exactly.
FormatFrame read_fbx_frame(const aiScene& scene, std::vector<NodePart>& parts);

} // namespace abut
