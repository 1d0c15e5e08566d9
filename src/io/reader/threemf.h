#pragma once

#include "io/reader/node_parts.h"
#include "io/scene/model_frame.h"

#include <map>
#include <set>
#include <string>

namespace abut {

/// The data of a 3MF file that Assimp leaves out: its unit, the names of its objects, and which of
/// them have a material, since Assimp gives the others the first material of the file.
struct ThreemfModel {
    FormatFrame frame;                        ///< z up [3MF Core 1.3, 3.3]
    std::map<std::string, std::string> names; ///< by object id
    std::set<std::string> with_material;      ///< ids of objects
};

/// Errors      Fault malformed: not an archive, no model in it, an unknown unit, or sizes that no
///             model can have.
ThreemfModel read_3mf_model(const std::string& file);

} // namespace abut
