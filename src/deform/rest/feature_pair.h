#pragma once

#include <abut/deformable.h>

#include "ccd/feature_distance.h"

#include <array>

namespace abut {

/// Fills in what follows from the positions of a pair of features: side, weights, closest points,
/// distance and normal.
///
/// In/out      pair: kind, ids and limit are set. points: in the order of ElementaryPair. found: their
///             feature_distance, which is at most the limit, but for rounding.
void measure(FeaturePair& pair, const std::array<Vec3, 4>& points, const FeatureDistance& found);

} // namespace abut
