#pragma once

#include <abut/rigid_shape.h>

#include "world/narrow_phase/body.h"

#include <utility>

namespace abut {

/// A shape as a world's queries take it.
class RigidShapeData {
public:
    explicit RigidShapeData(BodyShape value)
        : shape(std::move(value)), own_bounds(bounds_of(shape)) {}

    BodyShape shape;
    Box3 own_bounds;
};

} // namespace abut
