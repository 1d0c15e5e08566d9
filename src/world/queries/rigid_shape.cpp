#include <abut/rigid_shape.h>

#include "world/queries/rigid_shape_data.h"

#include <utility>

namespace abut {

namespace {

std::shared_ptr<const RigidShapeData> shape_data(BodyShape shape) {
    return std::make_shared<const RigidShapeData>(std::move(shape));
}

} // namespace

RigidShape::RigidShape(const Model& model) : data_(shape_data(BodyShape(model))) {}
RigidShape::RigidShape(const Convex& convex) : data_(shape_data(shape_of(convex))) {}
RigidShape::RigidShape(const Sphere& sphere) : data_(shape_data(shape_of(sphere))) {}
RigidShape::RigidShape(const Capsule& capsule) : data_(shape_data(shape_of(capsule))) {}
RigidShape::RigidShape(const Box3& box) : data_(shape_data(shape_of(box))) {}
RigidShape::RigidShape(const Cylinder& cylinder) : data_(shape_data(shape_of(cylinder))) {}
RigidShape::RigidShape(const Cone& cone) : data_(shape_data(shape_of(cone))) {}
RigidShape::RigidShape(const Ellipsoid& ellipsoid) : data_(shape_data(shape_of(ellipsoid))) {}
RigidShape::RigidShape(const HalfSpace& half_space) : data_(shape_data(shape_of(half_space))) {}

} // namespace abut
