#pragma once

#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace abut {

/// Upper bound of how far points reach in any direction, from how far they reach in 98 directions.
///
/// These 98 directions are the nodes of a grid of 4 x 4 cells on each face of a cube. Each cell is
/// cut into two triangles. A direction n lies in the cone of the three nodes of a triangle:
///
///     n = w_0 n_0 + w_1 n_1 + w_2 n_2, no weight negative.
///
/// No point reaches farther along n than the same sum of the heights along the nodes.
/// Source      [Klosowski et al. 1998], the k-DOP. Differs: its vertices are not computed.
class SupportBound {
public:
    static constexpr std::size_t kCells = 4; ///< along a face's edge
    static constexpr std::size_t kNodes = kCells + 1;

    /// In          finite points. If there are none, heights are not finite.
    explicit SupportBound(std::span<const Vec3> points);

    /// The middle of the points' box, from which heights are measured.
    [[nodiscard]] const Vec3& middle() const { return middle_; }
    /// Half the extents of the points' box, summed over the axes.
    [[nodiscard]] double size() const { return size_; }

    /// Upper bound of n . (p - middle) for all points p, up to rounding: 2^-49 size() times the sum
    /// of the magnitudes of n's coordinates. Not a number where n is not finite.
    [[nodiscard]] double height(const Vec3& n) const {
        const Cone c = cone_of(n);
        return c.size * c.height + c.far * c.first_way + c.near * c.second_way +
               0 * (n.x + n.y + n.z);
    }

    /// A point s with n . s = height(n), to rounding.
    [[nodiscard]] Vec3 support(const Vec3& n) const {
        const Cone c = cone_of(n);
        const double along_u = c.u_first ? c.first_way : c.second_way,
                     along_v = c.u_first ? c.second_way : c.first_way;
        // Extrapolates the height, linear within a cell, to the middle of the face.
        const double forward = c.height + c.to_middle_u * along_u + c.to_middle_v * along_v;
        std::array<double, 3> s{};
        s[c.axis] = c.negative ? -forward : forward;
        s[(c.axis + 1) % 3] = kHalf * along_u;
        s[(c.axis + 2) % 3] = kHalf * along_v;
        return {s[0], s[1], s[2]};
    }

private:
    static constexpr double kHalf = 0.5 * kCells;

    /// Where a direction leaves the cube, and the heights there. On the cube's face, the two other
    /// axes, u and v, are measured in cells. From the cell's first corner a path leads to the
    /// direction, first along the axis with the larger coordinate, then along the other. The height
    /// is linear along both.
    struct Cone {
        std::size_t axis; ///< of the face
        bool negative;    ///< which of the axis's two faces
        bool u_first;
        double to_middle_u, to_middle_v; ///< cells from the cell's first corner to the face's
                                         ///< middle
        double size;                     ///< largest magnitude of the direction's coordinates
        double far, near;                ///< the larger and the smaller coordinate in the cell,
                                         ///< times `size`
        double height;                   ///< at the first corner
        double first_way, second_way;    ///< the height's change over a whole cell, along the first
                                         ///< and the second axis
    };
    // No branches, since the order of the directions is unpredictable. No quotients, since
    // everything else would wait for them.
    [[nodiscard]] Cone cone_of(const Vec3& n) const {
        const std::array<double, 5> c{n.x, n.y, n.z, n.x, n.y};
        const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z), xy = std::max(x, y);
        const bool y_over_x = y > x, z_over_both = z > xy;
        Cone cone{};
        cone.axis = std::size_t{y_over_x && !z_over_both} + 2 * std::size_t{z_over_both};
        cone.negative = std::signbit(c[cone.axis]);
        cone.size = std::max(xy, z);
        const double u = c[cone.axis + 1], v = c[cone.axis + 2], line = 0.5 * cone.size;
        const std::size_t i = std::size_t{u > -line} + std::size_t{u > 0} + std::size_t{u > line},
                          j = std::size_t{v > -line} + std::size_t{v > 0} + std::size_t{v > line};
        cone.to_middle_u = kToMiddle[i], cone.to_middle_v = kToMiddle[j];
        const double u_in = kHalf * u + cone.to_middle_u * cone.size,
                     v_in = kHalf * v + cone.to_middle_v * cone.size;
        cone.u_first = u_in > v_in;
        cone.far = std::max(u_in, v_in), cone.near = std::min(u_in, v_in);
        const float* const at =
            heights_.data() + ((2 * cone.axis + std::size_t{cone.negative}) * kNodes + j) * kNodes +
            i;
        const double between = at[1 + kCells * std::size_t{!cone.u_first}];
        cone.height = at[0];
        cone.first_way = between - cone.height;
        cone.second_way = at[kNodes + 1] - between;
        return cone;
    }
    static constexpr std::array<double, kCells> kToMiddle{2, 1, 0, -1};

    Vec3 middle_;
    double size_ = 0;
    /// Heights at the nodes of each axis's positive and negative face, row by row in v: how far
    /// points reach along the node's direction, whose component along the axis is 1 or -1. Rounded
    /// up.
    std::array<float, 6 * kNodes * kNodes> heights_{};
};

} // namespace abut
