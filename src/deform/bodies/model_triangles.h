#pragma once

#include <abut/model.h>

#include "geometry/point_triangle_distance.h"
#include "rigid/model/placed_model.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace abut {

/// The triangles of a placed model, searched for the one that is nearest to a triangle of the
/// world.
class ModelTriangles {
public:
    /// In          model: must outlive this. The transform is rigid.
    /// Errors      Error{bad_argument} if the transform is not finite.
    ModelTriangles(const Model& model, const Transform& world_from_model);

    struct Found {
        ClosestPoints closest; ///< a: on the triangle that was asked for
        std::uint32_t triangle = 0;
    };
    /// What a search has looked at: the part of its cost that does not depend on the machine.
    struct Work {
        std::size_t nodes = 0, triangles = 0;
    };

    /// Returns the model's triangle nearest to `t`, if it is within the limit. Of several that `t`
    /// passes through, any: the same one for the same arguments.
    ///
    /// In/out      work: if not null, the search adds to it.
    /// Accuracy    the distance is that of triangle_triangle_distance, and no triangle of the model
    ///             is nearer but for the rounding of that.
    /// Cost        best first, eight boxes at a time; some ten nodes for a triangle beside the
    ///             model.
    /// Source      the lower bound of a box is its largest gap to the triangle along the box's axes
    ///             (all three together), along the triangle's normal, and along the direction of
    ///             the closest points so far: separating axes [Gottschalk, Lin, Manocha 1996], but
    ///             only those that tell most. The normal keeps a triangle that is large beside the
    ///             model from opening all nodes in its box.
    [[nodiscard]] std::optional<Found> nearest_to(const Triangle& t, double limit,
                                                  Work* work = nullptr) const;

    [[nodiscard]] const PlacedModel& placed() const { return placed_; }

private:
    PlacedModel placed_;
    double least_stretch_; ///< of the tree's frame
    double half_ = 0;      ///< the largest coordinate of the tree's box
};

} // namespace abut
