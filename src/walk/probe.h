#pragma once

#include <abut/walk.h>

#include "walk/part_table.h"
#include "world/narrow_phase/narrow_phase.h"

namespace abut {

/// A probe's shape and its box, both in the probe's frame.
class ProbeData {
public:
    explicit ProbeData(BodyShape shape);

    [[nodiscard]] const BodyShape& shape() const { return shape_; }
    [[nodiscard]] const Box3& own_bounds() const { return own_bounds_; }
    /// The surface that moves. For a sphere or capsule: its centre or axis, as a triangle without
    /// area; contact is a distance of radius().
    [[nodiscard]] const Model& surface() const { return surface_; }
    /// Whether a part may lie inside the shape without being near `surface()`.
    [[nodiscard]] bool has_inside() const { return has_inside_; }
    /// The radius of a sphere or capsule, else 0. A signed distance may be as low as -radius().
    [[nodiscard]] double radius() const {
        const auto* rounded = std::get_if<RoundedBox>(&shape_);
        return rounded != nullptr ? rounded->radius : 0;
    }

private:
    BodyShape shape_;
    Box3 own_bounds_;
    Model surface_;
    bool has_inside_;
};

/// A probe with its transform. Both must outlive it.
class PlacedProbe {
public:
    /// Errors      Error{bad_argument}, as for the queries of a walk.
    PlacedProbe(const Probe& probe, const Transform& world_from_probe);

    [[nodiscard]] const ProbeData& data() const { return data_; }
    [[nodiscard]] PlacedBody body() const { return {data_.shape(), world_from_probe_}; }
    [[nodiscard]] const Box3& box() const { return box_; } ///< world; empty for an empty model
    [[nodiscard]] double radius() const { return data_.radius(); }
    /// Whether queries with this probe use the models of parts as solids.
    [[nodiscard]] bool asks_for_solids() const {
        return std::holds_alternative<ConvexShape>(data_.shape());
    }

private:
    const ProbeData& data_;
    const Transform& world_from_probe_;
    Box3 box_;
};

} // namespace abut
