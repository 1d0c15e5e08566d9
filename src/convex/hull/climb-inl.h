// Hill climbing to farthest vertices, and the highest neighbour of a vertex: SIMD kernels.

// Included once for each target.
#if defined(ABUT_CONVEX_CLIMB_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_CONVEX_CLIMB_INL_H
#undef ABUT_CONVEX_CLIMB_INL_H
#else
#define ABUT_CONVEX_CLIMB_INL_H
#endif

#include <abut/convex.h>

#include "convex/hull/polytope.h"
#include "simd/simd.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::rings {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, RingBatch::kEdges>;
using V = hn::VFromD<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());
constexpr std::size_t kVectors = std::size_t{2} * RingBatch::kEdges / kLanes; ///< of two batches

/// The order of operations of `dot`, without fused operations: the same result on all targets.
HWY_INLINE V dot(const V* direction, V x, V y, V z) {
    return hn::Add(hn::Add(hn::Mul(direction[0], x), hn::Mul(direction[1], y)),
                   hn::Mul(direction[2], z));
}

HWY_INLINE std::uint32_t first_of(const V* heights, std::size_t vectors, V most) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < vectors; ++i) {
        std::uint8_t found[8] = {};
        hn::StoreMaskBits(D(), hn::Eq(heights[i], most), found);
        bits |= std::uint32_t{found[0]} << (i * kLanes);
    }
    return static_cast<std::uint32_t>(std::countr_zero(bits));
}

/// A climb in progress.
class Climber {
public:
    HWY_INLINE Climber(const Polytope& polytope, const Vec3& direction, std::uint32_t start)
        : polytope_(polytope), direction_(direction), vertex_(start),
          height_(abut::dot(direction, polytope.vertices[start].at)) {
        const D d;
        lanes_[0] = hn::Set(d, direction.x), lanes_[1] = hn::Set(d, direction.y);
        lanes_[2] = hn::Set(d, direction.z);
    }

    /// Moves to the highest neighbour if it is higher. Returns whether it moved.
    HWY_INLINE bool step() {
        const D d;
        const HullVertex& vertex = polytope_.vertices[vertex_];
        const RingBatch* const ring =
            polytope_.rings.data() + vertex.first_edge / RingBatch::kEdges;
        // Always reads two batches: most vertices have no more neighbours, and reading some of the
        // next vertex's costs less than a branch on their number.
        V heights[kVectors];
        for (std::size_t i = 0; i < kVectors; ++i) {
            const RingBatch& batch = ring[i * kLanes / RingBatch::kEdges];
            const std::size_t lane = i * kLanes % RingBatch::kEdges;
            heights[i] =
                dot(lanes_, hn::Load(d, batch.x.data() + lane), hn::Load(d, batch.y.data() + lane),
                    hn::Load(d, batch.z.data() + lane));
        }
        V most = heights[0];
        for (std::size_t i = 1; i < kVectors; ++i)
            most = hn::Max(most, heights[i]);
        most = hn::MaxOfLanes(d, most);
        const std::uint32_t k = first_of(heights, kVectors, most) % (2 * RingBatch::kEdges);
        const double height = hn::GetLane(most);
        const std::uint32_t target = ring[k / RingBatch::kEdges].target[k % RingBatch::kEdges];
        bool higher = height > height_;
        lead_ = height_ - height;
        vertex_ = higher ? target : vertex_;
        height_ = higher ? height : height_;
        if (HWY_UNLIKELY(vertex.degree > 2 * RingBatch::kEdges))
            higher |= step_beyond(vertex);
        return higher;
    }
    [[nodiscard]] std::uint32_t vertex() const { return vertex_; }
    /// After a step that did not move: by how much all neighbours are lower, at least.
    [[nodiscard]] double lead() const { return lead_; }

private:
    HWY_INLINE bool step_beyond(const HullVertex& vertex) {
        bool higher = false;
        for (std::uint32_t k = 2 * RingBatch::kEdges; k < vertex.degree; ++k) {
            const std::uint32_t e = vertex.first_edge + k;
            const double h = abut::dot(direction_, polytope_.to(e));
            lead_ = std::min(lead_, height_ - h);
            if (h > height_)
                height_ = h, vertex_ = polytope_.target(e), higher = true;
        }
        return higher;
    }

    const Polytope& polytope_;
    const Vec3& direction_;
    V lanes_[3];
    std::uint32_t vertex_;
    double height_, lead_ = 0;
};

/// The farthest vertex, by looking at all of them.
HWY_INLINE std::uint32_t scan(const Polytope& polytope, const Vec3& direction) {
    const D d;
    const std::size_t count = polytope.columns.size() / 3;
    const double *const x = polytope.columns.data(), *const y = x + count, *const z = y + count;
    const V along[3] = {hn::Set(d, direction.x), hn::Set(d, direction.y), hn::Set(d, direction.z)};
    const V lanes = hn::Set(d, static_cast<double>(hn::Lanes(d)));
    V place = hn::Iota(d, 0.0), place_of_most = place;
    V most = dot(along, hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z));
    for (std::size_t i = hn::Lanes(d); i < count; i += hn::Lanes(d)) {
        const V height = dot(along, hn::LoadU(d, x + i), hn::LoadU(d, y + i), hn::LoadU(d, z + i));
        place = hn::Add(place, lanes);
        place_of_most = hn::IfThenElse(hn::Gt(height, most), place, place_of_most);
        most = hn::Max(height, most);
    }
    const auto highest = hn::Eq(most, hn::MaxOfLanes(d, most));
    const V last = hn::Set(d, static_cast<double>(polytope.vertices.size() - 1));
    return static_cast<std::uint32_t>(hn::GetLane(
        hn::MinOfLanes(d, hn::IfThenElse(highest, hn::Min(place_of_most, last), last))));
}

/// The farthest vertex of each polytope along a direction of its own. Small hulls are scanned;
/// others are climbed from the start that the table of normals gives. Both climbs run interleaved,
/// so that neither waits for the other's memory.
HWY_INLINE VertexPair farthest_two(const Polytope& a, const Vec3& direction_a, const Polytope& b,
                                   const Vec3& direction_b) {
    if (!a.columns.empty() && !b.columns.empty())
        return {scan(a, direction_a), scan(b, direction_b)};
    Climber climber_a(a, direction_a, a.starts.vertex(direction_a)),
        climber_b(b, direction_b, b.starts.vertex(direction_b));
    for (;;) {
        const bool higher_a = climber_a.step(), higher_b = climber_b.step();
        if (!(static_cast<unsigned>(higher_a) | static_cast<unsigned>(higher_b)))
            return {climber_a.vertex(), climber_b.vertex()};
    }
}

/// The neighbour that is highest along a direction, and how much higher than the vertex.
struct HighestNeighbour {
    double excess = 0;      ///< 0 if none is higher
    std::uint32_t edge = 0; ///< to that neighbour; the first edge if none is higher
    /// How much higher than the vertex the lowest and the highest neighbour are; negative if lower.
    /// `least` is computed only if asked for.
    double least = std::numeric_limits<double>::infinity(), most = -least;
};

HWY_INLINE HighestNeighbour highest_neighbour(const Polytope& polytope, const HullVertex& vertex,
                                              const Vec3& direction, bool wants_least = false) {
    HighestNeighbour highest{0, vertex.first_edge};
    const D d;
    const V along[3] = {hn::Set(d, direction.x), hn::Set(d, direction.y), hn::Set(d, direction.z)};
    const V x = hn::Set(d, vertex.at.x), y = hn::Set(d, vertex.at.y), z = hn::Set(d, vertex.at.z);
    const RingBatch* const ring = polytope.rings.data() + vertex.first_edge / RingBatch::kEdges;
    constexpr std::uint32_t kTwo = 2 * RingBatch::kEdges;
    for (std::uint32_t first = 0; first < vertex.degree; first += kTwo) {
        // Two batches at a time: the first one twice if there is no second.
        const RingBatch* const one = ring + first / RingBatch::kEdges;
        const RingBatch* const batches[2] = {
            one, vertex.degree - first > RingBatch::kEdges ? one + 1 : one};
        V heights[kVectors];
        for (std::size_t i = 0; i < kVectors; ++i) {
            const RingBatch& batch = *batches[i * kLanes / RingBatch::kEdges];
            const std::size_t lane = i * kLanes % RingBatch::kEdges;
            heights[i] = dot(along, hn::Sub(hn::Load(d, batch.x.data() + lane), x),
                             hn::Sub(hn::Load(d, batch.y.data() + lane), y),
                             hn::Sub(hn::Load(d, batch.z.data() + lane), z));
        }
        V most = heights[0];
        for (std::size_t i = 1; i < kVectors; ++i)
            most = hn::Max(most, heights[i]);
        most = hn::MaxOfLanes(d, most);
        if (wants_least) {
            V least = heights[0];
            for (std::size_t i = 1; i < kVectors; ++i)
                least = hn::Min(least, heights[i]);
            highest.least = std::min(highest.least, hn::GetLane(hn::MinOfLanes(d, least)));
        }
        const std::uint32_t k = first + first_of(heights, kVectors, most);
        const double excess = hn::GetLane(most);
        const bool higher = excess > highest.excess;
        highest.edge = higher ? vertex.first_edge + (k < vertex.degree ? k : 0) : highest.edge;
        highest.excess = higher ? excess : highest.excess;
        highest.most = std::max(highest.most, excess);
    }
    return highest;
}

} // namespace abut::HWY_NAMESPACE::rings
HWY_AFTER_NAMESPACE();

#endif
