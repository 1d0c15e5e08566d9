#pragma once

#include <abut/contacts.h>
#include <abut/model_contacts.h>
#include <abut/rigid.h>

#include "world/narrow_phase/body.h"
#include "world/solids/known_separation.h"

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// A shape and its transform.
struct PlacedBody {
    const BodyShape& shape;
    const Transform& world_from_body;
    /// The shape in the world, if it is a box and if that is known; else null.
    const RoundedBox* box_in_world = nullptr;
};

/// Two bodies and their placements, by numbers that are unique in a world; 0: none.
struct PlacementPair {
    std::uint64_t a = 0, b = 0;
    bool operator==(const PlacementPair&) const = default;
};

/// The manifolds of two surfaces, or of a solid and a surface, at the last query of contacts.
struct RegionsOfPair {
    PlacementPair placements;
    double margin = 0;
    std::vector<ModelManifold> manifolds;
};

/// Data kept from one query of two bodies to the next, for all kinds of shape.
struct PairWarmStart {
    WarmStart surfaces;
    ConvexWarmStart solids;
    Vec3 direction; ///< from a to b in the table's order; zero: none is known
    RegionsOfPair regions;
    /// The names of the points of other bodies at the last query of contacts.
    boost::container::static_vector<std::uint64_t, 4> points;
    KnownSeparation separation; ///< of two boxes or capsules at the last query of contacts
};

/// Whether two bodies share a point.
bool touch(const PlacedBody& a, const PlacedBody& b, PairWarmStart& warm_start);

/// What gap_between returns for bodies that overlap.
enum class Depths : std::uint8_t {
    no,  ///< for a model: 0, or a number that is not above 0
    yes, ///< minus the depth; a pair with a model must share a point
};

/// The gap between two bodies. The ids are not set.
///
/// In          upper_bound: if the gap is larger, any distance above the bound may be returned.
BodyGap gap_between(const PlacedBody& a, const PlacedBody& b, double upper_bound, Depths depths,
                    PairWarmStart& warm_start);

/// The signed distance of two bodies, as World tells it: if they share no point, the distance of
/// their nearest points, where a model is its surface; else minus the depth, where a closed model is
/// a solid. The ids are not set.
///
/// In          upper_bound: as above.
BodyGap signed_gap_between(const PlacedBody& a, const PlacedBody& b, double upper_bound,
                           PairWarmStart& warm_start);

/// Whether the kind of shape is convex. Models count as not convex.
inline bool is_convex(const BodyShape& shape) {
    return !std::holds_alternative<Model>(shape) && !is_deformable(shape);
}

} // namespace abut
