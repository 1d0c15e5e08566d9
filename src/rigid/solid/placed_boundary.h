#pragma once

#include "rigid/model/placed_model.h"
#include "rigid/model/solid_boundary.h"

#include <cstdint>
#include <optional>

namespace abut {

/// The boundary of a solid where it is not the whole surface (SolidBoundary), under its transform.
class PlacedBoundary {
public:
    /// None: the whole surface is the boundary, or it is not known.
    PlacedBoundary() = default;
    /// In          found: outlives this.
    PlacedBoundary(const BoundarySearch& found, const Transform& world,
                   const std::optional<Vec3>& origin);

    /// Null if there is none.
    [[nodiscard]] const SolidBoundary* get() const { return boundary_; }
    [[nodiscard]] bool is_known() const { return is_known_; }
    /// In          there is one.
    [[nodiscard]] const PlacedModel& placed() const { return *placed_; }
    /// The mesh's triangle in a slot of the boundary's tree.
    [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const {
        return boundary_->source[placed_->data().triangle_at(slot)];
    }
    /// Returns whether a point of the surface lies on the boundary, to rounding: where faces are cut,
    /// the boundary is off by that.
    [[nodiscard]] bool is_near(const Vec3& point) const;

private:
    const SolidBoundary* boundary_ = nullptr;
    bool is_known_ = true;
    std::optional<PlacedModel> placed_;
};

} // namespace abut
