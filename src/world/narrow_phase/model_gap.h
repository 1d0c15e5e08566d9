#pragma once

#include <abut/model.h>
#include <abut/world.h>

#include "world/narrow_phase/narrow_phase.h"

#include <span>

namespace abut {

/// The gap of the surfaces of two models. The ids are not set.
///
/// In          upper_bound: as gap_between. depths: `yes` for models that share a point.
/// Accuracy    as `distance` of models. A depth is a bound. Where the surfaces touch, or are apart by
///             no more than rounding, the normal is across the faces and edges there.
BodyGap model_gap(const Model& a, const Transform& world_from_a, const Model& b,
                  const Transform& world_from_b, double upper_bound, Depths depths,
                  WarmStart& warm_start);

/// A distance above this share of the coordinates is not rounding.
inline constexpr double kClearOfFaces = 0x1p-40;

/// Sets the gap of a surface and a solid that touch. If the surface lies inside, clear of the solid's
/// faces, these tell no direction.
inline void set_touching(BodyGap& gap, double clear) {
    if (gap.distance > clear)
        gap.normal = {};
    gap.distance = 0;
}

/// The mean of some points. In: at least one.
Vec3 mean_of(std::span<const Vec3> points);

/// Turns the normal of a surface and a convex solid that hardly overlap: the solid lies on its side of a plane
/// that it touches, but the direction between points of a border may have come out the wrong way.
///
/// In          inside: a point of the solid. size: of the solid.
void turn_to_solid(BodyGap& gap, const Vec3& inside, double size);

} // namespace abut
