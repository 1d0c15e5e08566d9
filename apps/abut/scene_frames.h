#pragma once

#include "common.h"
#include "scenes/deforming.h"

#include <cstdint>
#include <string>

namespace abut::command {

/// Writes so many frames of a deforming scene, one file each, and prints what they are.
///
/// In          out: a folder, for its NAME-0000.ply, ...; or FILE.ply, for FILE-0000.ply, ...
int make_frame_files(const std::string& name, const std::string& out, std::uint64_t frames,
                     const DeformingOptions& options, const CommonOptions& common);

} // namespace abut::command
