#include "volume/moving_box.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/moving_box.cpp"
#include "simd/foreach_target.h"
// Compiled once for each target.
#include "volume/moving_box-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// `lanes_of(run, first)` loads the boxes from `first` on. `bits_of(lanes, box)` returns a bit for
/// each lane that may come near the box.
template <typename LanesOf, typename BitsOf>
HWY_INLINE void find_tiles(RunOverlaps& overlaps, const LanesOf& lanes_of, const BitsOf& bits_of) {
    const MovingBoxRun a = overlaps.a, b = overlaps.b;
    constexpr std::uint32_t kTile = RunOverlaps::kTile;
    const std::uint32_t tiles_b = RunOverlaps::tiles_of(b);
    for (std::uint32_t first = 0; first < b.count;
         first += static_cast<std::uint32_t>(hn::Lanes(MovingBoxLanes::D()))) {
        const auto lanes = lanes_of(b, first);
        const std::uint32_t used = b.all() >> first;
        std::uint64_t* tile = overlaps.tiles.data() + first / kTile;
        for (std::uint32_t k = 0; k < a.count; k += kTile, tile += tiles_b) {
            std::uint64_t bits = 0;
            for (std::uint32_t row = 0; row < std::min(kTile, a.count - k); ++row)
                bits |= std::uint64_t{bits_of(lanes, MovingBoxRef{a, k + row}) & used}
                        << (kTile * row);
            *tile = first % kTile == 0 ? bits : *tile | bits << first % kTile;
        }
    }
}

HWY_INLINE MovingBoxLanes moving_lanes(const MovingBoxRun& run, std::uint32_t first) {
    return {run, first};
}

void find_all_overlaps(std::span<RunOverlaps> overlaps, float margin) {
    const auto minus_margin = hn::Set(MovingBoxLanes::D(), -margin);
    for (RunOverlaps& each : overlaps)
        find_tiles(each, moving_lanes,
                   [&](const MovingBoxLanes& lanes, const MovingBoxRef& box)
                       HWY_ATTR { return lanes.overlap_bits(box, minus_margin); });
}

void find_overlaps_at(std::span<RunOverlaps> overlaps, float margin, StepEnd end) {
    const auto minus_margin = hn::Set(MovingBoxLanes::D(), -margin);
    for (RunOverlaps& each : overlaps)
        find_tiles(
            each,
            [&](const MovingBoxRun& run, std::uint32_t first)
                HWY_ATTR { return StandingBoxLanes(run, first, end); },
            [&](const StandingBoxLanes& lanes, const MovingBoxRef& box)
                HWY_ATTR { return lanes.overlap_bits(box, minus_margin); });
}

void find_overlaps_until(std::span<RunOverlaps> overlaps, float margin, float until) {
    const UntilLanes part(until, margin);
    for (RunOverlaps& each : overlaps)
        find_tiles(each, moving_lanes,
                   [&](const MovingBoxLanes& lanes, const MovingBoxRef& box)
                       HWY_ATTR { return lanes.overlaps_until(box, part).until; });
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_all_overlaps);
HWY_EXPORT(find_overlaps_until);
HWY_EXPORT(find_overlaps_at);

void find_overlaps(std::span<RunOverlaps> overlaps, float margin, float until) {
    if (until < 1)
        HWY_DYNAMIC_DISPATCH(find_overlaps_until)(overlaps, margin, until);
    else
        HWY_DYNAMIC_DISPATCH(find_all_overlaps)(overlaps, margin);
}
void find_overlaps_at(std::span<RunOverlaps> overlaps, float margin, StepEnd end) {
    HWY_DYNAMIC_DISPATCH(find_overlaps_at)(overlaps, margin, end);
}

} // namespace abut
#endif
