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

private:
    hn::Vec<D> lower_[2][3], upper_[2][3]; ///< [start, end][axis]
};

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
