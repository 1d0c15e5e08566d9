#pragma once

#include <abut/scene.h>

namespace abut {

/// A vertex in world coordinates: the formula of Transform, left to right, without fused
/// operations.
inline Vec3 world_position(const Transform& t, const Vec3& p) {
    return {t.m[0] * p.x + t.m[3] * p.y + t.m[6] * p.z + t.m[9],
            t.m[1] * p.x + t.m[4] * p.y + t.m[7] * p.z + t.m[10],
            t.m[2] * p.x + t.m[5] * p.y + t.m[8] * p.z + t.m[11]};
}

/// Whether one triangle at least, in world coordinates, is not exactly degenerate (its vertices
/// collinear or equal).
///
/// Degenerate  decided exactly: a filter with a proven bound, then rational numbers.
/// Errors      none; indices are in range and coordinates finite.
/// Cost        ends at the first such triangle: the first of all in any usual file.
bool any_triangle_has_area(const Scene& scene);

} // namespace abut
