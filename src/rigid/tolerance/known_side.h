#pragma once

#include "rigid/solid/world_solid.h"

#include <optional>

namespace abut {

/// On which side of a surface a point lies that was tested.
struct KnownSide {
    Vec3 point;
    std::optional<bool> inside;
};

/// Tells the side of a point off the surface, from that of the last point: fast if it is near.
inline bool is_inside(const WorldSolid& surface, const Vec3& point, KnownSide& known) {
    const bool inside = known.inside
                            ? surface.contains_off_surface(point, known.point, *known.inside)
                            : surface.contains_off_surface(point);
    known = {point, inside};
    return inside;
}

} // namespace abut
