// Gaps between one swept sphere and several, each with a core of any dimension.

// Included once for each target.
#if defined(ABUT_VOLUME_SSV_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_SSV_INL_H
#undef ABUT_VOLUME_SSV_INL_H
#else
#define ABUT_VOLUME_SSV_INL_H
#endif

#include "volume/ssv.h"
#include "volume/swept_sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// The largest dimension of the cores in all lanes. It does not depend on how many are tested at
/// once.
template <class D>
HWY_INLINE std::size_t dimension_of(D d, const SweptBatch& batch) {
    const auto some_long = [&](std::size_t axis) HWY_ATTR {
        auto longest = hn::Zero(d);
        for (std::size_t lane = 0; lane < VolumeBounds::kLanes; lane += hn::Lanes(d))
            longest = hn::Max(longest, hn::Load(d, batch.row[4 + 4 * axis + 3] + lane));
        return !hn::AllFalse(d, hn::Gt(longest, hn::Zero(d)));
    };
    if (batch.most_dimension >= 2 && some_long(1))
        return 2;
    return batch.most_dimension >= 1 && some_long(0) ? 1 : 0;
}

/// The one test for mixed kinds. All lanes are tested as kinds of the largest dimension among them:
/// a point is a segment without length, a segment is a rectangle without width.
///
/// Not inline: a traversal would have seven copies of the nine instances.
template <class D>
HWY_NOINLINE Separation<D> separation(D d, const SweptBatch& batch, std::size_t lane,
                                      const SsvImage& one) {
    switch (3 * dimension_of(d, batch) + one.dimension) {
    case 0:
        return separation_of_cores<0, 0>(d, batch.row, lane, one);
    case 1:
        return separation_of_cores<0, 1>(d, batch.row, lane, one);
    case 2:
        return separation_of_cores<0, 2>(d, batch.row, lane, one);
    case 3:
        return separation_of_cores<1, 0>(d, batch.row, lane, one);
    case 4:
        return separation_of_cores<1, 1>(d, batch.row, lane, one);
    case 5:
        return separation_of_cores<1, 2>(d, batch.row, lane, one);
    case 6:
        return separation_of_cores<2, 0>(d, batch.row, lane, one);
    case 7:
        return separation_of_cores<2, 1>(d, batch.row, lane, one);
    default:
        return separation_of_cores<2, 2>(d, batch.row, lane, one);
    }
}
template <class D>
HWY_INLINE Separation<D> separation(D d, const VolumeBatch<Ssv>& batch, std::size_t lane,
                                    const SsvImage& one) {
    return separation(d, SweptBatch{batch.row, 2}, lane, one);
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
