#pragma once

#include "clash_scene.h"
#include "report.h"

#include <string>
#include <vector>

namespace abut::bench {

struct ClashSuiteOptions {
    ClashSceneOptions scene;
    std::string part_file;   ///< empty: the ribbed ring
    double clearance = 0.05; ///< in diameters of the part
    int rounds = 5;
    int threads = 2; ///< of the rows that use more than one
};

/// Intersection and clearance of all candidate pairs, against FCL; then the whole clash job.
Report run_clash_suite(const ClashSuiteOptions& options);

} // namespace abut::bench
