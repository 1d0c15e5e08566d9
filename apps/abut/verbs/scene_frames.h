#pragma once

#include "arguments/common.h"
#include "scenes/deforming/deforming.h"

#include <cstdint>
#include <string>

namespace abut::command {

/// Writes the keyframes of a deforming scene, one file each, and prints a description of them.
///
/// In          out: a folder, for files NAME-0000.ply, ... in it; or FILE.ply, for FILE-0000.ply,
///             ...
int make_frame_files(const std::string& name, const std::string& out, std::uint64_t frames,
                     const DeformingOptions& options, const CommonOptions& common);

} // namespace abut::command
