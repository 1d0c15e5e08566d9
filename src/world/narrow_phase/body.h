#pragma once

#include <abut/convex.h>
#include <abut/deformable.h>
#include <abut/model.h>
#include <abut/shapes.h>
#include <abut/types.h>
#include <abut/world.h>

#include "convex/support/support_shape.h"
#include "geometry/rounded_box_distance.h"
#include "world/narrow_phase/face_table.h"

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

namespace abut {

/// A deformable surface as it was at the start of its step when it was first used after a refresh.
class Snapshot {
public:
    explicit Snapshot(std::shared_ptr<const Deformable> surface) : surface_(std::move(surface)) {}
    [[nodiscard]] const Model& model() const;

private:
    std::shared_ptr<const Deformable> surface_;
    mutable std::once_flag once_;
    mutable std::optional<Model> model_;
};

/// A deformable surface. Each of its steps gets a new snapshot.
struct DeformableShape {
    std::shared_ptr<const Deformable> surface;
    std::shared_ptr<const Snapshot> snapshot;
};

/// A convex body, its surface for queries with models, and its faces for contacts.
struct ConvexShape {
    Convex solid;
    Model surface;
    std::shared_ptr<const FaceTable> faces;
};

/// A cylinder, a cone or an ellipsoid.
struct CurvedShape {
    SupportShape solid;
};

/// A half-space whose normal is of unit length.
struct PlaneShape {
    Vec3 point; ///< of its plane
    Vec3 normal;
};

/// The shape of a body, in the body's frame.
using BodyShape =
    std::variant<Model, ConvexShape, RoundedBox, DeformableShape, CurvedShape, PlaneShape>;

inline bool is_half_space(const BodyShape& shape) {
    return std::holds_alternative<PlaneShape>(shape);
}
inline bool is_deformable(const BodyShape& shape) {
    return std::holds_alternative<DeformableShape>(shape);
}

/// All overloads throw Error{bad_argument} if a value is not finite or out of range.
BodyShape shape_of(const Convex& convex);
BodyShape shape_of(const Sphere& sphere);
BodyShape shape_of(const Capsule& capsule);
BodyShape shape_of(const Box3& box);
BodyShape shape_of(const Cylinder& cylinder);
BodyShape shape_of(const Cone& cone);
BodyShape shape_of(const Ellipsoid& ellipsoid);
BodyShape shape_of(const HalfSpace& half_space);
BodyShape shape_of(std::shared_ptr<const Deformable> surface);

/// Places a box in the world, in memory that has its sizes already.
void place(RoundedBox& in_world, const RoundedBox& box, const Transform& world_from_body);
/// The shape under a rotation and translation, in the world.
RoundedBox placed(const RoundedBox& box, const Transform& world_from_body);
SupportShape placed(const CurvedShape& curved, const Transform& world_from_body);
PlaneShape placed(const PlaneShape& plane, const Transform& world_from_body);

/// The number of axes on which a box has an extent: 0 for a ball, 1 for a capsule.
int dimension(const RoundedBox& box);
/// The axis of a capsule.
Segment axis_of(const RoundedBox& capsule);

/// The box of a shape in its own frame; empty for a model without triangles. That of a half-space is
/// infinite.
Box3 bounds_of(const BodyShape& shape);
/// A box that encloses a rounded box, rounding included.
Box3 bounds_of(const RoundedBox& box);
/// A box that encloses the shape under its transform, rounding included.
Box3 bounds_of(const BodyShape& shape, const Box3& own_bounds, const Transform& world_from_body);
/// A box that encloses all points of a box under any transform, rounding included. In: not empty.
Box3 placed_bounds(const Box3& own_bounds, const Transform& world_from_body);
/// Upper bound of the distance of the shape's points from a point of its frame. Infinite for a
/// half-space.
double reach_from(const BodyShape& shape, const Box3& own_bounds, const Vec3& point);

} // namespace abut
