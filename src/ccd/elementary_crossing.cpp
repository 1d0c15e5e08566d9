#include "ccd/elementary_crossing.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ccd/elementary_crossing.cpp"
#include "simd/foreach_target.h"
// Included once for each target:
#include "ccd/elementary_lanes-inl.h"
#include "math/rounding.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace elementary; // NOLINT: within this target's namespace

template <class D>
HWY_INLINE hn::Vec<D> blend(hn::Vec<D> one_minus_t, hn::Vec<D> t, hn::Vec<D> a, hn::Vec<D> b) {
    return hn::MulAdd(t, b, hn::Mul(one_minus_t, a));
}
template <class D>
HWY_INLINE Lanes3<D> blend(hn::Vec<D> one_minus_t, hn::Vec<D> t, const Lanes3<D> (&v)[2]) {
    return {blend<D>(one_minus_t, t, v[0].x, v[1].x), blend<D>(one_minus_t, t, v[0].y, v[1].y),
            blend<D>(one_minus_t, t, v[0].z, v[1].z)};
}

/// A cubic over a part of [0, 1], by its Bernstein coefficients.
template <class D>
struct Cubic {
    hn::Vec<D> b[4];
    hn::Vec<D> error; ///< error bound of a coefficient, and of a value at any time of the part

    /// The coplanarity corner . (x x y) over [0, 1].
    static HWY_INLINE Cubic of(D d, const Patches<D>& p) {
        Cubic c;
        const auto third = hn::Set(d, 1.0 / 3);
        c.b[0] = dot<D>(p.corner[0], p.area_0);
        c.b[1] =
            hn::Mul(third, hn::Add(dot<D>(p.corner[0], p.area_1), dot<D>(p.corner[1], p.area_0)));
        c.b[2] =
            hn::Mul(third, hn::Add(dot<D>(p.corner[1], p.area_1), dot<D>(p.corner[0], p.area_2)));
        c.b[3] = dot<D>(p.corner[1], p.area_2);
        // A coefficient has six products with at most 13 roundings. An evaluation is three blends
        // with rounded weights, each off by 4 eps; the split that made a half is off by as much.
        // Near overflow, nothing is certain.
        const auto size = hn::Max(hn::Max(hn::Abs(c.b[0]), hn::Abs(c.b[1])),
                                  hn::Max(hn::Abs(c.b[2]), hn::Abs(c.b[3])));
        const auto size_xy = hn::Mul(p.size_x, p.size_y), product = hn::Mul(size_xy, p.size_c);
        const auto tiny = hn::Set(d, 0x1p-1000), huge = hn::Set(d, 0x1p1000);
        const auto error = hn::MulAdd(
            hn::Set(d, 80 * kUnitRoundoff), product,
            hn::MulAdd(hn::Set(d, 32 * kUnitRoundoff), size, hn::MulAdd(tiny, p.size_c, tiny)));
        const auto in_range = hn::And(hn::Lt(product, huge), hn::Lt(size_xy, huge));
        c.error = hn::IfThenElse(in_range, error, hn::Inf(d));
        return c;
    }

    HWY_INLINE void negate() {
        for (auto& each : b)
            each = hn::Neg(each);
    }
    HWY_INLINE void negate_where(hn::Mask<D> mask) {
        for (auto& each : b)
            each = hn::IfThenElse(mask, hn::Neg(each), each);
    }
    /// The cubics over the part before t and over the part after it.
    struct Halves;
    [[nodiscard]] HWY_INLINE Halves split(D d, hn::Vec<D> t) const;

    [[nodiscard]] HWY_INLINE hn::Mask<D> is_below() const {
        const auto most = hn::Max(hn::Max(b[0], b[1]), hn::Max(b[2], b[3]));
        return hn::Lt(most, hn::Neg(error));
    }
    [[nodiscard]] HWY_INLINE hn::Mask<D> is_above() const {
        const auto least = hn::Min(hn::Min(b[0], b[1]), hn::Min(b[2], b[3]));
        return hn::Gt(least, error);
    }
    /// The cubic certainly begins below zero and ends above it.
    [[nodiscard]] HWY_INLINE hn::Mask<D> rises() const {
        return hn::And(hn::Lt(b[0], hn::Neg(error)), hn::Gt(b[3], error));
    }
    /// The approximate time of the maximum within the part. If there is none, some time within the
    /// part.
    [[nodiscard]] HWY_INLINE hn::Vec<D> maximum(D d) const {
        // b'(t) / 3 = c2 t^2 + 2 c1 t + c0; takes the root at which b' changes from plus to minus.
        const auto c0 = hn::Sub(b[1], b[0]), c1 = hn::Sub(hn::Sub(b[2], b[1]), c0),
                   c2 = hn::Sub(hn::Sub(hn::Sub(b[3], b[2]), hn::Sub(b[2], b[1])), c1);
        const auto root = hn::Sqrt(hn::Max(hn::Zero(d), hn::Sub(hn::Mul(c1, c1), hn::Mul(c0, c2))));
        const auto t = hn::IfThenElse(hn::Lt(c1, hn::Zero(d)), hn::Div(c0, hn::Sub(root, c1)),
                                      hn::Div(hn::Neg(hn::Add(root, c1)), c2));
        const auto within = hn::And(hn::Ge(t, hn::Zero(d)), hn::Le(t, hn::Set(d, 1.0)));
        return hn::IfThenElse(within, t, hn::Set(d, 0.5));
    }

    struct Root {
        hn::Vec<D> t, slope;
    };
    /// Newton's method from the secant's root, kept between points of known sign. In: the cubic
    /// rises.
    HWY_INLINE Root root(D d) const {
        const auto three = hn::Set(d, 3.0), half = hn::Set(d, 0.5);
        const auto c1 = hn::Mul(three, hn::Sub(b[1], b[0]));
        const auto c2 = hn::Mul(three, hn::Sub(hn::Sub(b[2], b[1]), hn::Sub(b[1], b[0])));
        const auto c3 = hn::MulAdd(three, hn::Sub(b[1], b[2]), hn::Sub(b[3], b[0]));
        auto low = hn::Zero(d), high = hn::Set(d, 1.0), slope = c1;
        auto t = hn::Div(b[0], hn::Sub(b[0], b[3]));
        constexpr int kMostSteps = 9;
        // A converged lane no longer changes: its answer must not depend on the other lanes.
        auto active = rises();
        for (int i = 0; i < kMostSteps && !hn::AllFalse(d, active); ++i) {
            const auto f = hn::MulAdd(t, hn::MulAdd(t, hn::MulAdd(t, c3, c2), c1), b[0]);
            const auto here = hn::MulAdd(t, hn::MulAdd(t, hn::Mul(three, c3), hn::Add(c2, c2)), c1);
            slope = hn::IfThenElse(active, here, slope);
            const auto below = hn::Lt(f, hn::Zero(d));
            low = hn::IfThenElse(below, t, low);
            high = hn::IfThenElse(below, high, t);
            auto next = hn::Sub(t, hn::Div(f, slope));
            const auto between = hn::And(hn::Ge(next, low), hn::Le(next, high));
            next = hn::IfThenElse(between, next, hn::Mul(half, hn::Add(low, high)));
            const auto step = hn::Abs(hn::Sub(next, t));
            t = hn::IfThenElse(active, next, t);
            active = hn::And(active, hn::Gt(step, hn::Set(d, 0x1p-36)));
        }
        return {t, slope};
    }
};

template <class D>
struct Cubic<D>::Halves {
    Cubic before, after;
};

template <class D>
HWY_INLINE typename Cubic<D>::Halves Cubic<D>::split(D d, hn::Vec<D> t) const {
    const auto s = hn::Sub(hn::Set(d, 1.0), t);
    const auto b01 = blend<D>(s, t, b[0], b[1]), b12 = blend<D>(s, t, b[1], b[2]),
               b23 = blend<D>(s, t, b[2], b[3]);
    const auto b012 = blend<D>(s, t, b01, b12), b123 = blend<D>(s, t, b12, b23);
    const auto here = blend<D>(s, t, b012, b123);
    return {{{b[0], b01, b012, here}, error}, {{here, b123, b23, b[3]}, error}};
}

/// Twice an area projected along a direction, and a bound on its error.
template <class D>
struct Area {
    hn::Vec<D> value, error;
};
template <class D>
HWY_INLINE Area<D> sub(D d, const Area<D>& a, const Area<D>& b) {
    const auto value = hn::Sub(a.value, b.value);
    const auto rounding = hn::Mul(hn::Set(d, 2 * kUnitRoundoff), hn::Abs(value));
    return {value, hn::Add(hn::Add(a.error, b.error), rounding)};
}

/// A vector at the middle of a time interval.
template <class D>
struct Middle {
    Lanes3<D> v;
    hn::Vec<D> size, off; ///< largest coordinate; bound on a coordinate's error and change during
                          ///< the interval
};

/// m . (u x v), where no coordinate of m exceeds 1. It has six products. Each is off by its
/// factors' errors and by 8 roundings.
template <class D>
HWY_INLINE Area<D> seen(D d, const Middle<D>& u, const Middle<D>& v, const Lanes3<D>& m) {
    const auto sizes = hn::Mul(hn::Set(d, 8 * kUnitRoundoff), hn::Mul(u.size, v.size));
    const auto off = hn::MulAdd(u.off, hn::Add(v.size, v.off), hn::MulAdd(u.size, v.off, sizes));
    return {dot<D>(m, cross<D>(u.v, v.v)), hn::MulAdd(hn::Set(d, 6.2), off, hn::Set(d, 0x1p-900))};
}

/// What is known about the time at which the cubic rises through zero.
template <class D>
struct Crossing {
    hn::Mask<D> meet, apart;
    hn::Vec<D> time, x, y; ///< valid where `meet` is set
    Lanes3<D> normal;
};

/// Decides whether the patch holds the origin at the only root of a cubic that rises over [low,
/// high].
template <bool faces, class D>
HWY_INLINE Crossing<D> decide_root(D d, const Patches<D>& p, const Cubic<D>& cubic, hn::Vec<D> low,
                                   hn::Vec<D> high) {
    const auto one = hn::Set(d, 1.0), zero = hn::Zero(d), half = hn::Set(d, 0.5);

    // An interval around the root that certainly holds all roots.
    const auto [root, slope] = cubic.root(d);
    const auto width = hn::Add(hn::Div(hn::Add(cubic.error, cubic.error), hn::Abs(slope)),
                               hn::Set(d, 4 * kUnitRoundoff));
    const auto part_start = hn::Max(hn::Sub(root, width), zero),
               part_end = hn::Min(hn::Add(root, width), one);
    const auto alone = hn::And(cubic.split(d, part_start).before.is_below(),
                               cubic.split(d, part_end).after.is_above());
    const auto extent = hn::Sub(high, low), slack = hn::Set(d, 4 * kUnitRoundoff);
    const auto start = hn::Max(hn::Sub(hn::MulAdd(extent, part_start, low), slack), zero),
               end = hn::Min(hn::Add(hn::MulAdd(extent, part_end, low), slack), one);
    const auto length = hn::Sub(end, start);
    const auto enclosed =
        hn::And(hn::And(cubic.rises(), hn::Lt(length, hn::Set(d, 0.9e-9))), alone);

    // Decides whether the patch holds the origin throughout the interval, or never: see OriginTest
    // in elementary_interval.cpp.
    const auto t = hn::Mul(half, hn::Add(start, end)), s = hn::Sub(one, t);
    const auto part = hn::MulAdd(hn::Set(d, 2.01), length, hn::Set(d, 8 * kUnitRoundoff));
    const auto middle = [&](const Lanes3<D>(&v)[2], hn::Vec<D> size) HWY_ATTR {
        const Lanes3<D> at = blend<D>(s, t, v);
        return Middle<D>{at, max_abs<D>(at), hn::Mul(part, size)};
    };
    const Middle<D> corner = middle(p.corner, p.size_c), x = middle(p.x, p.size_x),
                    y = middle(p.y, p.size_y);
    Lanes3<D> m = cross<D>(x.v, y.v);
    const auto size_m = max_abs<D>(m), scale = hn::Div(one, size_m);
    m = {hn::Mul(m.x, scale), hn::Mul(m.y, scale), hn::Mul(m.z, scale)};
    const auto in_range =
        hn::And(hn::Gt(size_m, hn::Set(d, 0x1p-900)),
                hn::Lt(hn::Max(p.size_c, hn::Max(p.size_x, p.size_y)), hn::Set(d, 0x1p450)));
    const Area<D> whole = seen(d, x, y, m), at_x = seen(d, y, corner, m),
                  at_y = seen(d, corner, x, m);
    const Area<D> not_x = sub(d, whole, at_x);
    const Area<D> rest[2] = {faces ? sub(d, not_x, at_y) : not_x,
                             faces ? at_x : sub(d, whole, at_y)};
    auto above = hn::Gt(whole.value, whole.error);
    auto below = hn::And(above, hn::Not(above));
    for (const Area<D>& area : {at_x, at_y, rest[0], rest[1]}) {
        above = hn::And(above, hn::Gt(area.value, area.error));
        below = hn::Or(below, hn::Lt(area.value, hn::Neg(area.error)));
    }
    const auto decidable = hn::And(enclosed, in_range);
    below = hn::And(below, hn::Gt(whole.value, whole.error));
    return {hn::And(decidable, above),        hn::And(decidable, below),        start,
            hn::Div(at_x.value, whole.value), hn::Div(at_y.value, whole.value), m};
}

/// Copies b to a in the lanes of the mask.
template <class D>
HWY_INLINE void take_where(D /*d*/, hn::Mask<D> mask, const Crossing<D>& b, Crossing<D>& a) {
    a.meet = hn::Or(a.meet, hn::And(mask, b.meet));
    a.apart = hn::Or(hn::And(hn::Not(mask), a.apart), hn::And(mask, b.apart));
    a.time = hn::IfThenElse(mask, b.time, a.time);
    a.x = hn::IfThenElse(mask, b.x, a.x);
    a.y = hn::IfThenElse(mask, b.y, a.y);
    a.normal = if_then_else<D>(mask, b.normal, a.normal);
}

template <bool faces, class D>
HWY_INLINE void decide_lanes(D d, const Pairs<D>& pairs, std::size_t lane, CrossingBatch& result) {
    const auto one = hn::Set(d, 1.0), zero = hn::Zero(d);
    const auto p = Patches<D>::template of<faces>(pairs);
    Cubic<D> cubic = Cubic<D>::of(d, p);
    cubic.negate_where(hn::Gt(cubic.b[0], zero)); // so that it begins below zero
    const auto begins_below = hn::Lt(cubic.b[0], hn::Neg(cubic.error));
    const auto ends_below = hn::And(begins_below, hn::Lt(cubic.b[3], hn::Neg(cubic.error)));

    // A cubic that also ends below zero is cut at its maximum. Either it rises before the cut and
    // falls after it, or it has no root.
    const auto cut = hn::IfThenElse(ends_below, cubic.maximum(d), one);
    auto [before, after] = cubic.split(d, cut);
    const auto rootless = hn::And(ends_below, hn::And(before.is_below(), after.is_below()));
    const auto rises = before.rises();
    if (hn::AllFalse(d, hn::Or(rises, rootless)))
        return;
    Crossing<D> crossing = decide_root<faces>(d, p, before, zero, cut);
    const auto again = hn::And(ends_below, crossing.apart);
    if (!hn::AllFalse(d, again)) {
        after.negate(); // so that it rises
        take_where(d, again, decide_root<faces>(d, p, after, cut, one), crossing);
    }
    result.meet |= bits_of(d, crossing.meet) << lane;
    result.apart |= bits_of(d, hn::Or(crossing.apart, rootless)) << lane;

    hn::StoreU(crossing.time, d, result.time + lane);
    hn::StoreU(crossing.x, d, result.x + lane);
    hn::StoreU(crossing.y, d, result.y + lane);
    hn::StoreU(crossing.normal.x, d, result.normal[0] + lane);
    hn::StoreU(crossing.normal.y, d, result.normal[1] + lane);
    hn::StoreU(crossing.normal.z, d, result.normal[2] + lane);
}

template <class D>
HWY_INLINE void decide_with(D d, const ElementaryBatch& batch, bool faces, CrossingBatch& result) {
    result.apart = result.meet = 0;
    for (std::size_t lane = 0; lane < ElementaryBatch::kLanes; lane += hn::Lanes(d)) {
        const Pairs<D> pairs(d, batch, lane);
        faces ? decide_lanes<true>(d, pairs, lane, result)
              : decide_lanes<false>(d, pairs, lane, result);
    }
}

void decide_simd(const ElementaryBatch& batch, bool faces, CrossingBatch& result) {
    decide_with(BatchLanes(), batch, faces, result);
}
void decide_reference(const ElementaryBatch& batch, bool faces, CrossingBatch& result) {
    decide_with(OneLane(), batch, faces, result);
}
void decide_single(const ElementaryPair& pair, CrossingBatch& result) {
    const OneLane d;
    const Pairs<OneLane> pairs(d, pair);
    result.apart = result.meet = 0;
    pair.kind == ElementaryKind::vertex_face ? decide_lanes<true>(d, pairs, 0, result)
                                             : decide_lanes<false>(d, pairs, 0, result);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(decide_simd);
HWY_EXPORT(decide_single);

void decide_crossings(const ElementaryBatch& batch, ElementaryKind kind, CrossingBatch& result) {
    HWY_DYNAMIC_DISPATCH(decide_simd)(batch, kind == ElementaryKind::vertex_face, result);
}
void decide_crossing(const ElementaryPair& pair, CrossingBatch& result) {
    HWY_DYNAMIC_DISPATCH(decide_single)(pair, result);
}
void decide_crossings_reference(const ElementaryBatch& batch, ElementaryKind kind,
                                CrossingBatch& result) {
    HWY_STATIC_DISPATCH(decide_reference)(batch, kind == ElementaryKind::vertex_face, result);
}

} // namespace abut
#endif
