#include "volume/moving_box.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/moving_box.cpp"
#include "simd/foreach_target.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 8>;

/// Eight boxes of a run, a register for each bound.
struct BoxLanes {
    hn::Vec<D> lower[2][3], upper[2][3]; ///< [start, end][axis]

    HWY_INLINE BoxLanes(const MovingBoxRun& run, std::size_t first) {
        const float* row = run.rows + first;
        for (std::size_t end = 0; end < 2; ++end) {
            for (std::size_t axis = 0; axis < 3; ++axis, row += run.count)
                lower[end][axis] = hn::LoadU(D(), row);
            for (std::size_t axis = 0; axis < 3; ++axis, row += run.count)
                upper[end][axis] = hn::LoadU(D(), row);
        }
    }

    /// Bits of those that may come within the margin of box k of a run. A rounded difference is
    /// below a float only if the exact one is.
    HWY_INLINE std::uint32_t overlap_bits(const MovingBoxRun& run, std::size_t k,
                                          hn::Vec<D> minus_margin) const {
        const D d;
        const float* row = run.rows + k;
        const auto bound = [&](std::size_t end, std::size_t i) HWY_ATTR {
            return hn::Set(d, row[(MovingBoxRun::kEnd * end + i) * run.count]);
        };
        auto overlap = hn::Set(d, std::numeric_limits<float>::infinity()); // least of all axes
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto below = hn::Max(hn::Sub(bound(0, axis + 3), lower[0][axis]),
                                       hn::Sub(bound(1, axis + 3), lower[1][axis]));
            const auto above = hn::Max(hn::Sub(upper[0][axis], bound(0, axis)),
                                       hn::Sub(upper[1][axis], bound(1, axis)));
            overlap = hn::Min(overlap, hn::Min(below, above));
        }
        return bits_of(d, hn::Ge(overlap, minus_margin));
    }
};

HWY_INLINE void find_overlaps(RunOverlaps& overlaps, float margin) {
    const MovingBoxRun a = overlaps.a, b = overlaps.b;
    const D d;
    const auto minus_margin = hn::Set(d, -margin);
    for (std::uint32_t k = 0; k < a.count; ++k)
        overlaps.masks[k] = 0;
    for (std::uint32_t first = 0; first < b.count;
         first += static_cast<std::uint32_t>(hn::Lanes(d))) {
        const std::uint32_t used = b.count - first >= 32 ? ~0U : (1U << (b.count - first)) - 1;
        const BoxLanes lanes(b, first);
        for (std::uint32_t k = 0; k < a.count; ++k)
            overlaps.masks[k] |= (lanes.overlap_bits(a, k, minus_margin) & used) << first;
    }
}

void find_all_overlaps(std::span<RunOverlaps> overlaps, float margin) {
    for (RunOverlaps& each : overlaps)
        find_overlaps(each, margin);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_all_overlaps);

void find_overlaps(std::span<RunOverlaps> overlaps, float margin) {
    HWY_DYNAMIC_DISPATCH(find_all_overlaps)(overlaps, margin);
}

Aabb inflated(const Aabb& box, float margin) {
    if (margin == 0)
        return box;
    Aabb result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.lower[axis] = round_down(double{box.lower[axis]} - double{margin});
        result.upper[axis] = round_up(double{box.upper[axis]} + double{margin});
    }
    return result;
}

} // namespace abut
#endif
