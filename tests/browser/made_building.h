#pragma once

#include <abut/scene.h>

#include <cstddef>
#include <string>
#include <vector>

/// Slabs above each other and pipes through them: a building whose clashes are known.
struct MadeBuilding {
    static constexpr std::size_t kSlabs = 12;
    static constexpr double kStorey = 3.5; ///< height, metres

    /// In          clashes: approximate number. names: of the first pipes.
    explicit MadeBuilding(std::size_t clashes, const std::vector<std::string>& names);

    std::vector<abut::Scene> models; ///< slabs and pipes, z up
    std::size_t clashes = 0;         ///< each pipe is hard with each slab
};
