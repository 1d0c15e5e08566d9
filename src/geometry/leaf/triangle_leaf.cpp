#include "geometry/leaf/triangle_leaf.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/leaf/triangle_leaf.cpp"
#include "simd/foreach_target.h"
#include "geometry/leaf/leaf_lanes-inl.h"
#include "geometry/leaf/triangle_pair_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

template <bool with_near, class D>
HWY_INLINE LeafPairs compare_with(D d, const TriangleLeaf& leaf_a, const TriangleLeaf& leaf_b,
                                  const LeafPlacement& to_a, const LeafBound& bound) {
    TriangleLeaf turned{};
    turn_leaf(leaf_b, to_a, turned);
    LeafPairs result;
    for (std::size_t lane = 0; lane < kPairs; lane += hn::Lanes(d)) {
        Lanes3<D> a[3], b[3];
        load_pairs(d, leaf_a, turned, lane, a, b);
        const DecidedPairs<D> pairs =
            decide_pairs<with_near>(d, a, b, hn::Set(d, to_a.margin), bound);
        result.cross |= bits_of(d, pairs.cross) << lane;
        result.may_meet |= bits_of(d, pairs.may_meet) << lane;
        if constexpr (with_near)
            result.may_be_near |= bits_of(d, pairs.may_be_near) << lane;
    }
    return result;
}

using PairLanes = hn::CappedTag<float, kPairs>;
using OneLane = hn::CappedTag<float, 1>;

LeafPairs meeting_pairs_simd(const TriangleLeaf& a, const TriangleLeaf& b,
                             const LeafPlacement& a_from_b) {
    return compare_with<false>(PairLanes(), a, b, a_from_b, {});
}
LeafPairs meeting_pairs_one(const TriangleLeaf& a, const TriangleLeaf& b,
                            const LeafPlacement& a_from_b) {
    return compare_with<false>(OneLane(), a, b, a_from_b, {});
}
LeafPairs near_pairs_simd(const TriangleLeaf& a, const TriangleLeaf& b,
                          const LeafPlacement& a_from_b, const LeafBound& bound) {
    return compare_with<true>(PairLanes(), a, b, a_from_b, bound);
}
LeafPairs near_pairs_one(const TriangleLeaf& a, const TriangleLeaf& b,
                         const LeafPlacement& a_from_b, const LeafBound& bound) {
    return compare_with<true>(OneLane(), a, b, a_from_b, bound);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(meeting_pairs_simd);
HWY_EXPORT(near_pairs_simd);

LeafPairs meeting_pairs(const TriangleLeaf& a, const TriangleLeaf& b,
                        const LeafPlacement& a_from_b) {
    return HWY_DYNAMIC_DISPATCH(meeting_pairs_simd)(a, b, a_from_b);
}
LeafPairs meeting_pairs_reference(const TriangleLeaf& a, const TriangleLeaf& b,
                                  const LeafPlacement& a_from_b) {
    return HWY_STATIC_DISPATCH(meeting_pairs_one)(a, b, a_from_b);
}
LeafPairs near_pairs(const TriangleLeaf& a, const TriangleLeaf& b, const LeafPlacement& a_from_b,
                     const LeafBound& bound) {
    return HWY_DYNAMIC_DISPATCH(near_pairs_simd)(a, b, a_from_b, bound);
}
LeafPairs near_pairs_reference(const TriangleLeaf& a, const TriangleLeaf& b,
                               const LeafPlacement& a_from_b, const LeafBound& bound) {
    return HWY_STATIC_DISPATCH(near_pairs_one)(a, b, a_from_b, bound);
}

} // namespace abut
#endif
