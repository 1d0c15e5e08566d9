#pragma once

#include <abut/mesh.h>

#include "report.h"

#include <string>
#include <vector>

namespace abut::bench {

/// A mesh at the start and at the end of a step.
struct CcdStep {
    std::string name;
    Mesh start;
    std::vector<Vec3> end;
};

/// Rows of a step: all impacts on one thread and on two, the earliest impact, then each other
/// scheme, assignment and culling, compared with representative triangles.
std::vector<Row> ccd_step_rows(const CcdStep& step, int rounds);

/// Rows of a deforming scene: means over some of its frames; each other scheme compared with
/// representative triangles.
///
/// Errors      Error{bad_argument} if there is no such scene.
std::vector<Row> ccd_scene_rows(const std::string& scene, int samples, int rounds);

/// Our build of a million triangles and Embree's, which tells how fast the machine is.
std::vector<Row> calibration_rows(int rounds);

} // namespace abut::bench
