#pragma once

#include <abut/contacts.h>
#include <abut/model.h>
#include <abut/shapes.h>

#include "math/vector.h"
#include "world/contacts/solid_contacts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace abut {

/// Names of the points of a capsule's contact with a surface.
enum class CapsulePoint : std::uint8_t { middle = 0, end_a = 1, end_b = 2 };

/// Returns whether the normal of a ball at an end is within 26 degrees of the capsule's.
inline bool leads_same_way(const Vec3& normal_of_end, const Vec3& normal) {
    constexpr double kCosOfSameWay = 0.9;
    return dot(normal_of_end, normal) >= kCosOfSameWay;
}

/// The direction opposite to that from an end of a capsule's axis to the point of its surface below the end:
/// below the higher end of a capsule that leans is its side, not the ball. Zero if the capsule stands upright.
///
/// In          inwards: from the end to the other one. up: the contact's normal, towards the capsule.
inline Vec3 outwards_at_end(const Vec3& inwards, const Vec3& up) {
    const Vec3 along = normalized_or_zero(inwards);
    return normalized_or_zero(up - std::min(dot(up, along), 0.0) * along);
}

/// The contacts of the balls at both ends of a capsule with a surface; none where a ball is farther from it
/// than the margin, or does not lead the same way as the contact's normal.
///
/// In          the capsule in the world. normal: from a to b.
std::array<std::optional<ContactPoint>, 2>
contacts_of_ends(const Model& surface, const Transform& world_from_surface, const Capsule& capsule,
                 bool capsule_is_a, const Vec3& normal, const ContactLimits& limits);

/// Parts of a capsule's length. A point of its axis that is deeper than its ends, or than the line between
/// their depths, by less is one of a line that lies flat, whose place rounding decides.
inline constexpr double kDeeperThanEnds = 0x1p-20;

/// Adds the ends of a capsule on a surface to their contact, which has the deepest point. That is left out
/// if an end is as deep: along a flat surface, all points of the axis are. Then a place between the ends
/// takes its place, if one carries the capsule, as a ridge does.
///
/// In          axis: in the world. between: a place that is clearly deeper than the line between the ends.
/// Out         up to three points, the deepest first.
void add_capsule_ends(const Segment& axis,
                      const std::array<std::optional<ContactPoint>, 2>& contacts_of_ends,
                      const std::optional<ContactPoint>& between, bool capsule_is_a,
                      ContactManifold& manifold);

} // namespace abut
