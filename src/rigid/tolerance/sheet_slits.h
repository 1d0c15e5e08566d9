#pragma once

#include "rigid/tolerance/sheet.h"

#include <span>
#include <utility>

namespace abut {

/// Cuts slits into one of two crossing surfaces where the other one's border passes through it. So
/// what lies beyond the other surface no longer hangs together with what lies beside its border.
///
/// A slit lies in the plane through the border's edge, upright to the other surface. It reaches twice
/// the tolerance to both sides.
///
/// In          crossings: pairs of a border edge's triangle of `other` and a triangle of `sheet` that
///             the edge passes through; edge: the edge's first corner in that triangle. `width`:
///             more than the rounding of positions, and far less than the tolerance.
/// Cost        O(slits x triangles). More slits than 1,000 are not cut: then what hangs together is
///             more.
struct BorderCrossing {
    Triangle border; ///< the triangle at the border
    std::size_t edge = 0;
    std::uint32_t crossed = 0;
};
void cut_slits(Sheet& sheet, std::span<const BorderCrossing> crossings, double tolerance,
               double width);

} // namespace abut
