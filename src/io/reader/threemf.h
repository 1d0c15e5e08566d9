#pragma once

#include "io/reader/node_parts.h"
#include "io/scene/model_frame.h"

#include <map>
#include <string>

namespace abut {

/// The data of a 3MF file that Assimp leaves out: its unit, and the names of its objects.
struct ThreemfModel {
    FormatFrame frame;                        ///< z up [3MF Core 1.3, 3.3]
    std::map<std::string, std::string> names; ///< by object id
};

/// Errors      Fault malformed: not an archive, no model in it, an unknown unit, or sizes that no
///             model can have.
ThreemfModel read_3mf_model(const std::string& file);

} // namespace abut
