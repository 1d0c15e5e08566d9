#include "geometry/elementary_filter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/elementary_filter.cpp"
#include "simd/foreach_target.h"
// Once for each target:
#include "geometry/elementary_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace elementary; // NOLINT: within this target's namespace

/// Where all of the first feature lies strictly below all of the second along some direction, at
/// both ends, or above. `along` gives a vertex's coordinate in that direction: rounded at most
/// once, since then an order of rounded coordinates is that of the exact ones.
template <bool faces, class D, class Along>
HWY_INLINE hn::Mask<D> apart(D /*d*/, const Pairs<D>& pairs, const Along& along) {
    hn::Mask<D> below[2], above[2];
    for (std::size_t end = 0; end < 2; ++end) {
        const auto s0 = along(pairs.p[0][end]), s1 = along(pairs.p[1][end]),
                   s2 = along(pairs.p[2][end]), s3 = along(pairs.p[3][end]);
        if constexpr (faces) {
            below[end] = hn::Lt(s0, hn::Min(s1, hn::Min(s2, s3)));
            above[end] = hn::Gt(s0, hn::Max(s1, hn::Max(s2, s3)));
        } else {
            below[end] = hn::Lt(hn::Max(s0, s1), hn::Min(s2, s3));
            above[end] = hn::Gt(hn::Min(s0, s1), hn::Max(s2, s3));
        }
    }
    return hn::Or(hn::And(below[0], below[1]), hn::And(above[0], above[1]));
}

template <bool faces, class D>
HWY_INLINE hn::Mask<D> apart_on_axes(D d, const Pairs<D>& pairs) {
    using P = const Lanes3<D>&;
    const auto x = apart<faces>(d, pairs, [](P p) HWY_ATTR { return p.x; });
    const auto y = apart<faces>(d, pairs, [](P p) HWY_ATTR { return p.y; });
    const auto z = apart<faces>(d, pairs, [](P p) HWY_ATTR { return p.z; });
    return hn::Or(x, hn::Or(y, z));
}

template <bool faces, class D>
HWY_INLINE hn::Mask<D> apart_on_diagonals(D d, const Pairs<D>& pairs) {
    using P = const Lanes3<D>&;
    const auto xy = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Add(p.x, p.y); });
    const auto yz = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Add(p.y, p.z); });
    const auto zx = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Add(p.z, p.x); });
    const auto x_y = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.x, p.y); });
    const auto y_z = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.y, p.z); });
    const auto z_x = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.z, p.x); });
    return hn::Or(hn::Or(xy, hn::Or(yz, zx)), hn::Or(x_y, hn::Or(y_z, z_x)));
}

/// Where the four vertices lie in one plane at no time: corner . (x x y) has Bernstein coefficients
/// of one sign.
///
/// With coordinates below C, X and Y, the inner coefficients, three times as large here, sum 18
/// products, each rounded 11 times at most: off by 18 * 11 eps C X Y; the outer ones are off by
/// less. The last term covers underflow; products near overflow leave nothing certain.
template <class D>
HWY_INLINE hn::Mask<D> never_coplanar(D d, const Patches<D>& p) {
    const auto b0 = dot<D>(p.corner[0], p.area_0), b3 = dot<D>(p.corner[1], p.area_2);
    const auto b1 = hn::Add(dot<D>(p.corner[0], p.area_1), dot<D>(p.corner[1], p.area_0));
    const auto b2 = hn::Add(dot<D>(p.corner[1], p.area_1), dot<D>(p.corner[0], p.area_2));

    const auto size_xy = hn::Mul(p.size_x, p.size_y), product = hn::Mul(size_xy, p.size_c);
    const auto tiny = hn::Set(d, 0x1p-1000), huge = hn::Set(d, 0x1p1000);
    const auto bound =
        hn::MulAdd(hn::Set(d, 200 * 0x1p-53), product, hn::MulAdd(tiny, p.size_c, tiny));
    const auto in_range = hn::And(hn::Lt(product, huge), hn::Lt(size_xy, huge));
    const auto least = hn::Min(hn::Min(b0, b1), hn::Min(b2, b3)),
               most = hn::Max(hn::Max(b0, b1), hn::Max(b2, b3));
    return hn::And(in_range, hn::Or(hn::Gt(least, bound), hn::Lt(most, hn::Neg(bound))));
}

template <bool faces, class D>
HWY_INLINE hn::Mask<D> proven_apart(D d, const Pairs<D>& pairs) {
    auto result = apart_on_axes<faces>(d, pairs);
    if (hn::AllTrue(d, result))
        return result;
    result = hn::Or(result, apart_on_diagonals<faces>(d, pairs));
    if (hn::AllTrue(d, result))
        return result;
    return hn::Or(result, never_coplanar(d, Patches<D>::template of<faces>(pairs)));
}

template <bool faces, class D>
HWY_INLINE std::uint32_t possible_with(D d, const ElementaryBlock& block) {
    std::uint32_t possible = 0;
    for (std::size_t lane = 0; lane < ElementaryBlock::kLanes; lane += hn::Lanes(d)) {
        const Pairs<D> pairs(d, block, lane);
        possible |= bits_of(d, hn::Not(proven_apart<faces>(d, pairs))) << lane;
    }
    return possible;
}

std::uint32_t possible_simd(const ElementaryBlock& block, bool faces) {
    return faces ? possible_with<true>(BlockLanes(), block)
                 : possible_with<false>(BlockLanes(), block);
}
bool possible_single(const ElementaryPair& pair) {
    const OneLane d;
    const Pairs<OneLane> pairs(d, pair);
    return hn::AllFalse(d, pair.kind == ElementaryKind::vertex_face
                               ? proven_apart<true>(d, pairs)
                               : proven_apart<false>(d, pairs));
}
std::uint32_t possible_reference(const ElementaryBlock& block, bool faces) {
    return faces ? possible_with<true>(OneLane(), block) : possible_with<false>(OneLane(), block);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(possible_simd);
HWY_EXPORT(possible_single);

std::uint32_t possible_impacts(const ElementaryBlock& block, ElementaryKind kind) {
    return HWY_DYNAMIC_DISPATCH(possible_simd)(block, kind == ElementaryKind::vertex_face);
}
bool possible_impact(const ElementaryPair& pair) {
    return HWY_DYNAMIC_DISPATCH(possible_single)(pair);
}
std::uint32_t possible_impacts_reference(const ElementaryBlock& block, ElementaryKind kind) {
    return HWY_STATIC_DISPATCH(possible_reference)(block, kind == ElementaryKind::vertex_face);
}

} // namespace abut
#endif
