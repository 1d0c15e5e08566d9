#pragma once

#include "math/vector.h"

#include <cstddef>

namespace abut {

/// A batch of eight pairs of triangles, one per lane: the input of one pass of the distance kernel.
struct alignas(64) TrianglePairBatch {
    static constexpr std::size_t kLanes = 8;
    double a[3][3][kLanes], b[3][3][kLanes]; ///< [vertex][axis][lane]

    void set(std::size_t lane, const Triangle& ta, const Triangle& tb) {
        for (std::size_t i = 0; i < 3; ++i) {
            a[i][0][lane] = ta[i].x;
            a[i][1][lane] = ta[i].y;
            a[i][2][lane] = ta[i].z;
            b[i][0][lane] = tb[i].x;
            b[i][1][lane] = tb[i].y;
            b[i][2][lane] = tb[i].z;
        }
    }
    [[nodiscard]] Triangle get_a(std::size_t lane) const { return get(a, lane); }
    [[nodiscard]] Triangle get_b(std::size_t lane) const { return get(b, lane); }

private:
    static Triangle get(const double (&v)[3][3][kLanes], std::size_t lane) {
        Triangle t;
        for (std::size_t i = 0; i < 3; ++i)
            t[i] = {v[i][0][lane], v[i][1][lane], v[i][2][lane]};
        return t;
    }
};

/// A pair's computed distance, the root of distance_sq's result, exceeds the true distance by at
/// most
///
///     kTrianglePairError (r + u + v) + kTrianglePairUnderflow
///
/// where r is the largest difference of a vertex of a and one of b, and u and v are the longest
/// edges. docs/distance.md has the proof. The largest error found in trials is 2 % of the bound.
constexpr double kTrianglePairError = 32 * 0x1p-53, kTrianglePairUnderflow = 0x1p-240;

/// Squared distance of the pair in each lane. For a crossing pair, a rounding residue may be
/// returned instead of 0.
///
/// Degenerate  zero-area triangles act as segments or points.
/// Accuracy    of the distance: a few roundings of the coordinates' differences. Crossing triangles
///             are not recognised, their distance is that of their boundaries: test for
///             intersection first.
/// Source      minimum over 9 edge pairs and 6 vertex-face pairs, as [Larsen et al. 1999]. Differs:
///             closest points of lines by cross products, so that almost parallel edges lose no
///             precision.
void distance_sq(const TrianglePairBatch& pairs, double (&result)[TrianglePairBatch::kLanes]);

/// The nearest points of eight pairs of triangles, one per lane.
struct alignas(64) PairPoints {
    double distance_sq[TrianglePairBatch::kLanes];
    double on_a[3][TrianglePairBatch::kLanes], gap[3][TrianglePairBatch::kLanes]; ///< [axis][lane]

    [[nodiscard]] Vec3 get_on_a(std::size_t lane) const {
        return {on_a[0][lane], on_a[1][lane], on_a[2][lane]};
    }
    /// From the point of a to that of b.
    [[nodiscard]] Vec3 get_gap(std::size_t lane) const {
        return {gap[0][lane], gap[1][lane], gap[2][lane]};
    }
};

/// As distance_sq, with the points. Of several that are as near, those found first.
void nearest_points(const TrianglePairBatch& pairs, PairPoints& result);

/// nearest_points with one lane: the reference for every SIMD target.
void nearest_points_reference(const TrianglePairBatch& pairs, PairPoints& result);

/// distance_sq with one lane: the reference for every SIMD target.
void distance_sq_reference(const TrianglePairBatch& pairs,
                           double (&result)[TrianglePairBatch::kLanes]);

} // namespace abut
