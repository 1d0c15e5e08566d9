#pragma once

#include <abut/elementary_impact.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// A batch of eight pairs of features of one kind at rest, one per lane: the input of one pass of
/// near_filter. Lanes that are not set hold points at the origin.
struct alignas(64) NearBatch {
    static constexpr std::size_t kLanes = 8;
    double v[4][3][kLanes] = {}; ///< [vertex][axis][lane]
    double limit[kLanes] = {};   ///< a length for each pair, at least 0

    void set(std::size_t lane, const std::array<Vec3, 4>& points, double most) {
        for (std::size_t i = 0; i < 4; ++i) {
            v[i][0][lane] = points[i].x;
            v[i][1][lane] = points[i].y;
            v[i][2][lane] = points[i].z;
        }
        limit[lane] = most;
    }
};

/// What near_filter has proven: a bit for each lane.
struct NearBits {
    std::uint32_t possible = 0; ///< without a bit: farther apart than the limit
    std::uint32_t certain = 0;  ///< within the limit; these are possible, too

    friend bool operator==(const NearBits&, const NearBits&) = default;
};

/// Tells which features of a batch are within their limits of each other.
///
/// In          finite coordinates of any size, in the order of ElementaryPair; the kind of all lanes.
/// Accuracy    certified: what is said is true, whatever rounds, overflows or underflows, with or
///             without fused operations. A lane that is possible and not certain is undecided. That
///             is rare unless the distance is within some 1e-14 of the features' size of the limit;
///             needles and nearly parallel edges excepted.
/// Cost        some 10 ns a pair (AVX2, a full batch); less if boxes tell all pairs apart.
/// Source      approximate closest points bound the distance from above. Their direction bounds it
///             from below, by how far all vertices are apart along it, as in nearest_on_patch.
///             Closest points as [Ericson 2005, 5.1.5 and 5.1.9]. Differs: all cases are computed,
///             without branches.
NearBits near_filter(const NearBatch& batch, ElementaryKind kind);

/// near_filter with one lane at a time: the reference for every SIMD target.
NearBits near_filter_reference(const NearBatch& batch, ElementaryKind kind);

} // namespace abut
