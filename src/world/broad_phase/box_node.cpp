#include "world/broad_phase/box_node.h"

#include "core/set_bits.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/broad_phase/box_node.cpp"
#include "simd/foreach_target.h"
// Compiled once for each target.
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using D = hn::CappedTag<float, BoxNode::kWidth>;
using V = hn::Vec<D>;

/// How deep a box overlaps the boxes in some lanes of a node, on the axis of least overlap.
/// Negative if they are apart.
HWY_INLINE V least_overlap(const BoxNode& node, std::size_t lane, const V (&lower)[3],
                           const V (&upper)[3]) {
    const D d;
    const auto along = [&](std::size_t axis) HWY_ATTR {
        return hn::Min(hn::Sub(hn::Load(d, node.upper[axis] + lane), lower[axis]),
                       hn::Sub(upper[axis], hn::Load(d, node.lower[axis] + lane)));
    };
    return min3(along(0), along(1), along(2));
}

struct RowBits {
    std::uint32_t meet = 0, touch = 0;
};

/// Tests one box against all boxes of a node.
HWY_INLINE RowBits meet_row(const BoxNode& node, const V (&lower)[3], const V (&upper)[3]) {
    const D d;
    const auto zero = hn::Zero(d);
    RowBits bits;
    for (std::size_t lane = 0; lane < BoxNode::kWidth; lane += hn::Lanes(d)) {
        const V overlap = least_overlap(node, lane, lower, upper);
        bits.meet |= bits_of(d, hn::Ge(overlap, zero)) << lane;
        bits.touch |= bits_of(d, hn::Eq(overlap, zero)) << lane;
    }
    return bits;
}

void find_meetings_simd(const BoxNode& a, std::uint32_t rows, const BoxNode& b,
                        const Aabb& bounds_b, BoxNodeMeetings& meetings) {
    const D d;
    const V lower_b[3]{hn::Set(d, bounds_b.lower[0]), hn::Set(d, bounds_b.lower[1]),
                       hn::Set(d, bounds_b.lower[2])};
    const V upper_b[3]{hn::Set(d, bounds_b.upper[0]), hn::Set(d, bounds_b.upper[1]),
                       hn::Set(d, bounds_b.upper[2])};
    meetings.rows = rows & meet_row(a, lower_b, upper_b).meet;
    for (const std::size_t row : SetBits(meetings.rows)) {
        const V lower[3]{hn::Set(d, a.lower[0][row]), hn::Set(d, a.lower[1][row]),
                         hn::Set(d, a.lower[2][row])};
        const V upper[3]{hn::Set(d, a.upper[0][row]), hn::Set(d, a.upper[1][row]),
                         hn::Set(d, a.upper[2][row])};
        const RowBits bits = meet_row(b, lower, upper);
        meetings.meet[row] = bits.meet;
        meetings.touch[row] = bits.touch;
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(find_meetings_simd);

namespace {

/// The median of a sample of the boxes' centres.
double middle_of(std::span<const Box3> boxes, int axis) {
    std::vector<double> sample;
    const std::size_t stride = std::max<std::size_t>(boxes.size() / 64, 1);
    for (std::size_t i = 0; i < boxes.size(); i += stride) {
        const double middle =
            0.5 * component(boxes[i].lower, axis) + 0.5 * component(boxes[i].upper, axis);
        if (takes_part(boxes[i]) && std::isfinite(middle))
            sample.push_back(middle);
    }
    if (sample.empty())
        return 0;
    const auto median = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
    std::nth_element(sample.begin(), median, sample.end());
    return *median;
}

} // namespace

NarrowFrame NarrowFrame::about(std::span<const Box3> boxes) {
    return NarrowFrame({middle_of(boxes, 0), middle_of(boxes, 1), middle_of(boxes, 2)});
}

void find_meetings(const BoxNode& a, std::uint32_t rows, const BoxNode& b, const Aabb& bounds_b,
                   BoxNodeMeetings& meetings) {
    HWY_DYNAMIC_DISPATCH(find_meetings_simd)(a, rows, b, bounds_b, meetings);
}

} // namespace abut
#endif
