// Kernels of bounds between one volume and several: included by sources that compile themselves for
// each SIMD target (simd/simd.h), so that a traversal has them inline.

// Included once for each target.
#if defined(ABUT_VOLUME_LOWER_BOUND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_VOLUME_LOWER_BOUND_INL_H
#undef ABUT_VOLUME_LOWER_BOUND_INL_H
#else
#define ABUT_VOLUME_LOWER_BOUND_INL_H
#endif

#include "simd/simd.h"
#include "volume/lower_bound.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::volumes {

namespace hn = hwy::HWY_NAMESPACE;

/// Three coordinates, lanes wide.
template <class D>
struct Lanes3 {
    hn::Vec<D> x, y, z;
};
template <class D>
HWY_INLINE Lanes3<D> load3(D d, const float (*row)[VolumeBounds::kLanes], std::size_t lane) {
    return {hn::Load(d, row[0] + lane), hn::Load(d, row[1] + lane), hn::Load(d, row[2] + lane)};
}
template <class D>
HWY_INLINE Lanes3<D> set3(D d, const std::array<float, 3>& v) {
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
template <class D>
HWY_INLINE Lanes3<D> sub(const Lanes3<D>& a, const Lanes3<D>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(const Lanes3<D>& a, const Lanes3<D>& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class D>
HWY_INLINE Lanes3<D> cross(const Lanes3<D>& a, const Lanes3<D>& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
/// a + s b
template <class D>
HWY_INLINE Lanes3<D> plus_scaled(const Lanes3<D>& a, hn::Vec<D> s, const Lanes3<D>& b) {
    return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
/// a - s b
template <class D>
HWY_INLINE Lanes3<D> minus_scaled(const Lanes3<D>& a, hn::Vec<D> s, const Lanes3<D>& b) {
    return {hn::NegMulAdd(s, b.x, a.x), hn::NegMulAdd(s, b.y, a.y), hn::NegMulAdd(s, b.z, a.z)};
}
template <class D>
HWY_INLINE hn::Vec<D> clamp_to(hn::Vec<D> v, hn::Vec<D> half) {
    return hn::Max(hn::Neg(half), hn::Min(v, half));
}

/// A gap between two volumes of each lane: along one direction, and squared of several together.
template <class D>
struct Separation {
    hn::Vec<D> gap;      ///< widest along a direction; margin taken off
    hn::Vec<D> lower_sq; ///< squared distance, at least
};

/// Squares of gaps are rounded a few times.
constexpr float kSquareRounding = 1 - 32 * 0x1p-24F;

template <class D>
HWY_INLINE hn::Vec<D> square_of_gap(D d, hn::Vec<D> gap) {
    const auto open = hn::Max(gap, hn::Zero(d));
    return hn::Mul(open, open);
}

// ------------------------------------------------------------------------------------------ cores

/// The core of swept spheres: directions and half lengths.
template <class D, std::size_t n>
struct Core {
    // Never empty: a point's core has none.
    Lanes3<D> direction[n + 1], dual[n + 1];
    hn::Vec<D> half[n + 1];
};

/// The shortest vector so far from a point of the one core to a point of the other.
template <class D>
struct Shortest {
    Lanes3<D> vector;
    hn::Vec<D> length_sq;

    HWY_INLINE void offer(const Lanes3<D>& v) {
        const auto sq = dot(v, v);
        const auto shorter = hn::Lt(sq, length_sq);
        length_sq = hn::IfThenElse(shorter, sq, length_sq);
        vector.x = hn::IfThenElse(shorter, v.x, vector.x);
        vector.y = hn::IfThenElse(shorter, v.y, vector.y);
        vector.z = hn::IfThenElse(shorter, v.z, vector.z);
    }
};

/// What segments of two given directions have in common, however they lie.
template <class D>
struct SegmentPair {
    Lanes3<D> a, b;
    hn::Vec<D> half_a, half_b, cosine;
    Lanes3<D> to_a; ///< w . to_a is where a's line is nearest to b's, for w from a's middle to b's

    HWY_INLINE SegmentPair(D d, const Lanes3<D>& direction_a, hn::Vec<D> length_a,
                           const Lanes3<D>& direction_b, hn::Vec<D> length_b)
        : a(direction_a), b(direction_b), half_a(length_a), half_b(length_b), cosine(dot(a, b)) {
        // s = w . (b x (a x b)) / |a x b|^2; parallel lines are nearest everywhere.
        const Lanes3<D> across = cross(a, b);
        const auto sine_sq = dot(across, across);
        const auto inverse = hn::IfThenElseZero(hn::Gt(sine_sq, hn::Set(d, 0x1p-40F)),
                                                hn::Div(hn::Set(d, 1.0F), sine_sq));
        const Lanes3<D> m = cross(b, across);
        to_a = {hn::Mul(inverse, m.x), hn::Mul(inverse, m.y), hn::Mul(inverse, m.z)};
    }

    /// The shortest vector from the one segment to the other.
    HWY_INLINE Lanes3<D> shortest(const Lanes3<D>& w) const {
        auto s = clamp_to<D>(dot(w, to_a), half_a);
        const auto p = clamp_to<D>(hn::MulSub(s, cosine, dot(w, b)), half_b);
        s = clamp_to<D>(hn::MulAdd(p, cosine, dot(w, a)), half_a);
        return minus_scaled(plus_scaled(w, p, b), s, a);
    }
};

/// The shortest vector between two rectangles that do not cross: of two edges, or of a corner and a
/// face. `w` goes from a's middle to b's.
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

/// Takes off what a vector has along the directions that it is at right angles to but for rounding:
/// a core's support along it is as wide as what is left there.
template <class D, std::size_t n>
HWY_INLINE void straighten(Lanes3<D>& v, const Core<D, n>& core, hn::Vec<D> rounding) {
    for (std::size_t i = 0; i < n; ++i) {
        const auto along = dot(v, core.direction[i]);
        v = minus_scaled(v, hn::IfThenElseZero(hn::Lt(hn::Abs(along), rounding), along),
                         core.direction[i]);
    }
}

/// The gap of two cores along a direction: (v . w - sum_i half_i |v . direction_i|) / |v|.
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
    auto size = hn::Max(hn::Max(hn::Abs(w.x), hn::Abs(w.y)), hn::Abs(w.z));
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
        // Twice: the directions of the one are not at right angles to those of the other.
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
HWY_INLINE Separation<D> separation(D d, const VolumeBlock<SweptSphere<n>>& block, std::size_t lane,
                                    const SweptSphereImage<n>& one) {
    return separation_of_cores(d, block.row, lane, one);
}
template <class D>
HWY_INLINE Separation<D> separation(D d, const VolumeBlock<Sphere>& block, std::size_t lane,
                                    const SweptSphereImage<0>& one) {
    return separation_of_cores(d, block.row, lane, one);
}

// ------------------------------------------------------------------------------------------ boxes

/// The separating axes of two boxes: three face normals of each, and nine edge pairs.
///
/// Rows 0 to 2: centre; 3 to 11: axes a_i; 12 to 14: half lengths h_i. With w from the block's
/// centre, e_k the other's edges, N_k its face normals:
///
///     a_i:        |a_i . w| - h_i - sum_k g_k |a_i . e_k|
///     N_k:        |N_k . w| - g'_k - sum_i h_i |N_k . a_i|
///     a_i x e_k:  |a_i x e_k . w| - sum_(m != i) h_m |a_i x e_k . a_m|
///                                 - sum_(m != k) g_m |a_i x e_k . e_m|, over |a_i x e_k|
template <class D>
HWY_INLINE Separation<D> separation(D d, const VolumeBlock<Obb>& block, std::size_t lane,
                                    const ObbImage& one) {
    using V = hn::Vec<D>;
    const auto margin = hn::Set(d, one.margin);
    const Lanes3<D> w = sub(set3(d, one.centre), load3(d, block.row, lane));
    Lanes3<D> a[3];
    V half[3], shift[3], cosine[3][3], facing[3][3];
    for (int i = 0; i < 3; ++i) {
        a[i] = load3(d, block.row + 3 + 3 * i, lane);
        half[i] = hn::Load(d, block.row[12 + i] + lane);
        shift[i] = dot(a[i], w);
        for (int k = 0; k < 3; ++k) {
            cosine[i][k] = dot(a[i], set3(d, one.direction[k]));
            facing[i][k] = hn::Abs(dot(a[i], set3(d, one.normal[k])));
        }
    }
    // Faces: gaps at right angles to each other add up.
    auto gap = hn::Set(d, hwy::LowestValue<float>());
    auto own_sq = hn::Zero(d), other_sq = hn::Zero(d);
    for (int i = 0; i < 3; ++i) {
        auto own = hn::Sub(hn::Abs(shift[i]), hn::Add(half[i], margin));
        auto other = hn::Sub(hn::Abs(dot(set3(d, one.normal[i]), w)),
                             hn::Add(hn::Set(d, one.normal_half[i]), margin));
        for (int k = 0; k < 3; ++k) {
            own = hn::NegMulAdd(hn::Set(d, one.half[k]), hn::Abs(cosine[i][k]), own);
            other = hn::NegMulAdd(half[k], facing[k][i], other);
        }
        gap = hn::Max(gap, hn::Max(own, other));
        own_sq = hn::Add(own_sq, square_of_gap(d, own));
        other_sq = hn::Add(other_sq, square_of_gap(d, other));
    }
    auto lower_sq = hn::Max(own_sq, hn::Mul(other_sq, hn::Set(d, 1 / one.normals_spread)));
    // Edges: a_i x e_k in the frame of the a's has the components 0, -c_2k, c_1k (cyclically).
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int k = 0; k < 3; ++k) {
            const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            const auto c1 = cosine[i1][k], c2 = cosine[i2][k];
            auto open = hn::Abs(hn::MulSub(c1, shift[i2], hn::Mul(c2, shift[i1])));
            open = hn::NegMulAdd(half[i1], hn::Abs(c2), open);
            open = hn::NegMulAdd(half[i2], hn::Abs(c1), open);
            // e_k x e_k1 is along N_k2, e_k x e_k2 along N_k1.
            open = hn::NegMulAdd(hn::Set(d, one.half_across[k][k1]), facing[i][k2], open);
            open = hn::NegMulAdd(hn::Set(d, one.half_across[k][k2]), facing[i][k1], open);
            const auto sine_sq = hn::MulAdd(c1, c1, hn::Mul(c2, c2));
            // Below this the edges are parallel, and the faces' normals say as much.
            const auto usable = hn::Gt(sine_sq, hn::Set(d, 0x1p-20F));
            const auto along = hn::Sub(hn::Div(open, hn::Sqrt(sine_sq)), margin);
            gap = hn::IfThenElse(usable, hn::Max(gap, along), gap);
        }
    }
    return {gap, hn::Max(lower_sq, square_of_gap(d, gap))};
}

// ----------------------------------------------------------------------------------------- k-DOPs

/// Rows: lower bounds, then upper bounds, of each slab.
template <class D, std::size_t k>
HWY_INLINE Separation<D> separation(D d, const VolumeBlock<Kdop<k>>& block, std::size_t lane,
                                    const KdopImage<k>& one) {
    constexpr std::size_t kSlabs = k / 2;
    hn::Vec<D> open[kSlabs];
    auto gap = hn::Set(d, hwy::LowestValue<float>());
    for (std::size_t i = 0; i < kSlabs; ++i) {
        const auto& n = Kdop<k>::kNormals[i];
        const int norm_sq = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        const float inverse_norm = norm_sq == 1 ? 1.0F : norm_sq == 2 ? 0.70710678F : 0.57735027F;
        const auto apart = hn::Max(
            hn::Sub(hn::Set(d, one.kdop.lower[i]), hn::Load(d, block.row[kSlabs + i] + lane)),
            hn::Sub(hn::Load(d, block.row[i] + lane), hn::Set(d, one.kdop.upper[i])));
        open[i] = hn::MulSub(apart, hn::Set(d, inverse_norm), hn::Set(d, one.margin));
        gap = hn::Max(gap, open[i]);
    }
    // Gaps at right angles to each other add up: along the axes, and along one axis and the two
    // diagonals across it.
    const auto together = [&](std::size_t i, std::size_t j, std::size_t l) HWY_ATTR {
        return hn::Add(square_of_gap(d, open[i]),
                       hn::Add(square_of_gap(d, open[j]), square_of_gap(d, open[l])));
    };
    auto lower_sq = hn::Max(square_of_gap(d, gap), together(0, 1, 2));
    if constexpr (k != 14)
        for (std::size_t axis = 0; axis < 3; ++axis)
            lower_sq = hn::Max(lower_sq, together(axis, 3 + 2 * axis, 4 + 2 * axis));
    return {gap, lower_sq};
}

// ------------------------------------------------------------------------------------ all of them

/// A ball around each volume of a block, and around an image.
template <class D>
struct LanesBall {
    Lanes3<D> centre;
    hn::Vec<D> radius;
};
template <class D, std::size_t n>
HWY_INLINE LanesBall<D> ball_around_core(D d, const float (*row)[VolumeBounds::kLanes],
                                         std::size_t lane) {
    auto sum_sq = hn::Zero(d);
    for (std::size_t i = 0; i < n; ++i) {
        const auto half = hn::Load(d, row[4 + 4 * i + 3] + lane);
        sum_sq = hn::MulAdd(half, half, sum_sq);
    }
    return {load3(d, row, lane), hn::Add(hn::Sqrt(sum_sq), hn::Load(d, row[3] + lane))};
}
template <class D, std::size_t n>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBlock<SweptSphere<n>>& block,
                                    std::size_t lane) {
    return ball_around_core<D, n>(d, block.row, lane);
}
template <class D>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBlock<Sphere>& block, std::size_t lane) {
    return ball_around_core<D, 0>(d, block.row, lane);
}
template <class D>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBlock<Obb>& block, std::size_t lane) {
    const Lanes3<D> half = load3(d, block.row + 12, lane);
    return {load3(d, block.row, lane), hn::Sqrt(dot(half, half))};
}
template <class D, std::size_t k>
HWY_INLINE LanesBall<D> ball_around(D d, const VolumeBlock<Kdop<k>>& block, std::size_t lane) {
    const Lanes3<D> lower = load3(d, block.row, lane), upper = load3(d, block.row + k / 2, lane);
    const auto half = hn::Set(d, 0.5F);
    const Lanes3<D> extent = sub(upper, lower);
    return {{hn::Mul(half, hn::Add(lower.x, upper.x)), hn::Mul(half, hn::Add(lower.y, upper.y)),
             hn::Mul(half, hn::Add(lower.z, upper.z))},
            hn::Mul(half, hn::Sqrt(dot(extent, extent)))};
}

struct ImageBall {
    std::array<float, 3> centre;
    float radius;
};
template <std::size_t n>
HWY_INLINE ImageBall ball_around(const SweptSphereImage<n>& image) {
    return {image.swept.centre, image.circumradius};
}
HWY_INLINE ImageBall ball_around(const ObbImage& image) {
    return {image.centre, image.circumradius};
}
template <std::size_t k>
HWY_INLINE ImageBall ball_around(const KdopImage<k>& image) {
    ImageBall ball{{}, image.kdop.circumradius()};
    for (std::size_t i = 0; i < 3; ++i)
        ball.centre[i] = 0.5F * (image.kdop.lower[i] + image.kdop.upper[i]);
    return ball;
}

/// `block` against `one`, all lanes. Without `with_upper`, upper_sq is left as it was.
template <bool with_upper, class D, typename V>
HWY_INLINE void bound_all(D d, const VolumeBlock<V>& block, const typename V::Image& one,
                          VolumeBounds& bounds) {
    ImageBall other{};
    if constexpr (with_upper)
        other = ball_around(one);
    for (std::size_t lane = 0; lane < VolumeBounds::kLanes; lane += hn::Lanes(d)) {
        const Separation<D> s = separation(d, block, lane, one);
        hn::Store(hn::Mul(s.lower_sq, hn::Set(d, kSquareRounding)), d, bounds.lower_sq + lane);
        hn::Store(s.gap, d, bounds.gap + lane);
        if constexpr (with_upper) {
            const LanesBall<D> own = ball_around(d, block, lane);
            const Lanes3<D> w = sub(set3(d, other.centre), own.centre);
            const auto reach = hn::Add(hn::Add(hn::Sqrt(dot(w, w)), own.radius),
                                       hn::Set(d, other.radius + one.margin));
            hn::Store(hn::Mul(hn::Mul(reach, reach), hn::Set(d, 2 - kSquareRounding)), d,
                      bounds.upper_sq + lane);
        }
    }
}

} // namespace abut::HWY_NAMESPACE::volumes
HWY_AFTER_NAMESPACE();

#endif
