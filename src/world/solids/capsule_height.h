#pragma once

#include "math/vector.h"

#include <optional>

namespace abut {

/// The surface of a capsule over places of a plane. z is the height.
class CapsuleSurface {
public:
    /// In          p, q: ends of the axis.
    CapsuleSurface(const Vec3& p, const Vec3& q, double radius);

    /// The height at which the vertical line at x, y leaves the capsule, times `sign`: at its top if the
    /// sign is 1, at its bottom if it is -1. None if the line misses the capsule.
    [[nodiscard]] std::optional<double> height(double x, double y, double sign) const;

    /// The parameter of the point of the axis that is nearest to a place, seen from above. None if it is an
    /// end, if it is farther away than `reach`, or if the axis is upright.
    [[nodiscard]] std::optional<double> beside(double x, double y, double reach) const {
        const double dx = x - p_.x, dy = y - p_.y;
        const double along = dx * axis_.x + dy * axis_.y, aside = dx * axis_.y - dy * axis_.x;
        if (!(along >= 0 && along <= across_sq_ && across_sq_ > 0) ||
            aside * aside > reach * reach * across_sq_)
            return std::nullopt;
        return along * part_;
    }
    /// The square of the axis' length, seen from above.
    [[nodiscard]] double across_sq() const { return across_sq_; }

private:
    Vec3 p_, q_, axis_;
    double radius_sq_, across_sq_, axis_sq_; ///< across: of the axis, seen from above
    double part_ = 0;                        ///< 1 / across_sq_; 0 if the axis is upright
};

/// CapsuleSurface(p, q, radius).height(x, y, sign), for one place.
inline std::optional<double> capsule_height(const Vec3& p, const Vec3& q, double radius, double x,
                                            double y, double sign) {
    return CapsuleSurface(p, q, radius).height(x, y, sign);
}

} // namespace abut
