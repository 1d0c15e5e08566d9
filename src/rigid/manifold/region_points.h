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
/// Cost        lines along the normal: at most 82 for a region of at most 24 triangle pairs (2 for
///             the deepest vertices, 50 for the deepest place inside, 30 for the 15 candidates for
///             other points), else at most 34. Each takes one ray, or two if the first one meets no
///             surface that it leaves: so at most 164 rays, else at most 68.
ModelManifold choose_points(const ManifoldSide& a, const ManifoldSide& b,
                            std::span<const TriangleMeeting> region,
                            const TriangleMeetings& meetings, const RegionFrame& frame,
                            const ChoiceOptions& options);

} // namespace abut
