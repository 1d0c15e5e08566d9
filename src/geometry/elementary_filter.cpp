#include "geometry/elementary_filter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/elementary_filter.cpp"
#include "simd/foreach_target.h"
#include "simd/simd.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct Vec {
    using V = hn::Vec<D>;
    V x, y, z;
};

template <class D>
HWY_INLINE Vec<D> add(const Vec<D>& a, const Vec<D>& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class D>
HWY_INLINE Vec<D> sub(const Vec<D>& a, const Vec<D>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Vec<D>& a, const Vec<D>& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class D>
HWY_INLINE Vec<D> cross(const Vec<D>& a, const Vec<D>& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
template <class D>
HWY_INLINE hn::Vec<D> max_abs(const Vec<D>& a) {
    return hn::Max(hn::Abs(a.x), hn::Max(hn::Abs(a.y), hn::Abs(a.z)));
}

/// The four vertices at both ends.
template <class D>
struct Pairs {
    Vec<D> p[4][2];

    HWY_INLINE Pairs(D d, const ElementaryBlock& block, std::size_t lane) {
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t end = 0; end < 2; ++end) {
                const auto& rows = block.v[i][end];
                p[i][end] = {hn::Load(d, rows[0] + lane), hn::Load(d, rows[1] + lane),
                             hn::Load(d, rows[2] + lane)};
            }
    }
};

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
    using P = const Vec<D>&;
    const auto x = apart<faces>(d, pairs, [](P p) HWY_ATTR { return p.x; });
    const auto y = apart<faces>(d, pairs, [](P p) HWY_ATTR { return p.y; });
    const auto z = apart<faces>(d, pairs, [](P p) HWY_ATTR { return p.z; });
    return hn::Or(x, hn::Or(y, z));
}

template <bool faces, class D>
HWY_INLINE hn::Mask<D> apart_on_diagonals(D d, const Pairs<D>& pairs) {
    using P = const Vec<D>&;
    const auto xy = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Add(p.x, p.y); });
    const auto yz = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Add(p.y, p.z); });
    const auto zx = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Add(p.z, p.x); });
    const auto x_y = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.x, p.y); });
    const auto y_z = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.y, p.z); });
    const auto z_x = apart<faces>(d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.z, p.x); });
    return hn::Or(hn::Or(xy, hn::Or(yz, zx)), hn::Or(x_y, hn::Or(y_z, z_x)));
}

/// Where the four vertices lie in one plane at no time: the cubic corner . (side_x x side_y) (see
/// difference_patch.h) has Bernstein coefficients of one sign.
///
/// With sides below X and Y and corners below C in each coordinate, the inner coefficients, three
/// times as large here, sum 18 products, each rounded 11 times at most: off by 18 * 11 eps X Y C;
/// the outer ones are off by less. The last term covers underflow; products near overflow leave
/// nothing certain.
template <bool faces, class D>
HWY_INLINE hn::Mask<D> never_coplanar(D d, const Pairs<D>& pairs) {
    constexpr std::size_t kFrom = faces ? 0 : 0, kCorner = faces ? 1 : 2;
    Vec<D> corner[2], x[2], y[2];
    for (std::size_t end = 0; end < 2; ++end) {
        corner[end] = sub<D>(pairs.p[kCorner][end], pairs.p[kFrom][end]);
        x[end] = sub<D>(pairs.p[faces ? 2 : 0][end], pairs.p[1][end]);
        y[end] = sub<D>(pairs.p[3][end], pairs.p[faces ? 1 : 2][end]);
    }
    const Vec<D> area_0 = cross<D>(x[0], y[0]), area_2 = cross<D>(x[1], y[1]),
                 area_1 = add<D>(cross<D>(x[0], y[1]), cross<D>(x[1], y[0]));
    const auto b0 = dot<D>(corner[0], area_0), b3 = dot<D>(corner[1], area_2);
    const auto b1 = hn::Add(dot<D>(corner[0], area_1), dot<D>(corner[1], area_0));
    const auto b2 = hn::Add(dot<D>(corner[1], area_1), dot<D>(corner[0], area_2));

    const auto size_c = hn::Max(max_abs<D>(corner[0]), max_abs<D>(corner[1]));
    const auto size_xy = hn::Mul(hn::Max(max_abs<D>(x[0]), max_abs<D>(x[1])),
                                 hn::Max(max_abs<D>(y[0]), max_abs<D>(y[1])));
    const auto product = hn::Mul(size_xy, size_c);
    const auto bound = hn::MulAdd(hn::Set(d, 200 * 0x1p-53), product,
                                  hn::MulAdd(hn::Set(d, 0x1p-1000), size_c, hn::Set(d, 0x1p-1000)));
    const auto in_range =
        hn::And(hn::Lt(product, hn::Set(d, 0x1p1000)), hn::Lt(size_xy, hn::Set(d, 0x1p1000)));
    const auto least = hn::Min(hn::Min(b0, b1), hn::Min(b2, b3)),
               most = hn::Max(hn::Max(b0, b1), hn::Max(b2, b3));
    return hn::And(in_range, hn::Or(hn::Gt(least, bound), hn::Lt(most, hn::Neg(bound))));
}

template <bool faces, class D>
HWY_INLINE hn::Mask<D> proven_apart(D d, const Pairs<D>& pairs) {
    auto result = apart_on_axes<faces>(d, pairs);
    if (hn::AllTrue(d, result))
        return result;
    result = hn::Or(result, never_coplanar<faces>(d, pairs));
    if (hn::AllTrue(d, result))
        return result;
    return hn::Or(result, apart_on_diagonals<faces>(d, pairs));
}

template <bool faces, class D>
HWY_INLINE std::uint32_t possible_with(D d, const ElementaryBlock& block) {
    std::uint32_t possible = 0;
    for (std::size_t lane = 0; lane < ElementaryBlock::kLanes; lane += hn::Lanes(d)) {
        const Pairs<D> pairs(d, block, lane);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Not(proven_apart<faces>(d, pairs)), bits);
        possible |= (bits[0] & ((1U << hn::MaxLanes(d)) - 1)) << lane;
    }
    return possible;
}

using BlockLanes = hn::CappedTag<double, ElementaryBlock::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

std::uint32_t possible_simd(const ElementaryBlock& block, bool faces) {
    return faces ? possible_with<true>(BlockLanes(), block)
                 : possible_with<false>(BlockLanes(), block);
}
std::uint32_t possible_one(const ElementaryBlock& block, bool faces) {
    return faces ? possible_with<true>(OneLane(), block) : possible_with<false>(OneLane(), block);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(possible_simd);

std::uint32_t possible_impacts(const ElementaryBlock& block, ElementaryKind kind) {
    return HWY_DYNAMIC_DISPATCH(possible_simd)(block, kind == ElementaryKind::vertex_face);
}
std::uint32_t possible_impacts_reference(const ElementaryBlock& block, ElementaryKind kind) {
    return HWY_STATIC_DISPATCH(possible_one)(block, kind == ElementaryKind::vertex_face);
}

} // namespace abut
#endif
