#pragma once

#include <abut/convex.h>
#include <abut/curved_shapes.h>
#include <abut/model.h>
#include <abut/shapes.h>
#include <abut/types.h>

#include <memory>

namespace abut {

class RigidShapeData;

/// A rigid shape in its own frame, prepared once for questions to a `World`: "what is in the way of this?"
/// Copies share the data.
class RigidShape {
public:
    /// Errors      as `World::add` of the shape, without the body's name.
    /// Cost        for a convex body linear in its faces, otherwise small.
    RigidShape(
        const Model& model); // NOLINT: a model is a shape; the conversion is meant to be silent.
    RigidShape(const Convex& convex);        // NOLINT
    RigidShape(const Sphere& sphere);        // NOLINT
    RigidShape(const Capsule& capsule);      // NOLINT
    RigidShape(const Box3& box);             // NOLINT
    RigidShape(const Cylinder& cylinder);    // NOLINT
    RigidShape(const Cone& cone);            // NOLINT
    RigidShape(const Ellipsoid& ellipsoid);  // NOLINT
    RigidShape(const HalfSpace& half_space); // NOLINT

    [[nodiscard]] const RigidShapeData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const RigidShapeData> data_;
};

} // namespace abut
