#pragma once

#include "scenes/deforming.h"

#include <cstdint>
#include <memory>

namespace abut::scenes {

/// Balls thrown together in a closed box.
std::unique_ptr<DeformingScene> bouncing_balls(const DeformingOptions& options);

/// A ball that falls and breaks into pieces, a crack at a time. Pieces that come apart have vertices
/// of their own, and triangles where the crack went through. It has options.triangles in the end.
std::unique_ptr<DeformingScene> breaking_ball(const DeformingOptions& options);

} // namespace abut::scenes
