#pragma once

#include "report.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::bench {

struct MeshWorldOptions {
    std::size_t bodies = 1000;
    std::vector<std::string> files; ///< meshes of the bodies; boulders if there are none
    std::uint32_t triangles = 2000; ///< of a boulder, about
    std::vector<double> spacings{0.54, 0.45};
    int steps = 9;
    bool alone = false;
    std::uint64_t seed = 3;
};

/// Adds rows of a world of moving meshes: which touch, and their contact manifolds.
void add_mesh_world_rows(Report& report, const MeshWorldOptions& options);

} // namespace abut::bench
