#pragma once

#include <abut/model_contacts.h>

#include "rigid/manifold/region_frame.h"

#include <cstdint>
#include <span>

namespace abut {

struct ChoiceOptions {
    double margin = 0;                     ///< the largest gap
    std::span<const std::uint64_t> last{}; ///< names of the last step's points: these are favoured
};

/// Chooses up to four contact points of a region: the deepest, the one farthest from it, the one
/// farthest from the line through both, and the one farthest from the triangle of these. Places
/// where the surfaces meet are chosen before those with a gap. Of the chosen points the deepest
/// comes first.
///
/// In          region: not empty; meetings: those of both sides.
/// Returns     the points in the frame of the sides, at least one.
/// Cost        at most 170 rays for a region of at most 24 triangle pairs, else at most 70.
ModelManifold choose_points(const ManifoldSide& a, const ManifoldSide& b,
                            std::span<const TriangleMeeting> region,
                            const TriangleMeetings& meetings, const RegionFrame& frame,
                            const ChoiceOptions& options);

} // namespace abut
