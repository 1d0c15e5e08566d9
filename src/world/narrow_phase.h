#pragma once

#include <abut/rigid.h>

#include "world/body.h"

namespace abut {

/// A shape and where it is.
struct PlacedBody {
    const BodyShape& shape;
    const Transform& world_from_body;
};

/// What queries remember of two bodies, whatever their shapes.
struct PairWorkspace {
    Workspace surfaces;
    ConvexWorkspace solids;
};

/// Whether two bodies share a point.
bool touch(const PlacedBody& a, const PlacedBody& b, PairWorkspace& workspace);

/// What a gap is to tell of bodies that meet.
enum class Depths : std::uint8_t {
    no,  ///< 0 for models is enough
    yes, ///< minus the depth
};

/// How far two bodies are apart. The ids are not set.
///
/// In          upper_bound: beyond it, any distance larger than it will do.
BodyGap gap_between(const PlacedBody& a, const PlacedBody& b, double upper_bound, Depths depths,
                    PairWorkspace& workspace);

/// Whether no two points of the body see each other through its outside.
inline bool is_convex(const BodyShape& shape) {
    return std::holds_alternative<RoundedBox>(shape) || std::holds_alternative<ConvexShape>(shape);
}

} // namespace abut
