#pragma once

#include <abut/model_contacts.h>

#include "rigid/manifold/region_frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

struct ChoiceOptions {
    double margin = 0;                     ///< the largest gap
    std::span<const std::uint64_t> last{}; ///< names of the last step's points: these are favoured
};

/// Chooses up to four contact points of a region: the deepest, the one farthest from it, the one
/// farthest from the line through both, and the one farthest from the triangle of these. Of the
/// chosen points the deepest comes first.
///
/// In          region: not empty; points: those that its meetings name.
/// Returns     the points in the frame of the sides, at least one.
/// Cost        at most 170 rays for a region of at most 24 triangle pairs, else at most 70.
ModelManifold choose_points(const ManifoldSide& a, const ManifoldSide& b,
                            std::span<const TriangleMeeting> region,
                            const std::vector<FixedPoint>& points, const RegionFrame& frame,
                            const ChoiceOptions& options);

} // namespace abut
