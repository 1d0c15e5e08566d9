#pragma once

#include "scenes/deforming/deforming.h"

#include <cstdint>
#include <memory>

namespace abut::scenes {

/// Balls thrown together in a closed box.
std::unique_ptr<DeformingScene> bouncing_balls(const DeformingOptions& options);

/// A ball that falls and breaks into pieces, one crack at a time. Separated pieces have vertices of
/// their own, and triangles along the crack. In the end there are options.triangles triangles.
std::unique_ptr<DeformingScene> breaking_ball(const DeformingOptions& options);

} // namespace abut::scenes
