#pragma once

#include <abut/clash.h>
#include <abut/model.h>

#include <optional>

namespace abut {

/// A part as the narrow phase sees it.
struct ClashPart {
    const Model& model;
    const Transform& world_from_mesh;
    const Box3& box; ///< world
};

/// What two parts are to each other: nothing, or one kind of clash, all but its identity filled in.
///
/// In          clearance, touch: metres, not negative.
/// Accuracy    whether surfaces meet, whether they cross, containment: exact (see each); the
///             distance of parts that do not meet: to double rounding; of a `hard` clash: a depth
///             that is reached, and the largest to 1 % or as far as 1,000 samples tell.
std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch);

} // namespace abut
