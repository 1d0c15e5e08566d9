#include "geometry/elementary_crossing.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/elementary_crossing.cpp"
#include "simd/foreach_target.h"
// Once for each target:
#include "geometry/elementary_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace elementary; // NOLINT: within this target's namespace

constexpr double kEpsilon = 0x1p-53;

template <class D>
HWY_INLINE hn::Vec<D> blend(hn::Vec<D> one_minus_t, hn::Vec<D> t, hn::Vec<D> a, hn::Vec<D> b) {
    return hn::MulAdd(t, b, hn::Mul(one_minus_t, a));
}
template <class D>
HWY_INLINE Lanes3<D> blend(hn::Vec<D> one_minus_t, hn::Vec<D> t, const Lanes3<D> (&v)[2]) {
    return {blend<D>(one_minus_t, t, v[0].x, v[1].x), blend<D>(one_minus_t, t, v[0].y, v[1].y),
            blend<D>(one_minus_t, t, v[0].z, v[1].z)};
}

/// The coplanarity corner . (x x y), a cubic by its Bernstein coefficients, turned so that it ends
/// above where it begins.
template <class D>
struct Cubic {
    hn::Vec<D> b[4];
    hn::Vec<D> error; ///< of it, evaluated or not, at any time in [0, 1]

    HWY_INLINE Cubic(D d, const Patches<D>& p) {
        const auto third = hn::Set(d, 1.0 / 3);
        b[0] = dot<D>(p.corner[0], p.area_0);
        b[1] =
            hn::Mul(third, hn::Add(dot<D>(p.corner[0], p.area_1), dot<D>(p.corner[1], p.area_0)));
        b[2] =
            hn::Mul(third, hn::Add(dot<D>(p.corner[1], p.area_1), dot<D>(p.corner[0], p.area_2)));
        b[3] = dot<D>(p.corner[1], p.area_2);
        const auto falls = hn::Gt(b[0], b[3]);
        for (auto& each : b)
            each = hn::IfThenElse(falls, hn::Neg(each), each);
        // Six products, 13 roundings at most; an evaluation is three blends of rounded weights, off
        // by 4 eps each. Products near overflow leave nothing certain.
        const auto size =
            hn::Max(hn::Max(hn::Abs(b[0]), hn::Abs(b[1])), hn::Max(hn::Abs(b[2]), hn::Abs(b[3])));
        const auto size_xy = hn::Mul(p.size_x, p.size_y), product = hn::Mul(size_xy, p.size_c);
        const auto tiny = hn::Set(d, 0x1p-1000), huge = hn::Set(d, 0x1p1000);
        error = hn::MulAdd(
            hn::Set(d, 80 * kEpsilon), product,
            hn::MulAdd(hn::Set(d, 16 * kEpsilon), size, hn::MulAdd(tiny, p.size_c, tiny)));
        const auto in_range = hn::And(hn::Lt(product, huge), hn::Lt(size_xy, huge));
        error = hn::IfThenElse(in_range, error, hn::Inf(d));
    }

    /// It begins certainly below zero and ends above.
    HWY_INLINE hn::Mask<D> rises() const {
        return hn::And(hn::Lt(b[0], hn::Neg(error)), hn::Gt(b[3], error));
    }

    struct Root {
        hn::Vec<D> t, slope;
    };
    /// Newton's method from the secant, kept between points of known sign. In: it rises.
    HWY_INLINE Root root(D d) const {
        const auto three = hn::Set(d, 3.0), half = hn::Set(d, 0.5);
        const auto c1 = hn::Mul(three, hn::Sub(b[1], b[0]));
        const auto c2 = hn::Mul(three, hn::Sub(hn::Sub(b[2], b[1]), hn::Sub(b[1], b[0])));
        const auto c3 = hn::MulAdd(three, hn::Sub(b[1], b[2]), hn::Sub(b[3], b[0]));
        auto low = hn::Zero(d), high = hn::Set(d, 1.0), slope = c1;
        auto t = hn::Div(b[0], hn::Sub(b[0], b[3]));
        constexpr int kMostSteps = 9;
        // A lane that has converged stays as it is: its answer must not depend on the others.
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

    /// Where it is certainly below zero all of [0, t]: the coefficients over that part are.
    HWY_INLINE hn::Mask<D> below_until(D d, hn::Vec<D> t) const {
        const auto s = hn::Sub(hn::Set(d, 1.0), t);
        const auto b01 = blend<D>(s, t, b[0], b[1]), b12 = blend<D>(s, t, b[1], b[2]),
                   b23 = blend<D>(s, t, b[2], b[3]);
        const auto b012 = blend<D>(s, t, b01, b12), b123 = blend<D>(s, t, b12, b23);
        const auto most = hn::Max(hn::Max(b[0], b01), hn::Max(b012, blend<D>(s, t, b012, b123)));
        return hn::Lt(most, hn::Neg(error));
    }
    /// The same of [t, 1], above zero.
    HWY_INLINE hn::Mask<D> above_from(D d, hn::Vec<D> t) const {
        const auto s = hn::Sub(hn::Set(d, 1.0), t);
        const auto b01 = blend<D>(s, t, b[0], b[1]), b12 = blend<D>(s, t, b[1], b[2]),
                   b23 = blend<D>(s, t, b[2], b[3]);
        const auto b012 = blend<D>(s, t, b01, b12), b123 = blend<D>(s, t, b12, b23);
        const auto least = hn::Min(hn::Min(b[3], b23), hn::Min(b123, blend<D>(s, t, b012, b123)));
        return hn::Gt(least, error);
    }
};

/// Twice an area as seen along a direction, and what it may be off by.
template <class D>
struct Area {
    hn::Vec<D> value, error;
};
template <class D>
HWY_INLINE Area<D> sub(D d, const Area<D>& a, const Area<D>& b) {
    const auto value = hn::Sub(a.value, b.value);
    const auto rounding = hn::Mul(hn::Set(d, 2 * kEpsilon), hn::Abs(value));
    return {value, hn::Add(hn::Add(a.error, b.error), rounding)};
}

/// A vector in the middle of an interval of times.
template <class D>
struct Middle {
    Lanes3<D> v;
    hn::Vec<D> size, off; ///< of its coordinates; what they may be off by during the interval
};

/// m . (u x v), m at most 1 in each coordinate: six products, each off by what its factors are off
/// by, and by 8 roundings.
template <class D>
HWY_INLINE Area<D> seen(D d, const Middle<D>& u, const Middle<D>& v, const Lanes3<D>& m) {
    const auto sizes = hn::Mul(hn::Set(d, 8 * kEpsilon), hn::Mul(u.size, v.size));
    const auto off = hn::MulAdd(u.off, hn::Add(v.size, v.off), hn::MulAdd(u.size, v.off, sizes));
    return {dot<D>(m, cross<D>(u.v, v.v)), hn::MulAdd(hn::Set(d, 6.2), off, hn::Set(d, 0x1p-900))};
}

template <bool faces, class D>
HWY_INLINE void decide_lanes(D d, const Pairs<D>& pairs, std::size_t lane, CrossingBlock& result) {
    const auto one = hn::Set(d, 1.0), zero = hn::Zero(d), half = hn::Set(d, 0.5);
    const auto p = Patches<D>::template of<faces>(pairs);
    const Cubic<D> cubic(d, p);
    const auto rises = cubic.rises();
    if (hn::AllFalse(d, rises))
        return;

    // An interval around the root, outside which there is no other.
    const auto [root, slope] = cubic.root(d);
    const auto width = hn::Add(hn::Div(hn::Add(cubic.error, cubic.error), hn::Abs(slope)),
                               hn::Set(d, 4 * kEpsilon));
    const auto start = hn::Max(hn::Sub(root, width), zero),
               end = hn::Min(hn::Add(root, width), one);
    const auto length = hn::Sub(end, start);
    const auto enclosed = hn::And(hn::And(rises, hn::Lt(length, hn::Set(d, 0.9e-9))),
                                  hn::And(cubic.below_until(d, start), cubic.above_from(d, end)));

    // Whether the patch holds the origin during it, or never: see OriginTest in
    // elementary_interval.cpp.
    const auto t = hn::Mul(half, hn::Add(start, end)), s = hn::Sub(one, t);
    const auto part = hn::MulAdd(hn::Set(d, 2.01), length, hn::Set(d, 8 * kEpsilon));
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
    result.meet |= bits_of(d, hn::And(decidable, above)) << lane;
    result.apart |= bits_of(d, hn::And(decidable, below)) << lane;

    hn::StoreU(start, d, result.time + lane);
    hn::StoreU(hn::Div(at_x.value, whole.value), d, result.x + lane);
    hn::StoreU(hn::Div(at_y.value, whole.value), d, result.y + lane);
    hn::StoreU(m.x, d, result.normal[0] + lane);
    hn::StoreU(m.y, d, result.normal[1] + lane);
    hn::StoreU(m.z, d, result.normal[2] + lane);
}

template <class D>
HWY_INLINE void decide_with(D d, const ElementaryBlock& block, bool faces, CrossingBlock& result) {
    result.apart = result.meet = 0;
    for (std::size_t lane = 0; lane < ElementaryBlock::kLanes; lane += hn::Lanes(d)) {
        const Pairs<D> pairs(d, block, lane);
        faces ? decide_lanes<true>(d, pairs, lane, result)
              : decide_lanes<false>(d, pairs, lane, result);
    }
}

void decide_simd(const ElementaryBlock& block, bool faces, CrossingBlock& result) {
    decide_with(BlockLanes(), block, faces, result);
}
void decide_reference(const ElementaryBlock& block, bool faces, CrossingBlock& result) {
    decide_with(OneLane(), block, faces, result);
}
void decide_single(const ElementaryPair& pair, CrossingBlock& result) {
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

void decide_crossings(const ElementaryBlock& block, ElementaryKind kind, CrossingBlock& result) {
    HWY_DYNAMIC_DISPATCH(decide_simd)(block, kind == ElementaryKind::vertex_face, result);
}
void decide_crossing(const ElementaryPair& pair, CrossingBlock& result) {
    HWY_DYNAMIC_DISPATCH(decide_single)(pair, result);
}
void decide_crossings_reference(const ElementaryBlock& block, ElementaryKind kind,
                                CrossingBlock& result) {
    HWY_STATIC_DISPATCH(decide_reference)(block, kind == ElementaryKind::vertex_face, result);
}

} // namespace abut
#endif
