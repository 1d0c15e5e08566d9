// Gaps between one oriented box and several.

// Included once for each target.
#if defined(ABUT_VOLUME_OBB_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_OBB_INL_H
#undef ABUT_VOLUME_OBB_INL_H
#else
#define ABUT_VOLUME_OBB_INL_H
#endif

#include "volume/axis_gap-inl.h"
#include "volume/lower_bound.h"
#include "volume/obb.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// Tests the separating axes of two boxes: the three face normals of each, and nine cross products
/// of edges.
///
/// Rows 0 to 2 hold the centre, 3 to 11 the axes a_i, 12 to 14 the half lengths h_i. Let w go from
/// the batch's centre to the other's. Let e_k be the directions of the other's edges, g_k their
/// half lengths, N_k its face normals, and g'_k the distances from its centre to its faces. The
/// gaps are
///
///     a_i:        |a_i . w| - h_i - sum_k g_k |a_i . e_k|
///     N_k:        |N_k . w| - g'_k - sum_i h_i |N_k . a_i|
///     a_i x e_k:  |a_i x e_k . w| - sum_(m != i) h_m |a_i x e_k . a_m|
///                                 - sum_(m != k) g_m |a_i x e_k . e_m|, over |a_i x e_k|
template <class D>
HWY_INLINE Separation<D> separation(D d, const VolumeBatch<Obb>& batch, std::size_t lane,
                                    const ObbImage& one) {
    using V = hn::Vec<D>;
    const auto margin = hn::Set(d, one.margin);
    const Lanes3<D> w = sub(set3(d, one.centre), load3(d, batch.row, lane));
    Lanes3<D> a[3];
    V half[3], shift[3], cosine[3][3], facing[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
        a[i] = load3(d, batch.row + 3 + 3 * i, lane);
        half[i] = hn::Load(d, batch.row[12 + i] + lane);
        shift[i] = dot(a[i], w);
        for (std::size_t k = 0; k < 3; ++k) {
            cosine[i][k] = dot(a[i], set3(d, one.direction[k]));
            facing[i][k] = hn::Abs(dot(a[i], set3(d, one.normal[k])));
        }
    }
    // Faces: squares of gaps in orthogonal directions add up.
    auto gap = hn::Set(d, hwy::LowestValue<float>());
    auto own_sq = hn::Zero(d), other_sq = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) {
        auto own = hn::Sub(hn::Abs(shift[i]), hn::Add(half[i], margin));
        auto other = hn::Sub(hn::Abs(dot(set3(d, one.normal[i]), w)),
                             hn::Add(hn::Set(d, one.normal_half[i]), margin));
        for (std::size_t k = 0; k < 3; ++k) {
            own = hn::NegMulAdd(hn::Set(d, one.half[k]), hn::Abs(cosine[i][k]), own);
            other = hn::NegMulAdd(half[k], facing[k][i], other);
        }
        gap = hn::Max(gap, hn::Max(own, other));
        own_sq = hn::Add(own_sq, square_of_gap(d, own));
        other_sq = hn::Add(other_sq, square_of_gap(d, other));
    }
    auto lower_sq = hn::Max(own_sq, hn::Mul(other_sq, hn::Set(d, 1 / one.normals_spread)));
    // Edges: in the frame of the a_i, a_i x e_k has the components 0, -c_2k, c_1k (cyclically).
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            const auto c1 = cosine[i1][k], c2 = cosine[i2][k];
            auto open = hn::Abs(hn::MulSub(c1, shift[i2], hn::Mul(c2, shift[i1])));
            open = hn::NegMulAdd(half[i1], hn::Abs(c2), open);
            open = hn::NegMulAdd(half[i2], hn::Abs(c1), open);
            // e_k x e_k1 is along N_k2, e_k x e_k2 along N_k1.
            open = hn::NegMulAdd(hn::Set(d, one.half_across[k][k1]), facing[i][k2], open);
            open = hn::NegMulAdd(hn::Set(d, one.half_across[k][k2]), facing[i][k1], open);
            const auto sine_sq = hn::MulAdd(c1, c1, hn::Mul(c2, c2));
            // Nearly parallel edges are skipped: the face normals separate such boxes as well.
            const auto usable = hn::Gt(sine_sq, hn::Set(d, 0x1p-20F));
            // The rounding of the terms does not shrink with the cross product, so the margin is
            // divided too.
            const auto along = hn::Div(hn::Sub(open, margin), hn::Sqrt(sine_sq));
            gap = hn::IfThenElse(usable, hn::Max(gap, along), gap);
        }
    }
    return {gap, hn::Max(lower_sq, square_of_gap(d, gap))};
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
