#pragma once

#include "math/vector.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A triangle with what the distance of points needs.
class DistanceFace {
public:
    /// In          number: by which the caller knows the triangle.
    DistanceFace(const Triangle& t, std::uint32_t number);

    [[nodiscard]] const Triangle& corners() const { return corners_; }
    [[nodiscard]] std::uint32_t number() const { return number_; }

    /// The squared distance of a point.
    ///
    /// Accuracy    that to some point of the triangle, to rounding, so that it is an upper bound. The
    ///             point is the nearest one unless the triangle is flat to rounding.
    [[nodiscard]] double distance_sq(const Vec3& p) const;

    /// The weights of the corners at a point of the triangle near to p: nearest if p is above the
    /// triangle. They are not negative, and their sum is 1.
    [[nodiscard]] std::array<double, 3> weights(const Vec3& p) const;

private:
    Triangle corners_;
    std::uint32_t number_;
    std::array<Vec3, 3> edges_;                 ///< from corner k to the next
    std::array<double, 3> inverse_length_sq_{}; ///< of the edges; 0 for an edge without length
    double weight_xx_ = 0, weight_xy_ = 0, weight_yy_ = 0; ///< inverse of the edges' Gram matrix
};

/// Finds the triangle nearest to a point: a binary tree of boxes over a few triangles, which is
/// quick to build.
class TriangleSearch {
public:
    /// In          at least one triangle. Faces are sorted; their numbers are those of this list.
    explicit TriangleSearch(std::span<const Triangle> triangles);

    [[nodiscard]] const DistanceFace& operator[](std::uint32_t i) const { return faces_[i]; }

    struct Found {
        std::uint32_t triangle = 0;
        double distance_sq = 0;
    };
    [[nodiscard]] Found nearest(const Vec3& p) const;

private:
    struct Node {
        Box3 box;
        std::uint32_t begin = 0, end = 0;
        std::uint32_t right = 0; ///< second child; the first follows its parent. 0: a leaf
    };
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);
    void visit(std::uint32_t node, const Vec3& p, Found& best) const;

    std::vector<DistanceFace> faces_;
    std::vector<Node> nodes_;
};

} // namespace abut
