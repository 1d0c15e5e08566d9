#pragma once

#include <abut/view.h>

#include "view/simplify/level_surface.h"

#include <cstdint>

namespace abut {

/// A chunk, and what its parts' numbers stand for.
struct PartChunk {
    ViewChunk chunk;                  ///< ChunkVertex::part is an index in `parts`
    std::vector<std::int64_t> parts;  ///< rows of the table `part`, ascending
    std::vector<std::uint8_t> errors; ///< by part: code of LevelSurface::errors
    float resting = 0;                ///< at least LevelSurface::resting, with the rounding
};

/// The least code whose error is at least this; codes are an eighth of a power of two apart.
std::uint8_t code_of_error(double error);
double error_of_code(std::uint8_t code);

/// The grid of a chunk's positions. Its step is a power of two, and its points are multiples of the
/// step: they are floats, and chunks with one step share their points.
struct ChunkGrid {
    std::array<std::int64_t, 3> lower{}; ///< in steps
    int exponent = 0;                    ///< the step is 2^exponent

    [[nodiscard]] double step() const;
    /// No position moves farther than this.
    [[nodiscard]] double error() const;
};

/// The finest grid with 65,536 points an axis that encloses a box, and whose exponent is at least
/// this.
ChunkGrid grid_of(const Box3& box, int least_exponent);

/// Rounds a surface to a grid that encloses it. Vertices that become equal are one, and parts
/// without triangles are left out. The errors of parts include the rounding. Triangles of closed
/// surfaces come first.
///
/// In          keep_flat: whether triangles are kept that have become degenerate.
PartChunk quantise(const LevelSurface& surface, const ChunkGrid& grid, bool keep_flat);

/// The surface of a chunk: exactly the positions that are drawn.
LevelSurface surface_of(const PartChunk& chunk);

} // namespace abut
