#include "volume/box_run.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/box_run.cpp"
#include "simd/foreach_target.h"
#include "volume/box_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

void overlap_masks(const BoxRun& a, const BoxRun& b, float margin, std::uint32_t* masks) {
    const hn::CappedTag<float, 16> d;
    for (std::uint32_t k = 0; k < a.count; ++k) {
        const Aabb box = inflated(a.box(k), margin);
        std::uint32_t mask = 0;
        for (std::uint32_t i = 0; i < b.count; i += static_cast<std::uint32_t>(hn::Lanes(d)))
            mask |= overlap_bits(d, box, b.rows + i, b.count) << i;
        masks[k] = mask & static_cast<std::uint32_t>((std::uint64_t{1} << b.count) - 1);
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(overlap_masks);

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

void overlap_masks(const BoxRun& a, const BoxRun& b, float margin,
                   std::array<std::uint32_t, BoxRun::kMost>& masks) {
    HWY_DYNAMIC_DISPATCH(overlap_masks)(a, b, margin, masks.data());
}

} // namespace abut
#endif
