// Compares many pairs of leaves of two nodes. Few of their triangle pairs pass a test of boxes;
// these are packed, so that the costly tests run on full lanes.

// Included once for each target.
#if defined(ABUT_GEOMETRY_LEAF_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_GEOMETRY_LEAF_GROUP_INL_H
#undef ABUT_GEOMETRY_LEAF_GROUP_INL_H
#else
#define ABUT_GEOMETRY_LEAF_GROUP_INL_H
#endif

#include "core/set_bits.h"
#include "geometry/leaf/leaf_lanes-inl.h"
#include "geometry/leaf/triangle_pair_lanes-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Up to eight leaves of either node, and up to 64 pairs of them.
///
/// Each leaf is set once, then pairs are added. `pairs` returns for each what meeting_pairs would,
/// or near_pairs if `with_near`, as soon as it is among the `complete` ones.
template <bool with_near>
class LeafGroup {
public:
    static constexpr std::size_t kLeaves = 8, kMostPairs = kLeaves * kLeaves;

    HWY_INLINE LeafGroup(const LeafPlacement& a_from_b, const LeafBound& bound)
        : a_from_b_(a_from_b), bound_(bound),
          along_margin_(3 * a_from_b.margin *
                        (std::abs(bound.direction[0]) + std::abs(bound.direction[1]) +
                         std::abs(bound.direction[2]))) {}

    HWY_INLINE void set_a(std::size_t slot, const TriangleLeaf& leaf) {
        leaf_a_[slot] = &leaf;
        measure(leaf, size_a_[slot]);
    }
    HWY_INLINE void set_b(std::size_t slot, const TriangleLeaf& leaf) {
        turn_leaf(leaf, a_from_b_, turned_b_[slot]);
        measure(turned_b_[slot], size_b_[slot]);
    }
    /// Adds a pair of leaves that have been set. `used` has the bits of its triangle pairs.
    HWY_INLINE void add(std::size_t slot_a, std::size_t slot_b, std::uint32_t used) {
        const std::uint32_t near = near_boxes(size_a_[slot_a], size_b_[slot_b]) & used;
        cross_[count_] = may_meet_[count_] = may_be_near_[count_] = 0;
        leaves_[count_] = {&leaf_a_[slot_a]->v[0][0][0], &turned_b_[slot_b].v[0][0][0]};
        append(near & 0xffU, count_ * kPairs);
        append(near >> 8, count_ * kPairs + 8);
        ++count_;
    }
    /// Returns whether the undecided candidates fill all lanes.
    [[nodiscard]] HWY_INLINE bool fills_lanes() const {
        return candidate_count_ - decided_ >= hn::Lanes(PairLanes());
    }
    /// Decides the candidates that fill all lanes, or all.
    HWY_INLINE void decide(bool all) {
        const std::size_t lanes = hn::Lanes(PairLanes());
        for (; decided_ + (all ? 1 : lanes) <= candidate_count_; decided_ += lanes)
            decide_from(decided_);
    }
    /// How many pairs of leaves, in the order in which they were added, are decided.
    [[nodiscard]] std::size_t complete() const {
        return decided_ < candidate_count_ ? candidates_[decided_] / kPairs : count_;
    }
    /// The pairs of triangles of the pair of leaves that was added as number k.
    [[nodiscard]] LeafPairs pairs(std::size_t k) const {
        return {cross_[k], may_meet_[k], may_be_near_[k]};
    }

private:
    using PairLanes = hn::CappedTag<float, kPairs>;
    using LeafLanes = hn::CappedTag<float, TriangleLeaf::kLanes>;

    /// The extents of the four triangles of a leaf, each in its lane.
    struct Sizes {
        HWY_ALIGN float lower[3][TriangleLeaf::kLanes], upper[3][TriangleLeaf::kLanes];
        HWY_ALIGN float least_along[TriangleLeaf::kLanes],
            most_along[TriangleLeaf::kLanes]; ///< along the bound's direction
    };
    struct Leaves {
        const float *a, *b; ///< first coordinates of the leaves, in one frame
    };

    /// Appends `first` + i for each set bit i of eight. Without a branch: eight entries are written,
    /// and as many as there are bits count.
    HWY_INLINE void append(std::uint32_t bits, std::size_t first) {
        const hn::CappedTag<std::uint16_t, 8> d;
        const hn::Rebind<std::uint8_t, decltype(d)> d8;
        const auto base = hn::Set(d, static_cast<std::uint16_t>(first));
        for (std::size_t i = 0; i < 8; i += hn::Lanes(d))
            hn::StoreU(hn::Add(base, hn::PromoteTo(d, hn::LoadU(d8, kSetBits[bits].data() + i))), d,
                       candidates_ + candidate_count_ + i);
        candidate_count_ += static_cast<std::size_t>(std::popcount(bits));
    }

    HWY_INLINE void measure(const TriangleLeaf& leaf, Sizes& s) const {
        const LeafLanes d;
        for (std::size_t lane = 0; lane < TriangleLeaf::kLanes; lane += hn::Lanes(d)) {
            Lanes3<LeafLanes> v[3];
            for (std::size_t i = 0; i < 3; ++i)
                v[i] = load3(d, leaf.v[i], lane);
            hn::Store(min3(v[0].x, v[1].x, v[2].x), d, s.lower[0] + lane);
            hn::Store(min3(v[0].y, v[1].y, v[2].y), d, s.lower[1] + lane);
            hn::Store(min3(v[0].z, v[1].z, v[2].z), d, s.lower[2] + lane);
            hn::Store(max3(v[0].x, v[1].x, v[2].x), d, s.upper[0] + lane);
            hn::Store(max3(v[0].y, v[1].y, v[2].y), d, s.upper[1] + lane);
            hn::Store(max3(v[0].z, v[1].z, v[2].z), d, s.upper[2] + lane);
            if constexpr (with_near) {
                const Lanes3<LeafLanes> n = set3(d, bound_.direction);
                const auto n0 = dot(n, v[0]), n1 = dot(n, v[1]), n2 = dot(n, v[2]);
                hn::Store(min3(n0, n1, n2), d, s.least_along + lane);
                hn::Store(max3(n0, n1, n2), d, s.most_along + lane);
            }
        }
    }

    /// The pairs of triangles whose boxes do not exclude them.
    HWY_INLINE std::uint32_t near_boxes(const Sizes& a, const Sizes& b) const {
        const PairLanes d;
        const auto zero = hn::Zero(d), margin = hn::Set(d, a_from_b_.margin);
        std::uint32_t far = 0;
        for (std::size_t lane = 0; lane < kPairs; lane += hn::Lanes(d)) {
            const auto gap = [&](std::size_t axis) HWY_ATTR {
                return hn::Max(
                    hn::Sub(spread_a(d, a.lower[axis], lane), spread_b(d, b.upper[axis], lane)),
                    hn::Sub(spread_b(d, b.lower[axis], lane), spread_a(d, a.upper[axis], lane)));
            };
            const Lanes3<PairLanes> g{gap(0), gap(1), gap(2)};
            if constexpr (with_near) {
                const auto certain = [&](auto apart)
                                         HWY_ATTR { return hn::Max(zero, hn::Sub(apart, margin)); };
                const Lanes3<PairLanes> c{certain(g.x), certain(g.y), certain(g.z)};
                const auto along = hn::Max(zero, hn::Sub(hn::Sub(spread_b(d, b.least_along, lane),
                                                                 spread_a(d, a.most_along, lane)),
                                                         hn::Set(d, along_margin_)));
                far |=
                    bits_of(d,
                            hn::Or(hn::Gt(dot(c, c), hn::Set(d, bound_.bound_sq * (1 + 0x1p-18F))),
                                   hn::Gt(hn::Mul(along, along),
                                          hn::Set(d, bound_.along_sq * (1 + 0x1p-18F)))))
                    << lane;
            } else {
                far |= bits_of(d, hn::Gt(max3(g.x, g.y, g.z), margin)) << lane;
            }
        }
        return ~far;
    }

    /// Decides as many candidates as there are lanes.
    HWY_NOINLINE void decide_from(std::size_t first) {
        const PairLanes d;
        HWY_ALIGN float rows[2][3][3][kPairs]; // [model][vertex][axis][lane]
        const std::size_t lanes = hn::Lanes(d);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t id = candidates_[std::min(first + lane, candidate_count_ - 1)];
            const Leaves& leaves = leaves_[id / kPairs];
            const float* a = leaves.a + id / TriangleLeaf::kLanes % TriangleLeaf::kLanes;
            const float* b = leaves.b + id % TriangleLeaf::kLanes;
            for (std::size_t i = 0; i < 9; ++i) {
                rows[0][i / 3][i % 3][lane] = a[TriangleLeaf::kLanes * i];
                rows[1][i / 3][i % 3][lane] = b[TriangleLeaf::kLanes * i];
            }
        }
        Lanes3<PairLanes> a[3], b[3];
        for (std::size_t v = 0; v < 3; ++v) {
            a[v] = load3(d, rows[0][v], 0);
            b[v] = load3(d, rows[1][v], 0);
        }
        const DecidedPairs<PairLanes> decided =
            decide_pairs<with_near>(d, a, b, hn::Set(d, a_from_b_.margin), bound_);
        const std::uint32_t cross = bits_of(d, decided.cross),
                            may_meet = bits_of(d, decided.may_meet),
                            near = with_near ? bits_of(d, decided.may_be_near) : 0;
        const std::size_t count = std::min(lanes, candidate_count_ - first);
        for (const std::uint32_t lane : SetBits((cross | may_meet | near) & ((1U << count) - 1))) {
            const std::uint32_t id = candidates_[first + lane];
            cross_[id / kPairs] |= (cross >> lane & 1U) << id % kPairs;
            may_meet_[id / kPairs] |= (may_meet >> lane & 1U) << id % kPairs;
            may_be_near_[id / kPairs] |= (near >> lane & 1U) << id % kPairs;
        }
    }

    /// The set bits of a number of eight bits, lowest first.
    static constexpr std::array<std::array<std::uint8_t, 8>, 256> kSetBits = [] {
        std::array<std::array<std::uint8_t, 8>, 256> table{};
        for (std::uint32_t bits = 0; bits < 256; ++bits) {
            std::size_t count = 0;
            for (std::uint8_t i = 0; i < 8; ++i)
                if ((bits >> i & 1U) != 0)
                    table[bits][count++] = i;
        }
        return table;
    }();

    const LeafPlacement& a_from_b_;
    const LeafBound bound_;
    const float along_margin_; ///< of a difference of extents along the direction
    const TriangleLeaf* leaf_a_[kLeaves];
    TriangleLeaf turned_b_[kLeaves];
    Sizes size_a_[kLeaves], size_b_[kLeaves];
    std::uint32_t cross_[kMostPairs], may_meet_[kMostPairs], may_be_near_[kMostPairs];
    Leaves leaves_[kMostPairs];
    std::size_t count_ = 0, candidate_count_ = 0, decided_ = 0;
    std::uint16_t candidates_[kMostPairs * kPairs + 8]; ///< 16 k + bit of LeafPairs
};

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
