#pragma once

#include <abut/rigid_shape.h>

#include "math/vector.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace abut {

/// Where a point or a triangle is nearest to a body, or deepest in it.
struct PlaceNearBody {
    double distance = 0; ///< negative inside a solid
    Vec3 point;          ///< of the point or triangle that was asked for
    Vec3 on_body;
    Vec3 normal;                ///< unit vector out of the body
    std::uint32_t triangle = 0; ///< of a model
};

/// Measures the signed distance of points and triangles from a rigid body in the world.
class BodyGaps {
public:
    BodyGaps() = default;
    BodyGaps(const BodyGaps&) = delete;
    BodyGaps& operator=(const BodyGaps&) = delete;
    virtual ~BodyGaps() = default;

    /// Nothing if the point is farther than the limit.
    [[nodiscard]] virtual std::optional<PlaceNearBody> of_point(const Vec3& point,
                                                                double limit) const = 0;
    /// Nothing if the triangle is farther than the limit, or if its vertices tell all.
    [[nodiscard]] virtual std::optional<PlaceNearBody> of_triangle(const Triangle& triangle,
                                                                   double limit) const = 0;
    /// Encloses the body; infinite for a half-space.
    [[nodiscard]] const Box3& bounds() const { return bounds_; }

protected:
    explicit BodyGaps(const Box3& bounds) : bounds_(bounds) {}

private:
    Box3 bounds_;
};

/// In: body, which must outlive the result.
std::unique_ptr<const BodyGaps> make_body_gaps(const RigidShape& body,
                                               const Transform& world_from_body);

} // namespace abut
