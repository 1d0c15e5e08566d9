#pragma once

#include "math/vector.h"
#include "rigid/pair/placed_pair.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace abut {

/// A frame in the gap between two models: the z axis leads across the gap, the origin lies in it or on
/// a model. Positions relative to it are in double precision, so the height of a surface above another
/// one is known to rounding however far apart they are.
class GapFrame {
public:
    /// A direction that is zero or not finite gives the axes of the world.
    GapFrame(const Vec3& origin, const Vec3& across);
    /// The frame at the closest points of a triangle of a and one of b, which are apart. Across a gap
    /// that is short beside the triangles, the difference of the points is a poor direction. So the z
    /// axis is the normal of the features that the points lie on, if they have one.
    static GapFrame between(const Triangle& a, const Triangle& b);

    [[nodiscard]] Vec3 seen(const Vec3& world) const {
        const Vec3 r = world - origin_;
        return {dot(axes_[0], r), dot(axes_[1], r), dot(axes_[2], r)};
    }
    [[nodiscard]] double height(const Vec3& world) const { return dot(axes_[2], world - origin_); }

private:
    Vec3 origin_;
    std::array<Vec3, 3> axes_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// Rounds down the length of a gap that was computed from coordinates in a GapFrame, to a proven lower
/// bound. `sizes`: the largest distance of a vertex of a from the frame's origin, plus that of b.
///
/// Accuracy    with u = 2^-53: a coordinate is a sum of three products of differences, so it is off by
///             less than 5 u times the vertex's distance from the origin. The three gaps along the axes
///             are off by at most 9 u sizes together. The axes are orthonormal to 8 u, so a vector is
///             at most 12 u longer in the frame than in the world; squares, their sum and its root
///             round by 4 u. 2^-240 exceeds what underflow takes from a product.
inline double certain_gap(double computed, double sizes) {
    constexpr double kCoordinates = 16 * 0x1p-53, kLength = 32 * 0x1p-53,
                     kProductUnderflow = 0x1p-240;
    return computed * (1 - kLength) - kCoordinates * sizes - kProductUnderflow;
}

/// Computes how far apart the models lie along the frame's z axis: the lowest vertex of b less the
/// highest one of a. `least_of_b` is the height of some point of b. Calls enough(gap) with gaps that decrease to the result. Stops and returns false as
/// soon as that is false.
///
/// Cost        reads each vertex once, or ends at the first of those in the way.
template <typename Enough>
bool are_apart_along(const PlacedPair& pair, const GapFrame& frame, double least_of_b,
                     const Enough& enough) {
    // So many vertices at once that a look costs little beside them.
    constexpr std::size_t kAtOnce = 64;
    double highest = -std::numeric_limits<double>::infinity(), lowest = least_of_b;
    const auto all = [&](const ModelData& model, const Transform& world, const auto& take) {
        // Vertices that no triangle uses are looked at, too: they can only hide a gap.
        const std::vector<Vec3>& vertices = model.mesh().positions;
        for (std::size_t first = 0; first < vertices.size(); first += kAtOnce) {
            const std::size_t end = std::min(first + kAtOnce, vertices.size());
            for (std::size_t i = first; i < end; ++i)
                take(frame.height(apply(world, vertices[i])));
            if (!enough(lowest - highest))
                return false;
        }
        return true;
    };
    return all(pair.a(), pair.world_from_a(),
               [&](double height) { highest = std::max(highest, height); }) &&
           all(pair.b(), pair.world_from_b(),
               [&](double height) { lowest = std::min(lowest, height); });
}

} // namespace abut
