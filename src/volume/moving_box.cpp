#include "volume/moving_box.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/moving_box.cpp"
#include "simd/foreach_target.h"
// Once for each target:
#include "volume/moving_box-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

HWY_INLINE void find_masks(RunOverlaps& overlaps, float margin) {
    const MovingBoxRun a = overlaps.a, b = overlaps.b;
    const MovingBoxLanes::D d;
    const auto minus_margin = hn::Set(d, -margin);
    std::uint32_t first = 0;
    do {
        const MovingBoxLanes lanes(b, first);
        for (std::uint32_t left = overlaps.rows; left != 0; left &= left - 1) {
            const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
            const std::uint32_t bits = lanes.overlap_bits({a, k}, minus_margin) << first & b.all();
            overlaps.masks[k] = first == 0 ? bits : overlaps.masks[k] | bits;
        }
        first += static_cast<std::uint32_t>(hn::Lanes(d));
    } while (first < b.count);
}

void find_all_overlaps(std::span<RunOverlaps> overlaps, const MovingBoxRef& around_b,
                       float margin) {
    for (RunOverlaps& each : overlaps) {
        each.rows = each.b.count == 0 ? 0 : overlap_bits(each.a, around_b, margin);
        if (each.rows != 0)
            find_masks(each, margin);
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_all_overlaps);

void find_overlaps(std::span<RunOverlaps> overlaps, const MovingBoxRef& around_b, float margin) {
    HWY_DYNAMIC_DISPATCH(find_all_overlaps)(overlaps, around_b, margin);
}

} // namespace abut
#endif
