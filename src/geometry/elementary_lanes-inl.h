// Elementary pairs, lanes wide, and their patches: what the kernels on blocks of pairs share.

// Included once for each target.
#if defined(ABUT_ELEMENTARY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_ELEMENTARY_LANES_INL_H
#undef ABUT_ELEMENTARY_LANES_INL_H
#else
#define ABUT_ELEMENTARY_LANES_INL_H
#endif

#include "geometry/difference_patch.h"
#include "geometry/elementary_block.h"
#include "simd/simd.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::elementary {

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
    /// The same pair in all lanes.
    HWY_INLINE Pairs(D d, const ElementaryPair& pair) {
        const auto point = [&](const Vec3& v) HWY_ATTR {
            return Vec<D>{hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
        };
        for (std::size_t i = 0; i < 4; ++i)
            p[i][0] = point(pair.start[i]), p[i][1] = point(pair.end[i]);
    }
};

/// corner + x side_x + y side_y at both ends: see difference_patch.h.
template <class D>
struct Patches {
    Vec<D> corner[2], x[2], y[2];
    hn::Vec<D> size_c, size_x, size_y; ///< of their coordinates
    Vec<D> area_0, area_1, area_2; ///< x x y, its Bernstein coefficients, the middle one doubled

    template <bool faces>
    static HWY_INLINE Patches of(const Pairs<D>& pairs) {
        constexpr PatchLayout kLayout =
            patch_layout(faces ? ElementaryKind::vertex_face : ElementaryKind::edge_edge);
        Patches p;
        for (std::size_t end = 0; end < 2; ++end) {
            const auto difference = [&](const VertexDifference& d) HWY_ATTR {
                return sub<D>(pairs.p[d.to][end], pairs.p[d.from][end]);
            };
            p.corner[end] = difference(kLayout.corner);
            p.x[end] = difference(kLayout.side_x);
            p.y[end] = difference(kLayout.side_y);
        }
        p.size_c = hn::Max(max_abs<D>(p.corner[0]), max_abs<D>(p.corner[1]));
        p.size_x = hn::Max(max_abs<D>(p.x[0]), max_abs<D>(p.x[1]));
        p.size_y = hn::Max(max_abs<D>(p.y[0]), max_abs<D>(p.y[1]));
        p.area_0 = cross<D>(p.x[0], p.y[0]);
        p.area_1 = add<D>(cross<D>(p.x[0], p.y[1]), cross<D>(p.x[1], p.y[0]));
        p.area_2 = cross<D>(p.x[1], p.y[1]);
        return p;
    }
};

/// The bits of a mask, from bit 0 on.
template <class D>
HWY_INLINE std::uint32_t bits_of(D d, hn::Mask<D> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0] & ((1U << hn::MaxLanes(d)) - 1);
}

using BlockLanes = hn::CappedTag<double, ElementaryBlock::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

} // namespace abut::HWY_NAMESPACE::elementary
HWY_AFTER_NAMESPACE();

#endif
