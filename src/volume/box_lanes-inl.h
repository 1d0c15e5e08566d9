// A box against boxes side by side.

// Included once for each target.
#if defined(ABUT_VOLUME_BOX_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_BOX_LANES_INL_H
#undef ABUT_VOLUME_BOX_LANES_INL_H
#else
#define ABUT_VOLUME_BOX_LANES_INL_H
#endif

#include "math/lanes-inl.h"
#include "volume/aabb.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// The boxes that the given one overlaps: bit i for the box in lane i. Rows of bounds lie `stride`
/// apart: three lower, three upper.
template <class D>
HWY_INLINE std::uint32_t overlap_bits(D d, const Aabb& box, const float* rows, std::size_t stride) {
    auto overlap = hn::FirstN(d, hn::Lanes(d));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto lower = hn::LoadU(d, rows + axis * stride),
                   upper = hn::LoadU(d, rows + (axis + 3) * stride);
        overlap = hn::And(overlap, hn::And(hn::Le(lower, hn::Set(d, box.upper[axis])),
                                           hn::Ge(upper, hn::Set(d, box.lower[axis]))));
    }
    return bits_of(d, overlap);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
