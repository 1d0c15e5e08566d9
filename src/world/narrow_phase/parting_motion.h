#pragma once

#include "convex/support/support_shape.h"
#include "rigid/model/placed_model.h"

#include <cstdint>
#include <optional>

namespace abut {

/// A motion that parts a solid from the triangles of a surface that it meets.
struct PartingMotion {
    Vec3 direction;             ///< unit vector from the surface to the solid, which moves along it
    double length = 0;          ///< not negative
    Vec3 point;                 ///< of the solid; after the motion, it lies on the surface
    std::uint32_t triangle = 0; ///< the one that holds that place
};

/// Finds a short motion that parts a solid from all triangles that it meets: along one of their normals,
/// the mean of these, or a known direction. The depth in a single triangle may be less, but leads sideways:
/// over the border to a neighbour in the same plane.
///
/// In          known: the depth in one triangle. If a motion by it parts all, and no other is as short,
///             nothing is returned. Nor is anything if the solid meets more than 64 triangles.
///             touching: triangles no farther away count as met.
std::optional<PartingMotion> find_parting_motion(const PlacedModel& model,
                                                 const SupportShape& solid,
                                                 const PartingMotion& known, double touching);

} // namespace abut
