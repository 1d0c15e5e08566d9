#pragma once

#include <abut/scene.h>

#include <string>

/// An engine in motion, with planted clashes: the example of `abut motion`.
namespace abut::scenes {

struct EngineOptions {
    int cylinders = 4;
    /// Whether the skirt of one piston is too long, so that it hits the crank's counterweights at
    /// its bottom dead centre, and a screw of the tray stands in the way of one rod.
    bool clashes = true;
};

struct Engine {
    Scene scene;          ///< z up; all parts at rest
    std::string assembly; ///< the text of a TOML file for read_assembly
};

/// The crank turns twice in 0.04 s, from 90 to 810 degrees. Piston 3 is at its bottom at 360 and at
/// 720 degrees, rod 1 at 180 and at 540 degrees. Fewer than three cylinders: the last piston is long.
///
/// In          model_file: the name of the scene's file, which the assembly refers to
Engine make_engine(const EngineOptions& options, const std::string& model_file);

} // namespace abut::scenes
