// The result of the kernels that compute gaps between volumes.

// Included once for each target.
#if defined(ABUT_VOLUME_SEPARATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_SEPARATION_INL_H
#undef ABUT_VOLUME_SEPARATION_INL_H
#else
#define ABUT_VOLUME_SEPARATION_INL_H
#endif

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// Gaps between two volumes in each lane.
template <class D>
struct Separation {
    hn::Vec<D> gap;      ///< the widest along a direction, less the margin
    hn::Vec<D> lower_sq; ///< lower bound of the squared distance
};

/// Covers the rounding of the few operations that square a gap.
constexpr float kSquareRounding = 1 - 32 * 0x1p-24F;

template <class D>
HWY_INLINE hn::Vec<D> square_of_gap(D d, hn::Vec<D> gap) {
    const auto open = hn::Max(gap, hn::Zero(d));
    return hn::Mul(open, open);
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
