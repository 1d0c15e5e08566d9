#pragma once

#include "rigid/model/placed_model.h"
#include "world/narrow_phase/narrow_phase.h"

#include <optional>

// Gaps of curved shapes and half-spaces with the other kinds of shape.
namespace abut {

/// A convex body, or a rounded box in the world, as a support shape.
SupportShape support_of(const ConvexShape& convex, const Transform& world_from_body);
SupportShape support_of(const RoundedBox& solid);
/// The support shape of a body in the world; none for a surface or a half-space.
std::optional<SupportShape> support_of(const PlacedBody& body);

/// A box around a solid in the world.
Box3 box_around(const SupportShape& solid);

/// The gap of two solids, ids not set.
BodyGap solid_gap(const SupportShape& a, const SupportShape& b, double upper_bound,
                  Vec3& direction);
/// The gap of a solid and a half-space, in closed form.
BodyGap solid_gap(const SupportShape& a, const PlaneShape& plane);
/// The gap of two half-spaces. They overlap without end unless their normals are opposite.
BodyGap solid_gap(const PlaneShape& a, const PlaneShape& b);

/// Whether a model's surface shares a point with a solid, or is at most `touching` from it.
bool surface_meets(const Model& model, const Transform& world_from_model, const SupportShape& solid,
                   double touching);
/// The gap of a model's surface and a solid. If they meet: 0, or with depths minus the depth of a
/// triangle that is deep in the solid (bound_only).
BodyGap surface_gap(const Model& model, const Transform& world_from_model,
                    const SupportShape& solid, double upper_bound, Depths depths);
/// Replaces the depth of a solid in a surface by the length of a motion that parts the solid from all
/// triangles that it meets, and the normal by its direction, if such a motion is found (parting_motion.h).
/// A gap of rounding size gets such a normal, too.
void part_from_surface(BodyGap& gap, const PlacedModel& model, const SupportShape& solid);
/// Returns whether a depth was asked for and is that in an open surface. This has no inside, so the depth
/// of a solid in it is how far that must move: part_from_surface tells.
bool is_in_open(const BodyGap& gap, const Model& model, Depths depths);
/// The gap of a model's surface and a half-space: that of the lowest vertex.
BodyGap surface_gap(const Model& model, const Transform& world_from_model, const PlaneShape& plane);

} // namespace abut
