#include "volume/moving_box.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/moving_box.cpp"
#include "simd/foreach_target.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;

/// One box of a run, its upper bounds raised and its lower bounds lowered by a margin.
struct WidenedBox {
    float bound[MovingBoxRun::kRows];

    WidenedBox(const MovingBoxRun& run, std::uint32_t k, float margin) {
        for (std::size_t row = 0; row < MovingBoxRun::kRows; ++row)
            bound[row] = run.rows[row * run.count + k];
        if (margin == 0)
            return;
        for (std::size_t row = 0; row < MovingBoxRun::kRows; ++row)
            bound[row] = row / 3 % 2 == 0 ? round_down(double{bound[row]} - double{margin})
                                          : round_up(double{bound[row]} + double{margin});
    }
};

/// Boxes side by side, a register for each bound.
struct BoxLanes {
    hn::Vec<D> bound[MovingBoxRun::kRows];

    BoxLanes(const MovingBoxRun& run, std::uint32_t first) {
        for (std::size_t row = 0; row < MovingBoxRun::kRows; ++row)
            bound[row] = hn::LoadU(D(), run.rows + row * run.count + first);
    }

    /// Bits of those that the box may meet. A difference of floats has the right sign.
    [[nodiscard]] HWY_INLINE std::uint32_t overlap_bits(const WidenedBox& box) const {
        const D d;
        auto least = hn::Zero(d); // how much a pair is apart along an axis, negative
        for (std::size_t axis = 0; axis < 3; ++axis) {
            constexpr std::size_t kEnd = MovingBoxRun::kEnd;
            const auto set = [&](std::size_t row) HWY_ATTR { return hn::Set(d, box.bound[row]); };
            const auto below = hn::Max(hn::Sub(set(axis + 3), bound[axis]),
                                       hn::Sub(set(axis + 3 + kEnd), bound[axis + kEnd]));
            const auto above = hn::Max(hn::Sub(bound[axis + 3], set(axis)),
                                       hn::Sub(bound[axis + 3 + kEnd], set(axis + kEnd)));
            least = hn::Min(least, hn::Min(below, above));
        }
        return bits_of(d, hn::Ge(least, hn::Zero(d)));
    }
};

void find_overlaps(RunOverlaps& overlaps, float margin) {
    const MovingBoxRun &a = overlaps.a, &b = overlaps.b;
    const auto used = static_cast<std::uint32_t>((std::uint64_t{1} << b.count) - 1);
    for (std::uint32_t k = 0; k < a.count; ++k)
        overlaps.masks[k] = 0;
    for (std::uint32_t first = 0; first < b.count;
         first += static_cast<std::uint32_t>(hn::Lanes(D()))) {
        const BoxLanes lanes(b, first);
        for (std::uint32_t k = 0; k < a.count; ++k)
            overlaps.masks[k] |= lanes.overlap_bits(WidenedBox(a, k, margin)) << first & used;
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
