#pragma once

#include "view/simplify/level_surface.h"

#include <cstdint>

namespace abut {

struct SimplifiedSurface {
    LevelSurface surface; ///< its errors include those of the given surface
    /// At least the errors of all parts and the sizes of the pieces that were left out. A piece is a
    /// set of triangles of one part that are connected through vertices; its size is the diagonal of
    /// its box, enlarged on both sides by the error that it had.
    double error = 0;
};

/// Makes fewer triangles of a surface, with the least error that the pieces allow. Vertices keep
/// their places and normals; most are removed. A piece may become a tetrahedron (stick.h), or be left
/// out where another one is near all of it (piece_choice.h).
///
/// In          target: triangles that the result may have.
/// Accuracy    the errors are proven bounds of distances, see deviation.h. They are larger where the
///             shade differs, see shading.h.
/// Source      edge collapse by quadrics [Garland, Heckbert 1997], by meshoptimizer. It gives each
///             piece several versions, whose errors are then bounded. Of each piece the coarsest
///             version within the common error is taken.
SimplifiedSurface simplify(const LevelSurface& surface, std::uint32_t target);

} // namespace abut
