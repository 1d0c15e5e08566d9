#pragma once

#include "math/vector.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace abut {

/// How far points reach in any direction, bounded by how far they reach in 26.
///
/// A direction lies in a cone of three of the normals {-1, 0, 1}^3: with L >= M >= S the sizes of
/// its coordinates, and signs and axes put aside,
///
///     (L, M, S) = (L - M) (1, 0, 0) + (M - S) (1, 1, 0) + S (1, 1, 1),
///
/// so no point reaches farther than the same sum of the heights along these normals.
/// Source      [Klosowski et al. 1998], the 26-DOP. Differs: no vertices of it are asked for.
class SupportBound {
public:
    /// In          finite points. Of none, heights are not finite.
    explicit SupportBound(std::span<const Vec3> points);

    /// The middle of the points' box; heights are measured from it.
    [[nodiscard]] const Vec3& middle() const { return middle_; }
    /// Half the extents of the points' box, summed over the axes.
    [[nodiscard]] double size() const { return size_; }

    /// n . (p - middle) is not larger for any of the points p, to rounding: 2^-49 size() times the
    /// sum of the sizes of n's coordinates. Not a number where n is not finite.
    [[nodiscard]] double height(const Vec3& n) const {
        const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
        const double largest = std::max({x, y, z}), least = std::min({x, y, z}),
                     middle = std::max(std::min(x, y), std::min(std::max(x, y), z));
        const Cone cone = cone_of(n);
        return (largest - middle) * cone.height[0] + (middle - least) * cone.height[1] +
               least * cone.height[2] + 0 * (n.x + n.y + n.z);
    }

    /// A point s with n . s = height(n), to rounding.
    [[nodiscard]] Vec3 support(const Vec3& n) const {
        const Cone cone = cone_of(n);
        const std::array<double, 3> more{cone.height[0], cone.height[1] - cone.height[0],
                                         cone.height[2] - cone.height[1]};
        return {std::copysign(1.0, n.x) * more[cone.rank[0]],
                std::copysign(1.0, n.y) * more[cone.rank[1]],
                std::copysign(1.0, n.z) * more[cone.rank[2]]};
    }

private:
    /// The three normals around a direction: the axis of its largest coordinate first, the diagonal
    /// of all three last.
    struct Cone {
        std::array<double, 3> height;
        std::array<std::size_t, 3> rank; ///< how many coordinates are larger
    };
    [[nodiscard]] Cone cone_of(const Vec3& n) const {
        const bool y_over_x = std::abs(n.y) > std::abs(n.x),
                   z_over_x = std::abs(n.z) > std::abs(n.x),
                   z_over_y = std::abs(n.z) > std::abs(n.y);
        // Of equal coordinates, the first counts as larger.
        const std::array<std::size_t, 3> rank{std::size_t{y_over_x} + std::size_t{z_over_x},
                                              std::size_t{!y_over_x} + std::size_t{z_over_y},
                                              std::size_t{!z_over_x} + std::size_t{!z_over_y}};
        std::array<std::ptrdiff_t, 3> step{};
        step[rank[0]] = std::signbit(n.x) ? -1 : 1;
        step[rank[1]] = std::signbit(n.y) ? -3 : 3;
        step[rank[2]] = std::signbit(n.z) ? -9 : 9;
        const float* const at = height_.data() + kMiddle;
        return {{double{at[step[0]]}, double{at[step[0] + step[1]]},
                 double{at[step[0] + step[1] + step[2]]}},
                rank};
    }

    static constexpr std::ptrdiff_t kMiddle = 13;

    Vec3 middle_;
    double size_ = 0;
    /// Along the normal (i, j, k), at kMiddle + i + 3 j + 9 k; rounded up.
    std::array<float, 27> height_{};
};

} // namespace abut
