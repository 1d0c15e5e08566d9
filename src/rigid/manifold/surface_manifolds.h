#pragma once

#include <abut/model_contacts.h>

namespace abut {

/// The contact manifolds of two models as surfaces: as `contact_manifolds`, but a solid that lies
/// inside the other, without a common point of their surfaces, is in no contact because of that. It
/// has manifolds only where the surfaces are within the margin.
std::vector<ModelManifold> surface_manifolds(const Model& a, const Transform& world_from_a,
                                             const Model& b, const Transform& world_from_b,
                                             const ManifoldOptions& options);

} // namespace abut
