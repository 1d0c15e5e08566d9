#pragma once

#include "math/vector.h"

#include <cstddef>
#include <cstdint>

namespace abut {

/// Up to four triangles, lane by lane: what one SIMD pass over a leaf reads. Unused lanes repeat a
/// used one.
struct alignas(32) TriangleBlock {
    static constexpr std::size_t kLanes = 4;
    double v[3][3][kLanes]; ///< [vertex][axis][lane]

    void set(std::size_t lane, const Triangle& t) {
        for (std::size_t i = 0; i < 3; ++i) {
            v[i][0][lane] = t[i].x;
            v[i][1][lane] = t[i].y;
            v[i][2][lane] = t[i].z;
        }
    }
    [[nodiscard]] Triangle get(std::size_t lane) const {
        Triangle t;
        for (std::size_t i = 0; i < 3; ++i)
            t[i] = {v[i][0][lane], v[i][1][lane], v[i][2][lane]};
        return t;
    }
};

/// Lanes of `b` whose triangle may share a point with `a`: bit i for lane i.
///
/// Accuracy    conservative: a lane without its bit certainly shares none (boxes compared as they
/// are, plane sides
///             with a certified error bound).
/// Cost        some 90 arithmetic operations for all four lanes.
std::uint32_t may_intersect(const Triangle& a, const TriangleBlock& b);

/// Squared distance of `a` to the triangle in each lane; 0 may come out as a rounding residue where
/// they cross.
///
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    of the distance: a few roundings of the coordinates' differences; crossing triangles
/// are not
///             recognised (their distance is that of their boundaries): test for intersection
///             first.
/// Source      minimum over 9 edge pairs and 6 vertex-face pairs, as [Larsen et al. 1999]. Differs:
/// closest points
///             of lines by cross products, so that almost parallel edges lose nothing.
void distance_sq(const Triangle& a, const TriangleBlock& b,
                 double (&result)[TriangleBlock::kLanes]);

/// The same with one lane: the reference for every SIMD target.
std::uint32_t may_intersect_reference(const Triangle& a, const TriangleBlock& b);
void distance_sq_reference(const Triangle& a, const TriangleBlock& b,
                           double (&result)[TriangleBlock::kLanes]);

} // namespace abut
