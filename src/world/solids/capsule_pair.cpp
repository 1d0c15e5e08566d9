#include "world/solids/capsule_pair.h"

#include "world/solids/segment_overlap.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut {

namespace {

/// The axis of a capsule in the world.
struct CapsuleAxis {
    std::size_t number; ///< of the box's axis that has an extent
    Vec3 half;          ///< from the middle to the end

    explicit CapsuleAxis(const RoundedBox& capsule)
        : number(capsule.half[0] > 0   ? 0
                 : capsule.half[1] > 0 ? 1
                                       : 2),
          half(capsule.half[number] * capsule.axis[number]) {}
};

/// The part of a capsule's axis that faces along a direction: the axis, or one of its ends if it is
/// nearly parallel to the direction. Its names are those of the box without extent on the other axes.
struct FacingAxis {
    FlatSegment segment;
    bool is_end;
    std::uint32_t end; ///< the number of the vertex, if it is an end

    FacingAxis(const RoundedBox& capsule, const CapsuleAxis& axis, const Vec3& direction,
               const ContactFrame& frame) {
        const double along = dot(direction, capsule.axis[axis.number]), size = std::abs(along);
        end = along > 0 ? 1U << axis.number : 0U;
        // The largest of a unit vector's three coordinates is not below 0.577.
        is_end = size > 0.57;
        for (std::size_t k = 0; k < 3 && is_end; ++k) {
            const double other = std::abs(dot(direction, capsule.axis[k]));
            is_end = is_end && (k < axis.number ? size > other : k == axis.number || size >= other);
        }
        if (is_end)
            return;
        const Vec3 middle = frame.coordinates(capsule.centre - frame.origin),
                   way = frame.coordinates(axis.half);
        const auto edge = static_cast<std::uint32_t>(4 * axis.number);
        const Vec3 first = middle - way, last = middle + way;
        segment.ends = {FlatCorner{first.x, first.y, first.z, 0, edge},
                        FlatCorner{last.x, last.y, last.z, 1U << axis.number, edge}};
        segment.radius = capsule.radius;
    }
};

/// Whether a plane across the way between the middles proves two capsules farther apart than a distance. This
/// costs a tenth of their distance.
bool are_apart(const RoundedBox& a, const Vec3& half_a, const RoundedBox& b, const Vec3& half_b,
               double distance) {
    constexpr double kRounding = 1 + 0x1p-30;
    const Vec3 way = b.centre - a.centre;
    const double reach = (a.radius + b.radius + distance) * kRounding, way_sq = length_sq(way);
    // All are times the length of the way.
    const double gap =
        way_sq - (std::abs(dot(half_a, way)) + std::abs(dot(half_b, way))) * kRounding;
    return gap > 0 && gap * gap > reach * reach * way_sq * kRounding;
}

/// Names the closest or deepest points.
std::uint64_t witness_name(const FacingAxis& a, const FacingAxis& b) {
    if (!a.is_end && !b.is_end)
        return feature_name(FeatureKind::edges, a.segment.ends[0].edge, b.segment.ends[0].edge);
    if (a.is_end != b.is_end)
        return a.is_end ? feature_name(FeatureKind::vertex_of_a, a.end, 0)
                        : feature_name(FeatureKind::vertex_of_b, 0, b.end);
    return feature_name(FeatureKind::vertices, a.end, b.end);
}

} // namespace

bool contact_of_capsules(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                         std::vector<ContactManifold>& manifolds) {
    const CapsuleAxis along_a(a), along_b(b);
    if (are_apart(a, along_a.half, b, along_b.half, limits.margin + limits.rounding))
        return false;
    const SolidGap gap = capsule_distance({a.centre, a.radius}, along_a.half, {b.centre, b.radius},
                                          along_b.half, limits.margin);
    if (gap.distance > limits.margin)
        return false;
    const ContactFrame frame(a.centre, gap.normal);
    const FacingAxis axis_a(a, along_a, gap.normal, frame), axis_b(b, along_b, -gap.normal, frame);
    ContactCandidates candidates;
    if (!axis_a.is_end && !axis_b.is_end)
        add_segment_overlap(axis_a.segment, axis_b.segment, candidates);
    if (!(deepest_of(candidates) >= -gap.distance - limits.rounding))
        add_witness(gap, witness_name(axis_a, axis_b), frame, candidates);
    write_points(candidates, frame, limits, manifolds.emplace_back());
    return true;
}

} // namespace abut
