#pragma once

#include "view/levels/level_surface.h"

#include <cstdint>

namespace abut {

struct SimplifiedSurface {
    LevelSurface surface;
    /// The largest piece that was left out. A piece is a set of triangles of one part that are
    /// connected through vertices; its size is the diagonal of its box.
    double left_out = 0;
    double estimate = 0; ///< of the distance between the surfaces; not a bound
};

/// Makes fewer triangles of a surface. Vertices keep their places and normals; most are removed.
///
/// In          target: triangles to reach; the result may have more if the pieces do not allow it.
/// Cost        O(n log n).
/// Source      edge collapse by quadrics [Garland, Heckbert 1997], by meshoptimizer.
SimplifiedSurface simplify(const LevelSurface& surface, std::uint32_t target);

} // namespace abut
