#pragma once

#include <abut/types.h>

#include "math/rounding.h"
#include "volume/aabb.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace abut {

/// Whether the box has a point: lower <= upper on every axis, and part of it is at finite
/// coordinates. False if a bound is not a number.
inline bool takes_part(const Box3& box) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto along = [](double lower, double upper) {
        return lower <= upper && lower < kInfinity && upper > -kInfinity;
    };
    return along(box.lower.x, box.upper.x) && along(box.lower.y, box.upper.y) &&
           along(box.lower.z, box.upper.z);
}
/// Whether two closed boxes that take part share a point. Exact.
inline bool meet(const Box3& a, const Box3& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}
/// Whether two boxes, which may be empty, share a point. Exact.
inline bool have_common_point(const Box3& a, const Box3& b) {
    return takes_part(a) && takes_part(b) && meet(a, b);
}

/// Converts boxes to single precision relative to a centre, for comparisons that are exact where
/// they decide.
///
/// The same monotone map f applies to all bounds, lower and upper: x -> float(x - centre). So
/// f(x) < f(y) proves x < y. Only bounds that become equal are left to double precision. Nothing is
/// rounded outward.
class NarrowFrame {
public:
    NarrowFrame() = default;
    explicit NarrowFrame(const Vec3& centre) : centre_(centre) {}
    /// Takes a centre near most of the boxes, so that a few distant ones do not cost the others
    /// precision.
    static NarrowFrame about(std::span<const Box3> boxes);

    [[nodiscard]] Aabb narrow(const Box3& box) const {
        Aabb result;
        if (takes_part(box)) {
            result.lower = narrow(box.lower);
            result.upper = narrow(box.upper);
        }
        return result;
    }

private:
    [[nodiscard]] std::array<float, 3> narrow(const Vec3& p) const {
        return {narrow(p.x - centre_.x), narrow(p.y - centre_.y), narrow(p.z - centre_.z)};
    }
    /// The result is finite, so that differences are numbers. Only empty boxes have infinite
    /// bounds.
    static float narrow(double x) {
        constexpr double kMost = std::numeric_limits<float>::max();
        return to_float(std::clamp(x, -kMost, kMost));
    }

    Vec3 centre_;
};

/// Sixteen boxes in SIMD order: lane i of every row belongs to box i. Unused lanes hold an empty
/// box.
struct alignas(64) BoxNode {
    static constexpr std::size_t kWidth = 16;
    static constexpr std::uint32_t kAllLanes = (1U << kWidth) - 1;
    float lower[3][kWidth]; ///< [axis][lane]
    float upper[3][kWidth];

    void set(std::size_t lane, const Aabb& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis][lane] = box.lower[axis];
            upper[axis][lane] = box.upper[axis];
        }
    }
    [[nodiscard]] Aabb box(std::size_t lane) const {
        Aabb result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            result.lower[axis] = lower[axis][lane];
            result.upper[axis] = upper[axis][lane];
        }
        return result;
    }
    /// The box that encloses all lanes.
    [[nodiscard]] Aabb bounds() const {
        Aabb result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            result.lower[axis] = *std::min_element(lower[axis], lower[axis] + kWidth);
            result.upper[axis] = *std::max_element(upper[axis], upper[axis] + kWidth);
        }
        return result;
    }
};

/// Which boxes of two nodes meet. Bit k of row i stands for box i of the first node and box k of
/// the second.
struct BoxNodeMeetings {
    std::uint32_t rows = 0; ///< bit i: row i of `meet` and `touch` is set; other rows are
                            ///< unspecified
    std::uint32_t meet[BoxNode::kWidth];
    std::uint32_t touch[BoxNode::kWidth]; ///< those bits of `meet` for which two bounds are equal
};

/// Finds the pairs of boxes of two nodes that meet.
/// In          bounds_b: the bounds of b; rows: the boxes of a to test. Boxes that miss the bounds
///             are left out.
/// Accuracy    exact for the bounds in single precision.
void find_meetings(const BoxNode& a, std::uint32_t rows, const BoxNode& b, const Aabb& bounds_b,
                   BoxNodeMeetings& meetings);

} // namespace abut
