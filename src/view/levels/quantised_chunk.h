#pragma once

#include <abut/view.h>

#include "view/levels/level_surface.h"

#include <cstdint>

namespace abut {

/// A chunk, and what its parts' numbers stand for.
struct PartChunk {
    ViewChunk chunk;                 ///< ChunkVertex::part is an index in `parts`
    std::vector<std::int64_t> parts; ///< rows of the table `part`, ascending
};

/// The grid of a chunk's positions. Its step is a power of two, and its points are multiples of the
/// step: they are floats, and chunks with one step share their points.
struct ChunkGrid {
    std::array<std::int64_t, 3> lower{}; ///< in steps
    int exponent = 0;                    ///< the step is 2^exponent

    [[nodiscard]] double step() const;
    /// No position moves farther than this.
    [[nodiscard]] double error() const;
};

/// The finest grid with 65,536 points an axis that encloses a box.
///
/// In          coarsest: least exponent that the grid may have.
ChunkGrid grid_of(const Box3& box, int least_exponent);

/// Rounds a surface to a grid that encloses it. Vertices that become equal are one.
///
/// In          keep_flat: whether triangles are kept that have become degenerate.
PartChunk quantise(const LevelSurface& surface, const ChunkGrid& grid, bool keep_flat);

/// The surface of a chunk: exactly the positions that are drawn.
LevelSurface surface_of(const PartChunk& chunk);

} // namespace abut
