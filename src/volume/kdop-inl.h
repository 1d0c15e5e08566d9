// Gaps between one k-DOP and several.

// Included once for each target.
#if defined(ABUT_VOLUME_KDOP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_KDOP_INL_H
#undef ABUT_VOLUME_KDOP_INL_H
#else
#define ABUT_VOLUME_KDOP_INL_H
#endif

#include "volume/axis_gap-inl.h"
#include "volume/kdop.h"
#include "volume/lower_bound.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// The batch's rows are the lower bounds of all slabs, then the upper bounds.
template <class D, std::size_t k>
HWY_INLINE Separation<D> separation(D d, const VolumeBatch<Kdop<k>>& batch, std::size_t lane,
                                    const KdopImage<k>& one) {
    constexpr std::size_t kSlabs = k / 2;
    hn::Vec<D> open[kSlabs];
    auto gap = hn::Set(d, hwy::LowestValue<float>());
    for (std::size_t i = 0; i < kSlabs; ++i) {
        const auto& n = Kdop<k>::kNormals[i];
        const int norm_sq = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        const float inverse_norm = norm_sq == 1 ? 1.0F : norm_sq == 2 ? 0.70710678F : 0.57735027F;
        const auto apart = hn::Max(
            hn::Sub(hn::Set(d, one.kdop.lower[i]), hn::Load(d, batch.row[kSlabs + i] + lane)),
            hn::Sub(hn::Load(d, batch.row[i] + lane), hn::Set(d, one.kdop.upper[i])));
        open[i] = hn::MulSub(apart, hn::Set(d, inverse_norm), hn::Set(d, one.margin));
        gap = hn::Max(gap, open[i]);
    }
    // Squares of gaps in orthogonal directions add up. Such directions are the three axes, and an
    // axis together with the two face diagonals orthogonal to it.
    const auto together = [&](std::size_t i, std::size_t j, std::size_t l) HWY_ATTR {
        return hn::Add(square_of_gap(d, open[i]),
                       hn::Add(square_of_gap(d, open[j]), square_of_gap(d, open[l])));
    };
    auto lower_sq = hn::Max(square_of_gap(d, gap), together(0, 1, 2));
    if constexpr (k != 14)
        for (std::size_t axis = 0; axis < 3; ++axis)
            lower_sq = hn::Max(lower_sq, together(axis, 3 + 2 * axis, 4 + 2 * axis));
    return {gap, lower_sq};
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
