#include "world/broad_phase/loose_pairs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/broad_phase/loose_pairs.cpp"
#include "simd/foreach_target.h"
// Compiled once for each target.
#include "simd/simd.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE bool lines_meet(const BoxLine& a, const BoxLine& b) {
    const hn::CappedTag<double, 4> d;
    auto all = hn::FirstN(d, 4);
    for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d))
        all =
            hn::And(all, hn::And(hn::Le(hn::Load(d, a.lower + lane), hn::Load(d, b.upper + lane)),
                                 hn::Le(hn::Load(d, b.lower + lane), hn::Load(d, a.upper + lane))));
    return hn::AllTrue(d, all);
}

std::size_t find_flipped_simd(const BoxLine* boxes, std::span<const IndexPair> pairs,
                              std::uint8_t* meets, std::uint32_t* flipped) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::uint8_t meet = lines_meet(boxes[pairs[i].a()], boxes[pairs[i].b()]) ? 1 : 0;
        // Always written: whether a pair has flipped cannot be predicted.
        flipped[count] = static_cast<std::uint32_t>(i);
        count += meet ^ meets[i];
        meets[i] = meet;
    }
    return count;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_flipped_simd);

std::size_t find_flipped(std::span<const BoxLine> boxes, std::span<const IndexPair> pairs,
                         std::span<std::uint8_t> meets, std::span<std::uint32_t> flipped) {
    return HWY_DYNAMIC_DISPATCH(find_flipped_simd)(boxes.data(), pairs, meets.data(),
                                                   flipped.data());
}

} // namespace abut
#endif
