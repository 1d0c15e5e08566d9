#pragma once

#include "arguments/common.h"
#include "scenes/engine.h"

#include <string>

namespace abut::command {

/// Writes an engine's assembly to FILE.toml and its parts to FILE.glb.
int make_engine_files(const std::string& out, const scenes::EngineOptions& options,
                      const CommonOptions& common);

} // namespace abut::command
