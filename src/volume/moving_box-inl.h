// A moving box against eight others in SIMD.

// Included once for each target.
#if defined(ABUT_VOLUME_MOVING_BOX_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_MOVING_BOX_INL_H
#undef ABUT_VOLUME_MOVING_BOX_INL_H
#else
#define ABUT_VOLUME_MOVING_BOX_INL_H
#endif

#include "math/lanes-inl.h"
#include "volume/moving_box.h"

#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// The part of a motion until a time, and a margin, as MovingBoxLanes::overlaps_until takes them.
///
/// The overlap of two boxes in one direction changes linearly, from g0 to g1. Until time t, the most
/// of it is (1 - t) g0 + t max(g0, g1), and it is to be at least -margin. With u = 2^-24: g0 and g1
/// are rounded by u, the weights by 2 u, the products by u. So a weight that is 8 u smaller for g0,
/// which matters where it is negative, and 8 u larger for the other term errs on the safe side where
/// that is positive. It is at least -margin otherwise, and 32 u more margin make up for that.
struct UntilLanes {
    using D = hn::CappedTag<float, 8>;
    hn::Vec<D> start, end, minus_margin;

    HWY_INLINE UntilLanes(float until, float margin)
        : start(hn::Set(D(), (1 - until) * (1 - 8 * 0x1p-24F))),
          end(hn::Set(D(), until * (1 + 8 * 0x1p-24F))),
          minus_margin(hn::Set(D(), -margin * (1 + 32 * 0x1p-24F))) {}
};

/// Moving boxes of a run in SIMD lanes, with a register for each bound.
class MovingBoxLanes {
public:
    using D = hn::CappedTag<float, 8>;

    HWY_INLINE MovingBoxLanes(const MovingBoxRun& run, std::size_t first) {
        const float* row = run.rows + first;
        for (std::size_t end = 0; end < 2; ++end) {
            for (std::size_t axis = 0; axis < 3; ++axis, row += run.count)
                lower_[end][axis] = hn::LoadU(D(), row);
            for (std::size_t axis = 0; axis < 3; ++axis, row += run.count)
                upper_[end][axis] = hn::LoadU(D(), row);
        }
    }

    /// A bit for each box that may come within the margin of the given box. Conservative: a rounded
    /// difference is below a float only if the exact difference is.
    [[nodiscard]] HWY_INLINE std::uint32_t overlap_bits(const MovingBoxRef& box,
                                                        hn::Vec<D> minus_margin) const {
        const D d;
        const float* row = box.run.rows + box.place;
        const auto bound = [&](std::size_t end, std::size_t i) HWY_ATTR {
            return hn::Set(d, row[(MovingBoxRun::kEnd * end + i) * box.run.count]);
        };
        // The overlap along an axis is the larger of those at both ends. The result is the least
        // over all axes.
        auto overlap = hn::Set(d, std::numeric_limits<float>::infinity());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto below = hn::Max(hn::Sub(bound(0, axis + 3), lower_[0][axis]),
                                       hn::Sub(bound(1, axis + 3), lower_[1][axis]));
            const auto above = hn::Max(hn::Sub(upper_[0][axis], bound(0, axis)),
                                       hn::Sub(upper_[1][axis], bound(1, axis)));
            overlap = hn::Min(overlap, hn::Min(below, above));
        }
        return bits_of(d, hn::Ge(overlap, minus_margin));
    }

    /// A bit for each box that may come within the margin of the given box.
    struct UntilBits {
        std::uint32_t until; ///< until the time
        std::uint32_t start; ///< at the start already
    };
    [[nodiscard]] HWY_INLINE UntilBits overlaps_until(const MovingBoxRef& box,
                                                      const UntilLanes& part) const {
        const D d;
        const float* row = box.run.rows + box.place;
        const auto bound = [&](std::size_t end, std::size_t i) HWY_ATTR {
            return hn::Set(d, row[(MovingBoxRun::kEnd * end + i) * box.run.count]);
        };
        const auto most = [&](hn::Vec<D> at_start, hn::Vec<D> at_end) HWY_ATTR {
            return hn::MulAdd(part.end, hn::Max(at_start, at_end), hn::Mul(part.start, at_start));
        };
        auto overlap = hn::Set(d, std::numeric_limits<float>::infinity()), first = overlap;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto below = hn::Sub(bound(0, axis + 3), lower_[0][axis]),
                       above = hn::Sub(upper_[0][axis], bound(0, axis));
            first = hn::Min(first, hn::Min(below, above));
            overlap =
                hn::Min(overlap, hn::Min(most(below, hn::Sub(bound(1, axis + 3), lower_[1][axis])),
                                         most(above, hn::Sub(upper_[1][axis], bound(1, axis)))));
        }
        return {bits_of(d, hn::Ge(overlap, part.minus_margin)),
                bits_of(d, hn::Ge(first, part.minus_margin))};
    }

    /// For each box: a time before which it is farther than the margin from the given box, between 0
    /// and 1; infinity if it always is. Conservative: never later than the true time.
    ///
    /// On each axis, the overlaps with one box below and above the other change linearly. At most
    /// one of them is negative at the start. If it grows from g0 < -margin to g1, the boxes come
    /// within the margin at (-margin - g0) / (g1 - g0). With u = 2^-24, g0 and g1 are off by u of
    /// themselves, each difference by u more. 4 u |g0| covers that of the numerator, which is below
    /// |g0|, 4 u (|g0| + |g1|) that of the denominator, and the last factor the division.
    [[nodiscard]] HWY_INLINE hn::Vec<D> first_overlaps(const MovingBoxRef& box,
                                                       hn::Vec<D> minus_margin) const {
        const D d;
        const float* row = box.run.rows + box.place;
        const auto bound = [&](std::size_t end, std::size_t i) HWY_ATTR {
            return hn::Set(d, row[(MovingBoxRun::kEnd * end + i) * box.run.count]);
        };
        const auto error = hn::Set(d, 4 * 0x1p-24F), zero = hn::Zero(d),
                   tiny = hn::Set(d, std::numeric_limits<float>::min()),
                   never = hn::Set(d, std::numeric_limits<float>::infinity());
        auto overlap = never, first = zero;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto below0 = hn::Sub(bound(0, axis + 3), lower_[0][axis]),
                       below1 = hn::Sub(bound(1, axis + 3), lower_[1][axis]);
            const auto above0 = hn::Sub(upper_[0][axis], bound(0, axis)),
                       above1 = hn::Sub(upper_[1][axis], bound(1, axis));
            overlap = hn::Min(overlap, hn::Min(hn::Max(below0, below1), hn::Max(above0, above1)));
            const auto g0 = hn::Min(below0, above0),
                       g1 = hn::IfThenElse(hn::Lt(below0, above0), below1, above1);
            const auto way = hn::Max(hn::MulAdd(error, g0, hn::Sub(minus_margin, g0)), zero);
            const auto speed = hn::Max(
                hn::MulAdd(error, hn::Add(hn::Abs(g0), hn::Abs(g1)), hn::Sub(g1, g0)), tiny);
            first = hn::Max(first, hn::Div(way, speed));
        }
        first = hn::Mul(first, hn::Set(d, 1 - 4 * 0x1p-24F));
        return hn::IfThenElse(hn::Ge(overlap, minus_margin), first, never);
    }

private:
    hn::Vec<D> lower_[2][3], upper_[2][3]; ///< [start, end][axis]
};

/// The boxes of a run at one end of the motion in SIMD lanes, with a register for each bound.
class StandingBoxLanes {
public:
    using D = MovingBoxLanes::D;

    HWY_INLINE StandingBoxLanes(const MovingBoxRun& run, std::size_t first, StepEnd end)
        : first_row_(end == StepEnd::start ? 0 : MovingBoxRun::kEnd) {
        const float* row = run.rows + first_row_ * run.count + first;
        for (std::size_t axis = 0; axis < 3; ++axis, row += run.count) {
            lower_[axis] = hn::LoadU(D(), row);
            upper_[axis] = hn::LoadU(D(), row + std::size_t{3} * run.count);
        }
    }

    /// A bit for each box that may come within the margin of the given box at that end.
    /// Conservative, as MovingBoxLanes::overlap_bits.
    [[nodiscard]] HWY_INLINE std::uint32_t overlap_bits(const MovingBoxRef& box,
                                                        hn::Vec<D> minus_margin) const {
        const D d;
        const float* row = box.run.rows + first_row_ * box.run.count + box.place;
        auto overlap = hn::Set(d, std::numeric_limits<float>::infinity());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto lower = hn::Set(d, row[axis * box.run.count]),
                       upper = hn::Set(d, row[(axis + 3) * box.run.count]);
            overlap = hn::Min(overlap,
                              hn::Min(hn::Sub(upper, lower_[axis]), hn::Sub(upper_[axis], lower)));
        }
        return bits_of(d, hn::Ge(overlap, minus_margin));
    }

private:
    std::size_t first_row_;
    hn::Vec<D> lower_[3], upper_[3];
};

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
