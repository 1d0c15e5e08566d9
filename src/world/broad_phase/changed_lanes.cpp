#include "world/broad_phase/changed_lanes.h"

#include "core/set_bits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/broad_phase/changed_lanes.cpp"
#include "simd/foreach_target.h"
// Compiled once for each target.
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

class ChangedLanes {
public:
    ChangedLanes(const BoxLevels& levels, const Aabb& before, const Aabb& now,
                 std::vector<std::size_t>& lanes)
        : levels_(levels), before_(before), now_(now), lanes_(lanes) {}

    void visit(std::size_t level, std::size_t node) {
        const D d;
        const auto zero = hn::Zero(d);
        const BoxNode& boxes = levels_[level][node];
        std::uint32_t met = 0, meet = 0, touch = 0;
        for (std::size_t lane = 0; lane < BoxNode::kWidth; lane += hn::Lanes(d)) {
            const V before = least_overlap(boxes, lane, before_),
                    now = least_overlap(boxes, lane, now_);
            met |= bits_of(d, hn::Ge(before, zero)) << lane;
            meet |= bits_of(d, hn::Ge(now, zero)) << lane;
            touch |= bits_of(d, hn::Or(hn::Eq(before, zero), hn::Eq(now, zero))) << lane;
        }
        const std::size_t first = node * BoxNode::kWidth;
        if (level == 0) {
            ++nodes;
            for (const std::size_t lane : SetBits((met ^ meet) | touch))
                lanes_.push_back(first + lane);
        } else {
            for (const std::size_t lane : SetBits(met | meet))
                visit(level - 1, first + lane);
        }
    }

    std::size_t nodes = 0; ///< of level 0 that were visited

private:
    using D = hn::CappedTag<float, BoxNode::kWidth>;
    using V = hn::Vec<D>;

    /// How deep a box overlaps the boxes in some lanes of a node, on the axis of least overlap.
    /// Negative if they are apart.
    HWY_INLINE static V least_overlap(const BoxNode& node, std::size_t lane, const Aabb& box) {
        const D d;
        const auto along = [&](std::size_t axis) HWY_ATTR {
            return hn::Min(
                hn::Sub(hn::Load(d, node.upper[axis] + lane), hn::Set(d, box.lower[axis])),
                hn::Sub(hn::Set(d, box.upper[axis]), hn::Load(d, node.lower[axis] + lane)));
        };
        return min3(along(0), along(1), along(2));
    }

    const BoxLevels& levels_;
    const Aabb before_, now_;
    std::vector<std::size_t>& lanes_;
};

std::size_t find_changed_lanes_simd(const BoxLevels& levels, const Aabb& before, const Aabb& now,
                                    std::vector<std::size_t>& lanes) {
    ChangedLanes changed(levels, before, now, lanes);
    changed.visit(levels.count() - 1, 0);
    return changed.nodes;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_changed_lanes_simd);

std::size_t find_changed_lanes(const BoxLevels& levels, const Aabb& before, const Aabb& now,
                               std::vector<std::size_t>& lanes) {
    return HWY_DYNAMIC_DISPATCH(find_changed_lanes_simd)(levels, before, now, lanes);
}

} // namespace abut
#endif
