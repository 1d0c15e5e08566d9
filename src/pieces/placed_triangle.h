#pragma once

#include "math/transform.h"
#include "math/vector.h"
#include "pieces/pieces_data.h"

#include <cstdint>
#include <vector>

namespace abut {

/// A triangle of a solid in the world, by the formula of abut/types.h.
struct PlacedTriangle {
    Triangle corners;
    Box3 box;
    std::uint32_t number = 0; ///< in the solid's mesh
};

inline std::vector<PlacedTriangle> placed_triangles(const ConvexPiecesData& solid,
                                                    std::uint32_t piece, const Transform& world) {
    std::vector<PlacedTriangle> result;
    for (const std::uint32_t t : solid.triangles_of(piece)) {
        PlacedTriangle& placed = result.emplace_back();
        placed.number = t;
        for (std::size_t k = 0; k < 3; ++k) {
            placed.corners[k] = apply(world, solid.mesh().positions[solid.mesh().triangles[t][k]]);
            extend(placed.box, placed.corners[k]);
        }
    }
    return result;
}

} // namespace abut
