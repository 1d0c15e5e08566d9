#include "rigid/solid/placed_boundary.h"

#include "rigid/solid/world_solid.h"

namespace abut {

PlacedBoundary::PlacedBoundary(const BoundarySearch& found, const Transform& world,
                               const std::optional<Vec3>& origin)
    : boundary_(found.boundary.get()), is_known_(found.is_known) {
    if (boundary_ != nullptr)
        placed_.emplace(boundary_->model, world, origin);
}

bool PlacedBoundary::is_near(const Vec3& point) const {
    if (boundary_ == nullptr)
        return true;
    const double rounding = 0x1p-40 * (placed_->reach() + max_abs(placed_->middle()));
    return nearest_point(*placed_, point, {.bound = 2 * rounding, .enough = rounding}).distance <=
           rounding;
}

} // namespace abut
