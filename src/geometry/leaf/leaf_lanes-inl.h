// The triangle pairs of two leaves, one per lane.

// Included once for each target.
#if defined(ABUT_GEOMETRY_LEAF_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_GEOMETRY_LEAF_LANES_INL_H
#undef ABUT_GEOMETRY_LEAF_LANES_INL_H
#else
#define ABUT_GEOMETRY_LEAF_LANES_INL_H
#endif

#include "geometry/leaf/triangle_leaf.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

constexpr std::size_t kPairs = TriangleLeaf::kLanes * TriangleLeaf::kLanes;

/// Spreads the triangles of two leaves to the lanes of their sixteen pairs: lane 4 i + j holds
/// triangle i of a and triangle j of b.
template <class D>
HWY_INLINE hn::Vec<D> spread_a(D d, const float (&v)[TriangleLeaf::kLanes], std::size_t lane) {
    if constexpr (hn::MaxLanes(D()) < TriangleLeaf::kLanes) {
        return hn::Set(d, v[lane / TriangleLeaf::kLanes]);
    } else {
        alignas(64) static constexpr std::int32_t kRow[kPairs] = {0, 0, 0, 0, 1, 1, 1, 1,
                                                                  2, 2, 2, 2, 3, 3, 3, 3};
        return hn::TableLookupLanes(hn::LoadDup128(d, v), hn::SetTableIndices(d, kRow + lane));
    }
}
template <class D>
HWY_INLINE hn::Vec<D> spread_b(D d, const float (&v)[TriangleLeaf::kLanes], std::size_t lane) {
    if constexpr (hn::MaxLanes(D()) < TriangleLeaf::kLanes)
        return hn::Set(d, v[lane % TriangleLeaf::kLanes]);
    else
        return hn::LoadDup128(d, v);
}

/// Transforms b's triangles to a's frame.
HWY_INLINE void turn_leaf(const TriangleLeaf& b, const LeafPlacement& to_a, TriangleLeaf& turned) {
    const hn::CappedTag<float, TriangleLeaf::kLanes> d;
    const auto& m = to_a.linear;
    for (std::size_t lane = 0; lane < TriangleLeaf::kLanes; lane += hn::Lanes(d))
        for (std::size_t v = 0; v < 3; ++v) {
            const auto p = load3(d, b.v[v], lane);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                auto sum =
                    hn::MulAdd(hn::Set(d, m[0][axis]), p.x, hn::Set(d, to_a.translation[axis]));
                sum = hn::MulAdd(hn::Set(d, m[1][axis]), p.y, sum);
                sum = hn::MulAdd(hn::Set(d, m[2][axis]), p.z, sum);
                hn::Store(sum, d, turned.v[v][axis] + lane);
            }
        }
}

/// Loads the triangles of the pairs from `lane` on, both in one frame.
template <class D>
HWY_INLINE void load_pairs(D d, const TriangleLeaf& leaf_a, const TriangleLeaf& leaf_b,
                           std::size_t lane, Lanes3<D> (&a)[3], Lanes3<D> (&b)[3]) {
    for (std::size_t v = 0; v < 3; ++v) {
        const auto &p = leaf_a.v[v], &q = leaf_b.v[v];
        a[v] = {spread_a(d, p[0], lane), spread_a(d, p[1], lane), spread_a(d, p[2], lane)};
        b[v] = {spread_b(d, q[0], lane), spread_b(d, q[1], lane), spread_b(d, q[2], lane)};
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
