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

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

/// The cores of swept spheres: directions and half lengths.
template <class D, std::size_t n>
struct Core {
    // One element more than needed: a point's core has no direction, and arrays cannot be empty.
    Lanes3<D> direction[n + 1], dual[n + 1];
    hn::Vec<D> half[n + 1];
    bool is_slanted = false; ///< a parallelogram that is no rectangle
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

/// The corner of a core whose sides are given by the bits of `corner`, less the core's middle.
template <class D, std::size_t n>
HWY_INLINE Lanes3<D> plus_corner(const Core<D, n>& core, unsigned corner, Lanes3<D> v) {
    for (std::size_t i = 0; i < n; ++i)
        v = plus_scaled(v, (corner >> i & 1U) != 0 ? core.half[i] : hn::Neg(core.half[i]),
                        core.direction[i]);
    return v;
}

/// The shortest vector from a core to a point, or the opposite one from a point to a core. `v`
/// comes from the core's middle, or goes to it.
template <class D, std::size_t n>
HWY_INLINE Lanes3<D> shortest_to_point(const Core<D, n>& core, const Lanes3<D>& v) {
    Lanes3<D> shortest = v;
    for (std::size_t i = 0; i < n; ++i)
        shortest = minus_scaled(shortest, clamp_to<D>(dot(v, core.dual[i]), core.half[i]),
                                core.direction[i]);
    return shortest;
}

/// The shortest vector between two cores that do not cross. `w` goes from a's middle to b's. For a
/// rectangle and a rectangle or a segment, it connects two edges, or a corner and a face.
template <class D, std::size_t n, std::size_t m>
HWY_INLINE Lanes3<D> shortest_vector(D d, const Core<D, n>& a, const Core<D, m>& b,
                                     const Lanes3<D>& w) {
    if constexpr (n == 0 && m == 0) {
        return w;
    } else if constexpr (n == 0 && m == 1) {
        return shortest_to_point(b, w);
    } else if constexpr (n == 0) {
        const Lanes3<D> to_face = shortest_to_point(b, w);
        if (!b.is_slanted)
            return to_face;
        // The nearest point of a parallelogram may lie on an edge that the clamped parameters miss.
        Shortest<D> best{to_face, dot(to_face, to_face)};
        for (unsigned corner = 0; corner < 4; ++corner) {
            const std::size_t i = corner >> 1U;
            const Lanes3<D> to_edge = plus_scaled(
                w, (corner & 1U) != 0 ? b.half[1 - i] : hn::Neg(b.half[1 - i]), b.direction[1 - i]);
            best.offer(minus_scaled(to_edge, clamp_to<D>(dot(to_edge, b.direction[i]), b.half[i]),
                                    b.direction[i]));
        }
        return best.vector;
    } else if constexpr (m == 0) {
        return shortest_to_point(a, w);
    } else if constexpr (n == 1 && m == 1) {
        return SegmentPair<D>(d, a.direction[0], a.half[0], b.direction[0], b.half[0]).shortest(w);
    } else {
        Shortest<D> best{w, hn::Set(d, hwy::HighestValue<float>())};
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < m; ++j) {
                const SegmentPair<D> edges(d, a.direction[i], a.half[i], b.direction[j], b.half[j]);
                // The edges along these directions lie on two sides of a rectangle.
                for (unsigned b_side = 0; b_side < m; ++b_side)
                    for (unsigned a_side = 0; a_side < n; ++a_side) {
                        Lanes3<D> between = w;
                        if constexpr (m == 2)
                            between = plus_scaled(
                                between, b_side != 0 ? b.half[1 - j] : hn::Neg(b.half[1 - j]),
                                b.direction[1 - j]);
                        if constexpr (n == 2)
                            between = minus_scaled(
                                between, a_side != 0 ? a.half[1 - i] : hn::Neg(a.half[1 - i]),
                                a.direction[1 - i]);
                        best.offer(edges.shortest(between));
                    }
            }
        for (unsigned corner = 0; corner < 4; ++corner) {
            if constexpr (n == 2)
                if (corner < 1U << m)
                    best.offer(shortest_to_point(a, plus_corner(b, corner, w)));
            if constexpr (m == 2)
                if (corner < 1U << n)
                    best.offer(shortest_to_point(b, plus_corner(a, corner, w)));
        }
        return best.vector;
    }
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
template <class D, std::size_t n, std::size_t m>
HWY_INLINE hn::Vec<D> gap_along(D d, const Lanes3<D>& v, const Core<D, n>& a, const Core<D, m>& b,
                                const Lanes3<D>& w) {
    auto gap = dot(v, w);
    for (std::size_t i = 0; i < std::max(n, m); ++i) {
        if (i < n)
            gap = hn::NegMulAdd(a.half[i], hn::Abs(dot(v, a.direction[i])), gap);
        if (i < m)
            gap = hn::NegMulAdd(b.half[i], hn::Abs(dot(v, b.direction[i])), gap);
    }
    const auto sq = dot(v, v);
    return hn::IfThenElseZero(hn::Gt(sq, hn::Set(d, 0x1p-100F)), hn::Div(gap, hn::Sqrt(sq)));
}

/// Gaps between the batch's swept spheres with cores of dimension n and one with a core of
/// dimension m, which uses the first m axes of `one`.
template <std::size_t n, std::size_t m, class D, std::size_t axes>
HWY_INLINE Separation<D> separation_of_cores(D d, const float (*row)[VolumeBounds::kLanes],
                                             std::size_t lane, const SweptSphereImage<axes>& one) {
    static_assert(m <= axes);
    Core<D, n> a;
    Core<D, m> b;
    b.is_slanted = one.is_slanted;
    const Lanes3<D> w = sub(set3(d, one.swept.centre), load3(d, row, lane));
    auto size = max_abs(w);
    for (std::size_t i = 0; i < std::max(n, m); ++i) {
        auto halves = hn::Zero(d);
        if (i < n) {
            a.direction[i] = a.dual[i] = load3(d, row + 4 + 4 * i, lane);
            a.half[i] = hn::Load(d, row[4 + 4 * i + 3] + lane);
            halves = a.half[i];
        }
        if (i < m) {
            b.direction[i] = set3(d, one.swept.axes[i].direction);
            b.dual[i] = set3(d, one.dual[i]);
            b.half[i] = hn::Set(d, one.swept.axes[i].half);
            halves = hn::Add(halves, b.half[i]);
        }
        size = hn::Add(size, halves);
    }
    Lanes3<D> v = shortest_vector(d, a, b, w);
    auto gap = gap_along(d, v, a, b, w);
    if constexpr (n + m > 0) {
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
    return separation_of_cores<n, n>(d, batch.row, lane, one);
}
template <class D>
HWY_INLINE Separation<D> separation(D d, const VolumeBatch<BoundingSphere>& batch, std::size_t lane,
                                    const SweptSphereImage<0>& one) {
    return separation_of_cores<0, 0>(d, batch.row, lane, one);
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
