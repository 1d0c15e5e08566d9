#pragma once

#include <abut/clash.h>
#include <abut/model.h>

#include "rigid/model/model_blocks.h"

#include <optional>

namespace abut {

/// A part as the narrow phase sees it: a model, or the mesh blocks of a large mesh.
struct ClashPart {
    const Model* model = nullptr;        ///< null if the part is in blocks
    const ModelBlocks* blocks = nullptr; ///< null if the part is one model
    const Transform& world_from_mesh;
    const Box3& box; ///< world
};

/// Returns the clash of two parts, or none. All members are filled in except the ids, models, parts
/// and rule.
///
/// In          clearance, touch: metres, not negative.
/// Accuracy    whether surfaces meet, whether they cross and whether a part is contained are
///             decided exactly. The distance of parts that do not meet is exact to double rounding.
///             The depth of a `hard` clash is reached at its witness points; it is the largest to 1
///             %, or as near as 200 samples of each surface come (1,000 as long as none has reached
///             a depth). The bits do not depend on which mesh blocks are in memory.
std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch);

} // namespace abut
