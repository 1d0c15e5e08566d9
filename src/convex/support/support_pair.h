#pragma once

#include "convex/support/support_shape.h"

#include <array>
#include <cstdint>

namespace abut {

/// A point of the difference of two cores: a point of b minus a point of a.
struct DifferencePoint {
    Vec3 at, a, b;
};

/// Up to four points of the difference, and the weights of the point of their hull that is nearest
/// to the origin.
struct SupportSimplex {
    std::array<DifferencePoint, 4> corners{};
    std::array<double, 4> weights{};
    std::uint32_t count = 0;

    [[nodiscard]] DifferencePoint nearest() const;
};

/// Two shapes in a frame of their own: the origin is at a's centre, and lengths are multiplied by a
/// power of two, so that no square overflows or underflows.
class SupportPair {
public:
    SupportPair(const SupportShape& a, const SupportShape& b);

    /// The point of the difference of the cores that is farthest along a direction.
    [[nodiscard]] DifferencePoint farthest(const Vec3& direction) const {
        const Vec3 a = abut::farthest(a_, -direction), b = abut::farthest(b_, direction) + offset_;
        return {b - a, a, b};
    }
    /// The pair after b has moved by a vector of the pair's frame.
    [[nodiscard]] SupportPair moved(const Vec3& by) const {
        SupportPair pair = *this;
        pair.offset_ = pair.offset_ + by;
        return pair;
    }
    /// The shapes in the pair's frame, of which only the cores are meant, with the largest radii.
    [[nodiscard]] const SupportShape& a() const { return a_; }
    [[nodiscard]] const SupportShape& b() const { return b_; }
    /// From centre to centre.
    [[nodiscard]] const Vec3& offset() const { return offset_; }
    [[nodiscard]] double factor() const { return factor_; }
    /// The sum of both radii.
    [[nodiscard]] double radii() const { return a_.radius + b_.radius; }
    /// Bound of the rounding of a coordinate of the difference.
    [[nodiscard]] double rounding() const { return rounding_; }

private:
    SupportShape a_, b_;
    Vec3 offset_;
    double factor_ = 1, rounding_ = 0;
};

} // namespace abut
