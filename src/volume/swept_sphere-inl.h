// Gaps between one swept sphere and several.

// Included once for each target.
#if defined(ABUT_VOLUME_SWEPT_SPHERE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_SWEPT_SPHERE_INL_H
#undef ABUT_VOLUME_SWEPT_SPHERE_INL_H
#else
#define ABUT_VOLUME_SWEPT_SPHERE_INL_H
#endif

#include "volume/axis_gap-inl.h"
#include "volume/lower_bound.h"
#include "volume/sphere.h"
#include "volume/swept_sphere.h"

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// The cores of swept spheres: directions and half lengths.
template <class D, std::size_t n>
struct Core {
    // One element more than needed: a point's core has no direction, and arrays cannot be empty.
    Lanes3<D> direction[n + 1], dual[n + 1];
    hn::Vec<D> half[n + 1];
};

/// The shortest vector found so far from a point of one core to a point of the other.
template <class D>
struct Shortest {
    Lanes3<D> vector;
    hn::Vec<D> length_sq;

    HWY_INLINE void offer(const Lanes3<D>& v) {
        const auto sq = dot(v, v);
        const auto shorter = hn::Lt(sq, length_sq);
        length_sq = hn::IfThenElse(shorter, sq, length_sq);
        vector = if_then_else(shorter, v, vector);
    }
};

/// Clamps v to [-half, half].
template <class D>
HWY_INLINE hn::Vec<D> clamp_to(hn::Vec<D> v, hn::Vec<D> half) {
    return hn::Max(hn::Neg(half), hn::Min(v, half));
}

/// Quantities that depend on the directions and lengths of two segments, but not on their
/// positions.
template <class D>
struct SegmentPair {
    Lanes3<D> a, b;
    hn::Vec<D> half_a, half_b, cosine;
    Lanes3<D> to_a; ///< w . to_a is the parameter at which a's line is nearest to b's, where w goes
                    ///< from a's middle to b's

    HWY_INLINE SegmentPair(D d, const Lanes3<D>& direction_a, hn::Vec<D> length_a,
                           const Lanes3<D>& direction_b, hn::Vec<D> length_b)
        : a(direction_a), b(direction_b), half_a(length_a), half_b(length_b), cosine(dot(a, b)) {
        // s = w . (b x (a x b)) / |a x b|^2. For parallel lines every s is nearest; 0 is taken.
        const Lanes3<D> across = cross(a, b);
        const auto sine_sq = dot(across, across);
        const auto inverse = hn::IfThenElseZero(hn::Gt(sine_sq, hn::Set(d, 0x1p-40F)),
                                                hn::Div(hn::Set(d, 1.0F), sine_sq));
        const Lanes3<D> m = cross(b, across);
        to_a = {hn::Mul(inverse, m.x), hn::Mul(inverse, m.y), hn::Mul(inverse, m.z)};
    }

    /// The shortest vector from segment a to segment b. `w` goes from a's middle to b's.
    HWY_INLINE Lanes3<D> shortest(const Lanes3<D>& w) const {
        auto s = clamp_to<D>(dot(w, to_a), half_a);
        const auto p = clamp_to<D>(hn::MulSub(s, cosine, dot(w, b)), half_b);
        s = clamp_to<D>(hn::MulAdd(p, cosine, dot(w, a)), half_a);
        return minus_scaled(plus_scaled(w, p, b), s, a);
    }
};

/// The shortest vector between two rectangles that do not cross. It connects two edges, or a corner
/// and a face. `w` goes from a's middle to b's.
template <class D>
HWY_INLINE Lanes3<D> shortest_vector(D d, const Core<D, 2>& a, const Core<D, 2>& b,
                                     const Lanes3<D>& w) {
    Shortest<D> best{w, hn::Set(d, hwy::HighestValue<float>())};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            const SegmentPair<D> edges(d, a.direction[i], a.half[i], b.direction[j], b.half[j]);
            for (int corner = 0; corner < 4; ++corner) {
                const auto half_a = (corner & 1) != 0 ? a.half[1 - i] : hn::Neg(a.half[1 - i]);
                const auto half_b = (corner & 2) != 0 ? b.half[1 - j] : hn::Neg(b.half[1 - j]);
                best.offer(edges.shortest(minus_scaled(plus_scaled(w, half_b, b.direction[1 - j]),
                                                       half_a, a.direction[1 - i])));
            }
        }
    for (int corner = 0; corner < 4; ++corner) {
        const auto end = [&](const Core<D, 2>& core, int i) HWY_ATTR {
            return (corner >> i & 1) != 0 ? core.half[i] : hn::Neg(core.half[i]);
        };
        Lanes3<D> v =
            plus_scaled(plus_scaled(w, end(b, 0), b.direction[0]), end(b, 1), b.direction[1]);
        const auto s = clamp_to<D>(dot(v, a.dual[0]), a.half[0]),
                   t = clamp_to<D>(dot(v, a.dual[1]), a.half[1]);
        best.offer(minus_scaled(minus_scaled(v, s, a.direction[0]), t, a.direction[1]));
        v = plus_scaled(plus_scaled(w, end(a, 0), a.direction[0]), end(a, 1), a.direction[1]);
        const auto p = clamp_to<D>(dot(v, b.dual[0]), b.half[0]),
                   q = clamp_to<D>(dot(v, b.dual[1]), b.half[1]);
        best.offer(minus_scaled(minus_scaled(v, p, b.direction[0]), q, b.direction[1]));
    }
    return best.vector;
}
template <class D>
HWY_INLINE Lanes3<D> shortest_vector(D d, const Core<D, 1>& a, const Core<D, 1>& b,
                                     const Lanes3<D>& w) {
    return SegmentPair<D>(d, a.direction[0], a.half[0], b.direction[0], b.half[0]).shortest(w);
}
template <class D>
HWY_INLINE Lanes3<D> shortest_vector(D, const Core<D, 0>&, const Core<D, 0>&, const Lanes3<D>& w) {
    return w;
}

/// Removes from v its components along those core directions to which it is orthogonal up to
/// rounding. What remained would widen the core's extent along v and so narrow the gap.
template <class D, std::size_t n>
HWY_INLINE void straighten(Lanes3<D>& v, const Core<D, n>& core, hn::Vec<D> rounding) {
    for (std::size_t i = 0; i < n; ++i) {
        const auto along = dot(v, core.direction[i]);
        v = minus_scaled(v, hn::IfThenElseZero(hn::Lt(hn::Abs(along), rounding), along),
                         core.direction[i]);
    }
}

/// The gap between two cores along v: (v . w - sum_i half_i |v . direction_i|) / |v|.
template <class D, std::size_t n>
HWY_INLINE hn::Vec<D> gap_along(D d, const Lanes3<D>& v, const Core<D, n>& a, const Core<D, n>& b,
                                const Lanes3<D>& w) {
    auto gap = dot(v, w);
    for (std::size_t i = 0; i < n; ++i) {
        gap = hn::NegMulAdd(a.half[i], hn::Abs(dot(v, a.direction[i])), gap);
        gap = hn::NegMulAdd(b.half[i], hn::Abs(dot(v, b.direction[i])), gap);
    }
    const auto sq = dot(v, v);
    return hn::IfThenElseZero(hn::Gt(sq, hn::Set(d, 0x1p-100F)), hn::Div(gap, hn::Sqrt(sq)));
}

template <class D, std::size_t n>
HWY_INLINE Separation<D> separation_of_cores(D d, const float (*row)[VolumeBounds::kLanes],
                                             std::size_t lane, const SweptSphereImage<n>& one) {
    Core<D, n> a, b;
    const Lanes3<D> w = sub(set3(d, one.swept.centre), load3(d, row, lane));
    auto size = max_abs(w);
    for (std::size_t i = 0; i < n; ++i) {
        a.direction[i] = a.dual[i] = load3(d, row + 4 + 4 * i, lane);
        a.half[i] = hn::Load(d, row[4 + 4 * i + 3] + lane);
        b.direction[i] = set3(d, one.swept.axes[i].direction);
        b.dual[i] = set3(d, one.dual[i]);
        b.half[i] = hn::Set(d, one.swept.axes[i].half);
        size = hn::Add(size, hn::Add(a.half[i], b.half[i]));
    }
    Lanes3<D> v = shortest_vector(d, a, b, w);
    auto gap = gap_along(d, v, a, b, w);
    if constexpr (n > 0) {
        // Twice, because the directions of one core are not orthogonal to those of the other.
        const auto rounding = hn::Mul(size, hn::Set(d, 16 * 0x1p-24F));
        for (int i = 0; i < 2; ++i) {
            straighten(v, a, rounding);
            straighten(v, b, rounding);
        }
        gap = hn::Max(gap, gap_along(d, v, a, b, w));
    }
    gap = hn::Sub(gap,
                  hn::Add(hn::Load(d, row[3] + lane), hn::Set(d, one.swept.radius + one.margin)));
    return {gap, square_of_gap(d, gap)};
}

template <class D, std::size_t n>
HWY_INLINE Separation<D> separation(D d, const VolumeBatch<SweptSphere<n>>& batch, std::size_t lane,
                                    const SweptSphereImage<n>& one) {
    return separation_of_cores(d, batch.row, lane, one);
}
template <class D>
HWY_INLINE Separation<D> separation(D d, const VolumeBatch<BoundingSphere>& batch, std::size_t lane,
                                    const SweptSphereImage<0>& one) {
    return separation_of_cores(d, batch.row, lane, one);
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
