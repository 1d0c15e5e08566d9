#pragma once

#include "math/transform.h"
#include "math/vector.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace abut {

/// Lower bounds of the distances of boxes from a point far away, right to the rounding of the
/// coordinates: along the view and across it, each from a linear form on the boxes' own frame.
///
/// Accuracy    with u = 2^-53: the axes are orthonormal to 8 u, and each form is a sum of six products
///             of coordinates that are known to a rounding, so a bound is too large by less than
///             rounding().
class FarView {
public:
    /// In          world_from_frame: of the boxes; sizes: bounds the world coordinates of the point
    ///             and of the boxes, added up. The point is not in the frame's origin.
    FarView(const Vec3& point, const Transform& world_from_frame, double sizes)
        : rounding_(32 * 0x1p-53 * sizes) {
        const auto& m = world_from_frame.m;
        const Vec3 to = Vec3{m[9], m[10], m[11]} - point;
        const Vec3 ahead = normalized_or_zero(to), across = perpendicular(ahead);
        const std::array axes{ahead, across, cross(ahead, across)};
        for (std::size_t k = 0; k < 3; ++k)
            forms_.at(k) = {{dot(axes.at(k), {m[0], m[1], m[2]}),
                             dot(axes.at(k), {m[3], m[4], m[5]}),
                             dot(axes.at(k), {m[6], m[7], m[8]})},
                            dot(axes.at(k), to)};
    }

    [[nodiscard]] double distance(const Box3& box) const {
        const Vec3 middle = 0.5 * (box.lower + box.upper), half = 0.5 * (box.upper - box.lower);
        double sum = 0;
        for (const Form& form : forms_) {
            const double reach = std::abs(form.slope.x) * half.x + std::abs(form.slope.y) * half.y +
                                 std::abs(form.slope.z) * half.z;
            const double gap =
                std::max(0.0, std::abs(form.at_zero + dot(form.slope, middle)) - reach);
            sum += gap * gap;
        }
        return std::sqrt(sum);
    }
    [[nodiscard]] double rounding() const { return rounding_; }

private:
    struct Form {
        Vec3 slope;
        double at_zero = 0;
    };
    std::array<Form, 3> forms_;
    double rounding_;
};

} // namespace abut
