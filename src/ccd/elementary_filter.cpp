#include "ccd/elementary_filter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ccd/elementary_filter.cpp"
#include "simd/foreach_target.h"
// Included once for each target:
#include "ccd/elementary_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace elementary; // NOLINT: within this target's namespace

/// The coplanarity corner . (x x y) by its Bernstein coefficients. The inner ones are tripled.
template <class D>
struct Coplanarity {
    hn::Vec<D> b0, b1_3, b2_3, b3;

    HWY_INLINE explicit Coplanarity(const Patches<D>& p)
        : b0(dot<D>(p.corner[0], p.area_0)),
          b1_3(hn::Add(dot<D>(p.corner[0], p.area_1), dot<D>(p.corner[1], p.area_0))),
          b2_3(hn::Add(dot<D>(p.corner[1], p.area_1), dot<D>(p.corner[0], p.area_2))),
          b3(dot<D>(p.corner[1], p.area_2)) {}
};

/// Lanes in which the four vertices are coplanar at no time: the coefficients have one sign.
///
/// With coordinates below C, X and Y, each tripled inner coefficient sums 18 products, each rounded
/// at most 11 times. Its error is at most 18 * 11 eps C X Y; that of the outer ones is smaller. The
/// last term covers underflow. Near overflow, nothing is certain.
template <class D>
HWY_INLINE hn::Mask<D> never_coplanar(D d, const Patches<D>& p) {
    const Coplanarity<D> f(p);
    const auto size_xy = hn::Mul(p.size_x, p.size_y), product = hn::Mul(size_xy, p.size_c);
    const auto tiny = hn::Set(d, 0x1p-1000), huge = hn::Set(d, 0x1p1000);
    const auto bound =
        hn::MulAdd(hn::Set(d, 200 * 0x1p-53), product, hn::MulAdd(tiny, p.size_c, tiny));
    const auto in_range = hn::And(hn::Lt(product, huge), hn::Lt(size_xy, huge));
    const auto least = hn::Min(hn::Min(f.b0, f.b1_3), hn::Min(f.b2_3, f.b3)),
               most = hn::Max(hn::Max(f.b0, f.b1_3), hn::Max(f.b2_3, f.b3));
    return hn::And(in_range, hn::Or(hn::Gt(least, bound), hn::Lt(most, hn::Neg(bound))));
}

/// Lanes in which the patch's plane is farther than the thickness D from the origin at all times,
/// always on one side: the coplanarity exceeds D |area|.
///
/// The length |area| is at most the quadratic whose Bernstein coefficients are the lengths of the
/// area's own. Raised to degree 3, the bound's coefficients are D times |a0|, (|a0| + 2 |a1|) / 3,
/// (2 |a1| + |a2|) / 3, |a2|. A coordinate of a0 is off by at most 10 eps X Y, one of 2 a1 by twice
/// as much. Lengths, sums and products bring that to less than 120 eps D X Y. The coplanarity's own
/// error is as above. If squares of sizes overflow or underflow, nothing is certain.
template <class D>
HWY_INLINE hn::Mask<D> never_near_plane(D d, const Patches<D>& p, hn::Vec<D> thickness) {
    const Coplanarity<D> f(p);
    const auto length = [](const Lanes3<D>& v) HWY_ATTR { return hn::Sqrt(dot<D>(v, v)); };
    const auto a0 = length(p.area_0), a1_2 = length(p.area_1), a2 = length(p.area_2);
    const auto m0 = hn::Mul(thickness, a0), m1 = hn::Mul(thickness, hn::Add(a0, a1_2)),
               m2 = hn::Mul(thickness, hn::Add(a1_2, a2)), m3 = hn::Mul(thickness, a2);

    const auto size_xy = hn::Mul(p.size_x, p.size_y),
               product = hn::Mul(size_xy, hn::Add(p.size_c, thickness));
    const auto tiny = hn::Set(d, 0x1p-1000);
    const auto bound =
        hn::MulAdd(hn::Set(d, 200 * 0x1p-53), product, hn::MulAdd(tiny, p.size_c, tiny));
    const auto in_range = hn::And(
        hn::And(hn::Gt(size_xy, hn::Set(d, 0x1p-400)), hn::Lt(size_xy, hn::Set(d, 0x1p400))),
        hn::Lt(product, hn::Set(d, 0x1p1000)));
    const auto above = hn::Min(hn::Min(hn::Sub(f.b0, m0), hn::Sub(f.b1_3, m1)),
                               hn::Min(hn::Sub(f.b2_3, m2), hn::Sub(f.b3, m3))),
               below = hn::Max(hn::Max(hn::Add(f.b0, m0), hn::Add(f.b1_3, m1)),
                               hn::Max(hn::Add(f.b2_3, m2), hn::Add(f.b3, m3)));
    return hn::And(in_range, hn::Or(hn::Gt(above, bound), hn::Lt(below, hn::Neg(bound))));
}

/// The clearance test of features without thickness: any positive gap along a direction suffices.
template <class D>
struct Touching {
    HWY_INLINE hn::Mask<D> on_axis(hn::Vec<D> above, hn::Vec<D> below) const {
        return hn::Gt(above, below);
    }
    HWY_INLINE hn::Mask<D> on_diagonal(hn::Vec<D> above, hn::Vec<D> below) const {
        return hn::Gt(above, below);
    }
    HWY_INLINE hn::Mask<D> off_plane(D d, const Patches<D>& p) const {
        return never_coplanar(d, p);
    }
};

/// The clearance test of features with a thickness: the gap must exceed it. Rounding is monotone,
/// so a rounded difference above the thickness was above it before rounding.
template <class D>
struct Thick {
    hn::Vec<D> thickness, diagonal;

    /// A diagonal has length sqrt(2). Coordinates along it are sums, each off by eps times twice
    /// the largest coordinate; the factor also covers its own rounding. Near overflow, nothing is
    /// certain.
    HWY_INLINE Thick(D d, const Pairs<D>& pairs, double thick) : thickness(hn::Set(d, thick)) {
        auto size = hn::Zero(d);
        for (const auto& vertex : pairs.p)
            for (const Lanes3<D>& p : vertex)
                size = hn::Max(size, max_abs<D>(p));
        const double root_2 = 1.4142135623731;
        diagonal = hn::MulAdd(hn::Set(d, 0x1p-50), size, hn::Set(d, root_2 * thick + 0x1p-1070));
        diagonal = hn::IfThenElse(hn::Lt(size, hn::Set(d, 0x1p1000)), diagonal, hn::Inf(d));
    }
    HWY_INLINE hn::Mask<D> on_axis(hn::Vec<D> above, hn::Vec<D> below) const {
        return hn::Gt(hn::Sub(above, below), thickness);
    }
    HWY_INLINE hn::Mask<D> on_diagonal(hn::Vec<D> above, hn::Vec<D> below) const {
        return hn::Gt(hn::Sub(above, below), diagonal);
    }
    HWY_INLINE hn::Mask<D> off_plane(D d, const Patches<D>& p) const {
        return never_near_plane(d, p, thickness);
    }
};

/// Lanes in which, along some direction, all of the first feature lies below all of the second at
/// both ends of the motion, or above, far enough for `far`. `along` gives a vertex's coordinate in
/// that direction. It is rounded at most once, so that the order of rounded coordinates is the
/// order of the exact ones.
template <bool faces, class D, class Along, class Far>
HWY_INLINE hn::Mask<D> apart(D /*d*/, const Pairs<D>& pairs, const Along& along, const Far& far) {
    hn::Mask<D> below[2], above[2];
    for (std::size_t end = 0; end < 2; ++end) {
        const auto s0 = along(pairs.p[0][end]), s1 = along(pairs.p[1][end]),
                   s2 = along(pairs.p[2][end]), s3 = along(pairs.p[3][end]);
        if constexpr (faces) {
            below[end] = far(hn::Min(s1, hn::Min(s2, s3)), s0);
            above[end] = far(s0, hn::Max(s1, hn::Max(s2, s3)));
        } else {
            below[end] = far(hn::Min(s2, s3), hn::Max(s0, s1));
            above[end] = far(hn::Min(s0, s1), hn::Max(s2, s3));
        }
    }
    return hn::Or(hn::And(below[0], below[1]), hn::And(above[0], above[1]));
}

template <bool faces, class D, class Clearance>
HWY_INLINE hn::Mask<D> apart_on_axes(D d, const Pairs<D>& pairs, const Clearance& clearance) {
    using P = const Lanes3<D>&;
    using V = hn::Vec<D>;
    const auto far = [&](V above, V below) HWY_ATTR { return clearance.on_axis(above, below); };
    const auto x = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return p.x; }, far);
    const auto y = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return p.y; }, far);
    const auto z = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return p.z; }, far);
    return hn::Or(x, hn::Or(y, z));
}

template <bool faces, class D, class Clearance>
HWY_INLINE hn::Mask<D> apart_on_diagonals(D d, const Pairs<D>& pairs, const Clearance& clearance) {
    using P = const Lanes3<D>&;
    using V = hn::Vec<D>;
    const auto far = [&](V above, V below) HWY_ATTR { return clearance.on_diagonal(above, below); };
    const auto xy = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return hn::Add(p.x, p.y); }, far);
    const auto yz = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return hn::Add(p.y, p.z); }, far);
    const auto zx = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return hn::Add(p.z, p.x); }, far);
    const auto x_y = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.x, p.y); }, far);
    const auto y_z = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.y, p.z); }, far);
    const auto z_x = apart<faces>(
        d, pairs, [](P p) HWY_ATTR { return hn::Sub(p.z, p.x); }, far);
    return hn::Or(hn::Or(xy, hn::Or(yz, zx)), hn::Or(x_y, hn::Or(y_z, z_x)));
}

template <bool faces, class D, class Clearance>
HWY_INLINE hn::Mask<D> proven_apart(D d, const Pairs<D>& pairs, const Clearance& clearance) {
    auto result = apart_on_axes<faces>(d, pairs, clearance);
    if (hn::AllTrue(d, result))
        return result;
    result = hn::Or(result, apart_on_diagonals<faces>(d, pairs, clearance));
    if (hn::AllTrue(d, result))
        return result;
    return hn::Or(result, clearance.off_plane(d, Patches<D>::template of<faces>(pairs)));
}

template <class D>
HWY_INLINE hn::Mask<D> proven_apart(D d, const Pairs<D>& pairs, bool faces) {
    return faces ? proven_apart<true>(d, pairs, Touching<D>())
                 : proven_apart<false>(d, pairs, Touching<D>());
}
template <class D>
HWY_INLINE hn::Mask<D> proven_farther(D d, const Pairs<D>& pairs, bool faces, double thickness) {
    const Thick<D> clearance(d, pairs, thickness);
    return faces ? proven_apart<true>(d, pairs, clearance)
                 : proven_apart<false>(d, pairs, clearance);
}

template <class D, class Proven>
HWY_INLINE std::uint32_t lanes_left(D d, const ElementaryBatch& batch, const Proven& proven) {
    std::uint32_t left = 0;
    for (std::size_t lane = 0; lane < ElementaryBatch::kLanes; lane += hn::Lanes(d)) {
        const Pairs<D> pairs(d, batch, lane);
        left |= bits_of(d, hn::Not(proven(pairs))) << lane;
    }
    return left;
}
template <class D>
HWY_INLINE std::uint32_t touching_with(D d, const ElementaryBatch& batch, bool faces) {
    return lanes_left(
        d, batch, [&](const Pairs<D>& pairs) HWY_ATTR { return proven_apart(d, pairs, faces); });
}
template <class D>
HWY_INLINE std::uint32_t within_with(D d, const ElementaryBatch& batch, bool faces,
                                     double thickness) {
    return lanes_left(d, batch, [&](const Pairs<D>& pairs) HWY_ATTR {
        return proven_farther(d, pairs, faces, thickness);
    });
}

// Separate functions, so that a test without a thickness has no branch for it.
std::uint32_t touching_simd(const ElementaryBatch& batch, bool faces) {
    return touching_with(BatchLanes(), batch, faces);
}
std::uint32_t within_simd(const ElementaryBatch& batch, bool faces, double thickness) {
    return within_with(BatchLanes(), batch, faces, thickness);
}
bool touching_single(const ElementaryPair& pair) {
    const OneLane d;
    return hn::AllFalse(
        d, proven_apart(d, Pairs<OneLane>(d, pair), pair.kind == ElementaryKind::vertex_face));
}
bool within_single(const ElementaryPair& pair, double thickness) {
    const OneLane d;
    return hn::AllFalse(d, proven_farther(d, Pairs<OneLane>(d, pair),
                                          pair.kind == ElementaryKind::vertex_face, thickness));
}
std::uint32_t touching_reference(const ElementaryBatch& batch, bool faces) {
    return touching_with(OneLane(), batch, faces);
}
std::uint32_t within_reference(const ElementaryBatch& batch, bool faces, double thickness) {
    return within_with(OneLane(), batch, faces, thickness);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(touching_simd);
HWY_EXPORT(within_simd);
HWY_EXPORT(touching_single);
HWY_EXPORT(within_single);

std::uint32_t possible_impacts(const ElementaryBatch& batch, ElementaryKind kind,
                               double thickness) {
    const bool faces = kind == ElementaryKind::vertex_face;
    return thickness > 0 ? HWY_DYNAMIC_DISPATCH(within_simd)(batch, faces, thickness)
                         : HWY_DYNAMIC_DISPATCH(touching_simd)(batch, faces);
}
bool possible_impact(const ElementaryPair& pair, double thickness) {
    return thickness > 0 ? HWY_DYNAMIC_DISPATCH(within_single)(pair, thickness)
                         : HWY_DYNAMIC_DISPATCH(touching_single)(pair);
}
std::uint32_t possible_impacts_reference(const ElementaryBatch& batch, ElementaryKind kind,
                                         double thickness) {
    const bool faces = kind == ElementaryKind::vertex_face;
    return thickness > 0 ? HWY_STATIC_DISPATCH(within_reference)(batch, faces, thickness)
                         : HWY_STATIC_DISPATCH(touching_reference)(batch, faces);
}

} // namespace abut
#endif
