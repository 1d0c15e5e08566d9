#include "volume/moving_box.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/moving_box.cpp"
#include "simd/foreach_target.h"
// Compiled once for each target.
#include "volume/moving_box-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

HWY_INLINE void find_tiles(RunOverlaps& overlaps, float margin) {
    const MovingBoxRun a = overlaps.a, b = overlaps.b;
    constexpr std::uint32_t kTile = RunOverlaps::kTile;
    const MovingBoxLanes::D d;
    const auto minus_margin = hn::Set(d, -margin);
    const std::uint32_t tiles_b = RunOverlaps::tiles_of(b);
    for (std::uint32_t first = 0; first < b.count;
         first += static_cast<std::uint32_t>(hn::Lanes(d))) {
        const MovingBoxLanes lanes(b, first);
        const std::uint32_t used = b.all() >> first;
        std::uint64_t* tile = overlaps.tiles.data() + first / kTile;
        for (std::uint32_t k = 0; k < a.count; k += kTile, tile += tiles_b) {
            std::uint64_t bits = 0;
            for (std::uint32_t row = 0; row < std::min(kTile, a.count - k); ++row)
                bits |= std::uint64_t{lanes.overlap_bits({a, k + row}, minus_margin) & used}
                        << (kTile * row);
            *tile = first % kTile == 0 ? bits : *tile | bits << first % kTile;
        }
    }
}

void find_all_overlaps(std::span<RunOverlaps> overlaps, float margin) {
    for (RunOverlaps& each : overlaps)
        find_tiles(each, margin);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_all_overlaps);

void find_overlaps(std::span<RunOverlaps> overlaps, float margin) {
    HWY_DYNAMIC_DISPATCH(find_all_overlaps)(overlaps, margin);
}

} // namespace abut
#endif
