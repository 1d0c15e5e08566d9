#include "ccd/conservative_advancement.h"

#include "ccd/scaled_patch.h"
#include "math/rounding.h"

#include <algorithm>
#include <optional>

namespace abut {

namespace {

/// How much farther apart than the thickness a hit may be: relative to the thickness, or absolute
/// in the scaled patch's units, where it is far above rounding.
constexpr double kTolerance = 1e-6, kLeastTolerance = 0x1p-40;
/// A step is tried with at most this many times the length of the last one.
constexpr double kMostGrowth = 8;
/// After this many secant steps, a step that is too long is at least halved.
constexpr int kMostSecants = 4;

/// The patch at one time.
struct Moment {
    double t;
    FlatPatch patch;
    std::array<Vec3, 4> corners;
    NearestOnPatch nearest;

    Moment(const ScaledPatch& moving, double time)
        : t(time), patch(moving.at(time)), corners(patch.corners()),
          nearest(nearest_on_patch(patch)) {}
};

/// Advances time while the pair is proven to be farther apart than the thickness. All lengths are
/// in units of the scaled patch.
class Advancement {
public:
    Advancement(const ElementaryPair& pair, double thickness, double absolute_error)
        : pair_(pair), moving_(pair), end_corners_(moving_.end.corners()),
          thickness_(moving_.scaled(thickness)) {
        const double tolerance = kTolerance * thickness_;
        converged_ = (1 - 4 * kUnitRoundoff) * (thickness_ + tolerance);
        near_ =
            (1 - 4 * kUnitRoundoff) *
            (thickness_ + std::max({tolerance, moving_.scaled(absolute_error), kLeastTolerance}));
        // A direction's length exceeds 1 by at most 6 eps. The thickness may have lost digits to
        // underflow.
        clear_ = (1 + 10 * kUnitRoundoff) * thickness_ + 1.25 * kAlongOff;
        aim_ = 0.5 * (clear_ + near_);
    }

    ElementaryImpact run() {
        Moment now(moving_, 0);
        for (;;) {
            if (now.nearest.upper <= near_)
                return hit(now);
            const double sure = clear_until(now);
            if (sure >= 1)
                return miss();
            // Rounding may hide that the pair is clear even now.
            const std::optional<Moment> next = sure > now.t ? advance(now, sure) : std::nullopt;
            if (!next)
                return hit(now);
            longest_ = kMostGrowth * (next->t - now.t);
            now = *next;
        }
    }

private:
    /// Returns whether the patch is farther from the origin than the thickness at all times between
    /// two moments.
    ///
    /// The direction is blended from n0 to n1 as time passes, so its length never exceeds the
    /// larger of theirs. A corner's coordinate along it, less the thickness, is quadratic in time
    /// with Bernstein coefficients b0, b1, b2. It is positive if and only if b0 and b2 are positive
    /// and b1 > -sqrt(b0 b2).
    [[nodiscard]] bool is_clear(const Moment& from, const Vec3& n0, const Moment& to,
                                const Vec3& n1) const {
        for (std::size_t i = 0; i < from.corners.size(); ++i) {
            const Vec3 &c0 = from.corners[i], &c1 = to.corners[i];
            const double b0 = dot(n0, c0) - clear_, b2 = dot(n1, c1) - clear_,
                         b1 = 0.5 * (dot(n0, c1) + dot(n1, c0)) - clear_;
            if (!(b0 > 0 && b2 > 0 && (b1 >= 0 || b1 * b1 < 0.999 * b0 * b2)))
                return false;
        }
        return true;
    }

    /// The time until which the direction of now's nearest point alone keeps the patch clear. Only
    /// the answer 1 is proven.
    [[nodiscard]] double clear_until(const Moment& now) const {
        const Vec3& n = now.nearest.direction;
        const double safe = clear_ + 4 * kAlongOff;
        double part = 1;
        for (std::size_t i = 0; i < end_corners_.size(); ++i) {
            const double here = dot(n, now.corners[i]), end = dot(n, end_corners_[i]);
            if (!(here > clear_))
                return now.t;
            if (!(end > clear_))
                part = std::min(part, (here - safe) / (here - end));
        }
        return part >= 1 ? 1 : now.t + part * (1 - now.t);
    }

    /// The time at which the nearest point of `now` reaches the target distance at its present
    /// velocity.
    [[nodiscard]] double time_of_aim(const Moment& now) const {
        const NearestOnPatch& p = now.nearest;
        const Vec3 velocity = (moving_.end.corner - moving_.start.corner) +
                              p.x * (moving_.end.side_x - moving_.start.side_x) +
                              p.y * (moving_.end.side_y - moving_.start.side_y);
        const double approach = -dot(p.direction, velocity);
        const double time = approach > 0 ? now.t + (p.distance - aim_) / approach : 1;
        return std::min({time, now.t + longest_, 1.0});
    }

    /// A later moment until which the patch is proven clear. None if rounding hides that it is
    /// clear until `sure`, the result of clear_until.
    [[nodiscard]] std::optional<Moment> advance(const Moment& now, double sure) const {
        int tries = 0;
        for (double t = time_of_aim(now); t > sure; ++tries) {
            Moment next(moving_, t);
            if (is_clear(now, now.nearest.direction, next, next.nearest.direction))
                return next;
            // Goes back to about the target distance if t is beyond it.
            const double here = now.nearest.distance - aim_, there = next.nearest.distance - aim_;
            const double part = there < 0 ? here / (here - there) : 0.5;
            t = now.t + (tries < kMostSecants ? part : std::min(part, 0.5)) * (t - now.t);
        }
        Moment next(moving_, sure);
        const Vec3& n = now.nearest.direction;
        return is_clear(now, n, next, n) ? std::optional(next) : std::nullopt;
    }

    [[nodiscard]] static ElementaryImpact miss() {
        ElementaryImpact impact;
        impact.decided_by = ElementaryStage::interval;
        return impact;
    }

    [[nodiscard]] ElementaryImpact hit(const Moment& now) const {
        const NearestOnPatch& p = now.nearest;
        ElementaryImpact impact;
        impact.meet = true;
        impact.decided_by = ElementaryStage::interval;
        impact.status = p.upper <= converged_ ? Status::converged : Status::bound_only;
        impact.time = now.t;
        impact.barycentric = patch_barycentric(pair_.kind, p.x, p.y);
        const Vec3 &x = now.patch.side_x, &y = now.patch.side_y;
        impact.normal = p.lower > 0 ? -p.direction
                                    : impact_normal(pair_, impact.barycentric, cross(x, y),
                                                    length_sq(x) > length_sq(y) ? x : y);
        return impact;
    }

    const ElementaryPair& pair_;
    ScaledPatch moving_;
    std::array<Vec3, 4> end_corners_;
    double thickness_;
    double near_;        ///< a pair certainly at most this far apart is a hit
    double converged_;   ///< a hit certainly at most this far apart has the status `converged`
    double clear_;       ///< the patch is clear if it is this far away along a direction
    double aim_;         ///< target distance of a step: certainly clear, and near enough
    double longest_ = 1; ///< longest step to try
};

} // namespace

ElementaryImpact elementary_impact_advancement(const ElementaryPair& pair, double thickness,
                                               double absolute_error) {
    return Advancement(pair, thickness, absolute_error).run();
}

} // namespace abut
