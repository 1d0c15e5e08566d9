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

/// Eight pairs of triangles, lane by lane: what one pass of the distance kernel reads.
struct alignas(64) TrianglePairBlock {
    static constexpr std::size_t kLanes = 8;
    double a[3][3][kLanes], b[3][3][kLanes]; ///< [vertex][axis][lane]

    void set(std::size_t lane, const Triangle& ta, const TriangleBlock& tb, std::size_t lane_b) {
        for (std::size_t i = 0; i < 3; ++i) {
            a[i][0][lane] = ta[i].x;
            a[i][1][lane] = ta[i].y;
            a[i][2][lane] = ta[i].z;
            for (std::size_t axis = 0; axis < 3; ++axis)
                b[i][axis][lane] = tb.v[i][axis][lane_b];
        }
    }
};

/// Lanes of `b` whose triangle may share a point with `a`: bit i for lane i.
///
/// Accuracy    conservative: a lane without its bit certainly shares none (boxes compared as they
///             are, plane sides with a certified error bound).
/// Cost        some 90 arithmetic operations for all four lanes.
std::uint32_t may_intersect(const Triangle& a, const TriangleBlock& b);

/// Two questions in one pass.
struct NearLanes {
    std::uint32_t may_intersect; ///< as above
    std::uint32_t may_be_near;   ///< lanes that may be nearer to `a` than the bound, or at it
};

/// Accuracy    conservative, both: a lane is left out if the gap of the boxes, or the distance of
///             one triangle to the other's plane, certainly exceeds the bound.
NearLanes near_lanes(const Triangle& a, const TriangleBlock& b, double bound_sq);

/// Squared distance of the pair in each lane; 0 may come out as a rounding residue where they
/// cross.
///
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    of the distance: a few roundings of the coordinates' differences; crossing triangles
///             are not recognised (their distance is that of their boundaries): test for
///             intersection first.
/// Source      minimum over 9 edge pairs and 6 vertex-face pairs, as [Larsen et al. 1999]. Differs:
///             closest points of lines by cross products, so that almost parallel edges lose
///             nothing.
void distance_sq(const TrianglePairBlock& pairs, double (&result)[TrianglePairBlock::kLanes]);

/// The same with one lane: the reference for every SIMD target.
std::uint32_t may_intersect_reference(const Triangle& a, const TriangleBlock& b);
NearLanes near_lanes_reference(const Triangle& a, const TriangleBlock& b, double bound_sq);
void distance_sq_reference(const TrianglePairBlock& pairs,
                           double (&result)[TrianglePairBlock::kLanes]);

} // namespace abut
