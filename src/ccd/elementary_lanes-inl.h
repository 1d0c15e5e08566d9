// Elementary pairs and their patches, one per lane: shared by the kernels on batches of pairs.

// Included once for each target.
#if defined(ABUT_ELEMENTARY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_ELEMENTARY_LANES_INL_H
#undef ABUT_ELEMENTARY_LANES_INL_H
#else
#define ABUT_ELEMENTARY_LANES_INL_H
#endif

#include "ccd/difference_patch.h"
#include "ccd/elementary_batch.h"
#include "math/lanes-inl.h"

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::elementary {

/// The four vertices of each pair, at both ends of the motion.
template <class D>
struct Pairs {
    Lanes3<D> p[4][2];

    HWY_INLINE Pairs(D d, const ElementaryBatch& batch, std::size_t lane) {
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t end = 0; end < 2; ++end) {
                p[i][end] = load3(d, batch.v[i][end], lane);
            }
    }
    /// Sets all lanes to one pair.
    HWY_INLINE Pairs(D d, const ElementaryPair& pair) {
        const auto point = [&](const Vec3& v) HWY_ATTR {
            return Lanes3<D>{hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
        };
        for (std::size_t i = 0; i < 4; ++i)
            p[i][0] = point(pair.start[i]), p[i][1] = point(pair.end[i]);
    }
};

/// corner + x side_x + y side_y at both ends of the motion: see difference_patch.h.
template <class D>
struct Patches {
    Lanes3<D> corner[2], x[2], y[2];
    hn::Vec<D> size_c, size_x, size_y; ///< largest coordinates of corner, x and y
    Lanes3<D> area_0, area_1, area_2;  ///< Bernstein coefficients of x x y, the middle one doubled

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

using BatchLanes = hn::CappedTag<double, ElementaryBatch::kLanes>;
using OneLane = hn::CappedTag<double, 1>;

} // namespace abut::HWY_NAMESPACE::elementary
HWY_AFTER_NAMESPACE();

#endif
