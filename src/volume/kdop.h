#pragma once

#include "math/vector.h"
#include "volume/relative_pose.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace abut {

/// The normals of a k-DOP's slabs: the coordinate axes, then the diagonals of the cube's faces (k =
/// 18 and 26), then the diagonals of the cube (k = 14 and 26).
template <std::size_t k>
constexpr std::array<std::array<int, 3>, k / 2> kdop_normals() {
    static_assert(k == 14 || k == 18 || k == 26);
    using Normal = std::array<int, 3>;
    constexpr std::array<Normal, 3> kAxes{Normal{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    constexpr std::array<Normal, 6> kFaceDiagonals{Normal{0, 1, 1}, {0, 1, -1}, {1, 0, 1},
                                                   {1, 0, -1},      {1, 1, 0},  {1, -1, 0}};
    constexpr std::array<Normal, 4> kCubeDiagonals{
        Normal{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
    std::array<Normal, k / 2> normals{};
    auto next = std::copy(kAxes.begin(), kAxes.end(), normals.begin());
    if (k != 14)
        next = std::copy(kFaceDiagonals.begin(), kFaceDiagonals.end(), next);
    if (k != 18)
        std::copy(kCubeDiagonals.begin(), kCubeDiagonals.end(), next);
    return normals;
}

template <std::size_t k>
struct KdopMap;
template <std::size_t k>
struct KdopImage;

/// Discrete oriented polytope: lower_i <= normal_i . x <= upper_i for k / 2 fixed normals.
template <std::size_t k>
struct Kdop {
    static constexpr std::size_t kSlabs = k / 2, kFloats = k;
    static constexpr auto kNormals = kdop_normals<k>();
    using Map = KdopMap<k>;
    using Image = KdopImage<k>;

    std::array<float, kSlabs> lower{}, upper{};

    /// In          at least one triangle, finite; each coordinate may be off by `margin`.
    /// Accuracy    encloses the triangles: every bound is rounded outward.
    /// Source      [Klosowski et al. 1998].
    static Kdop fit(std::span<const Triangle> triangles, double margin = 0);

    /// The smallest k-DOP around both.
    static Kdop merge(const Kdop& a, const Kdop& b);

    /// Upper bound of the distance of the volume's points from the frame's origin.
    [[nodiscard]] double reach() const;
    /// Upper bound of the distance of the volume's points from the centre of its first three slabs.
    [[nodiscard]] float circumradius() const;
};

using Kdop14 = Kdop<14>;
using Kdop18 = Kdop<18>;
using Kdop26 = Kdop<26>;

extern template struct Kdop<14>;
extern template struct Kdop<18>;
extern template struct Kdop<26>;

/// Maps k-DOPs of one frame to k-DOPs of another that enclose them. Made once for a pose.
///
/// Along a normal n of the target frame, the image L x + t of a point x has the coordinate n . t +
/// (L^T n) . x. The direction L^T n lies in a cone of three of the k normals. With its coordinates
/// c_j >= 0 in that cone,
///
///     (L^T n) . x = sum_j c_j normal_j . x <= sum_j c_j upper_j.
template <std::size_t k>
struct KdopMap {
    struct Term {
        std::uint32_t slab = 0;
        float weight = 0; ///< negative: weight of the opposite normal
    };
    std::array<std::array<Term, 3>, k / 2> terms{};
    std::array<float, k / 2> offset{}; ///< n . t
    float margin = 0;

    explicit KdopMap(const RelativePose& pose);
};

/// A k-DOP of the target frame that encloses the image of the volume, up to rounding.
///
/// Source      [Klosowski et al. 1998] moves the vertices. Differs: three slabs bound each
///             direction, so that no vertices are stored; the result is a little wider.
template <std::size_t k>
struct KdopImage {
    Kdop<k> kdop;
    float margin = 0;
};
template <std::size_t k>
KdopImage<k> image_of(const Kdop<k>& volume, const KdopMap<k>& map);

} // namespace abut
