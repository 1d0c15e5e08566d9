#pragma once

#include "ccd/difference_patch.h"

#include <algorithm>
#include <cmath>

/// The patch of difference_patch.h in double precision.
namespace abut {

/// A vector in linear motion. Its coordinates at both ends are differences of two doubles, each
/// rounded once.
struct LinearVec3 {
    Vec3 start, end;
    double size; ///< largest coordinate at both ends

    LinearVec3(const ElementaryPair& pair, const VertexDifference& d)
        : start(pair.start[d.to] - pair.start[d.from]), end(pair.end[d.to] - pair.end[d.from]),
          size(std::max(max_abs(start), max_abs(end))) {}

    [[nodiscard]] Vec3 at(double t) const { return (1 - t) * start + t * end; }
};

/// The moving patch corner + x side_x + y side_y.
struct RoundedPatch {
    LinearVec3 corner, side_x, side_y;

    explicit RoundedPatch(const ElementaryPair& pair)
        : RoundedPatch(pair, patch_layout(pair.kind)) {}

private:
    RoundedPatch(const ElementaryPair& pair, const PatchLayout& layout)
        : corner(pair, layout.corner), side_x(pair, layout.side_x), side_y(pair, layout.side_y) {}
};

} // namespace abut
