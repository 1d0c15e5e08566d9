#pragma once

#include <abut/walk.h>

#include "walk/part_table.h"
#include "world/narrow_phase.h"

namespace abut {

/// A probe's shape, and its box in its own frame.
class ProbeData {
public:
    explicit ProbeData(BodyShape shape)
        : shape_(std::move(shape)), own_bounds_(bounds_of(shape_)) {}

    [[nodiscard]] const BodyShape& shape() const { return shape_; }
    [[nodiscard]] const Box3& own_bounds() const { return own_bounds_; }
    /// How far below the distance of boxes a distance may be.
    [[nodiscard]] double radius() const {
        const auto* rounded = std::get_if<RoundedBox>(&shape_);
        return rounded != nullptr ? rounded->radius : 0;
    }

private:
    BodyShape shape_;
    Box3 own_bounds_;
};

/// A probe at its place.
class PlacedProbe {
public:
    /// Errors      Error{bad_argument} as the queries of a walk.
    PlacedProbe(const Probe& probe, const Transform& world_from_probe);

    [[nodiscard]] PlacedBody body() const { return {data_.shape(), world_from_probe_}; }
    [[nodiscard]] const Box3& box() const { return box_; } ///< world; empty for an empty model
    [[nodiscard]] double radius() const { return data_.radius(); }
    /// Whether it is asked what lies inside of it or of parts.
    [[nodiscard]] bool asks_for_solids() const {
        return std::holds_alternative<ConvexShape>(data_.shape());
    }

private:
    const ProbeData& data_;
    const Transform& world_from_probe_;
    Box3 box_;
};

} // namespace abut
