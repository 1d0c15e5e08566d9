#pragma once

#include <abut/model.h>
#include <abut/model_contacts.h>

#include "convex/support/support_shape.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Finds the contacts of a cylinder, a cone or an ellipsoid and a surface: a manifold for each direction in which
/// the solid touches it, without names of regions.
///
/// In          solid: in the world. solid_is_a: normals point from a to b. last: the names of the last step.
/// Out         a bound of the rounding of depths. None, and no manifold is added, where the centre of the
///             solid does not lie before the surface, or the solid has no extent along an axis: then the
///             shortest motion that parts the bodies has to tell it.
/// Cost        for each triangle near the solid about 0.1 us, and a distance for each edge and vertex inside it
///             that no plane holds.
std::optional<double> add_curved_on_surface(const SupportShape& solid, const Model& surface,
                                            const Transform& world_from_surface, bool solid_is_a,
                                            double margin, std::span<const std::uint64_t> last,
                                            std::vector<ModelManifold>& manifolds);

} // namespace abut
