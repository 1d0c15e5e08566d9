#pragma once

#include "math/vector.h"

#include <cstdint>
#include <vector>

namespace abut {

struct Polytope;

/// For each cell of a grid over all directions, on the faces of a cube, the vertex that is farthest
/// along the cell's middle: where to begin to climb.
///
/// Source      [Ehmann, Lin 2000] (SWIFT). Differs: cells on a cube.
class NormalTable {
public:
    NormalTable() = default;
    /// Of 6 resolution^2 cells.
    NormalTable(const Polytope& polytope, std::uint32_t resolution);

    /// In          any direction; of any length, zero included. A table without cells says 0.
    [[nodiscard]] std::uint32_t vertex(const Vec3& direction) const;
    /// One vertex a cell, in the order of the cells.
    [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return vertices_; }

private:
    [[nodiscard]] std::size_t cell(std::uint32_t axis, double along, double u, double v) const;

    std::uint32_t resolution_ = 1;
    std::vector<std::uint32_t> vertices_;
};

} // namespace abut
