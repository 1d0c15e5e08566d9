#pragma once

#include <abut/clash.h>
#include <abut/model.h>

#include "rigid/model_blocks.h"

#include <optional>

namespace abut {

/// A part as the narrow phase sees it: a model, or, of a large mesh, blocks of one.
struct ClashPart {
    const Model* model = nullptr;        ///< null: in blocks
    const ModelBlocks* blocks = nullptr; ///< null: whole
    const Transform& world_from_mesh;
    const Box3& box; ///< world
};

/// What two parts are to each other: nothing, or one kind of clash, all but its identity filled in.
///
/// In          clearance, touch: metres, not negative.
/// Accuracy    whether surfaces meet, whether they cross, containment: exact (see each); the
///             distance of parts that do not meet: to double rounding; of a `hard` clash: a depth
///             that is reached, and the largest to 1 % or as far as 1,000 samples tell. The same
///             bits whichever blocks are in memory.
std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch);

} // namespace abut
