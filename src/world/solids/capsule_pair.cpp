#include "world/solids/capsule_pair.h"

#include "world/solids/segment_overlap.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut {

namespace {

/// The part of a capsule's axis that faces along a direction: the axis, or one of its ends if it is
/// nearly parallel to the direction. Its names are those of the box without extent on the other axes.
struct FacingAxis {
    FlatSegment segment;
    bool is_end;
    std::uint32_t end; ///< the number of the vertex, if it is an end

    /// In          middle: of the capsule, from the frame's origin.
    FacingAxis(const RoundedBox& capsule, const HalfSegment& axis, const Vec3& middle,
               const Vec3& direction, const ContactFrame& frame) {
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
        const Vec3 at = frame.coordinates(middle), way = frame.coordinates(axis.half);
        const auto edge = static_cast<std::uint32_t>(4 * axis.number);
        const auto set = [&](FlatCorner& corner, const Vec3& place, std::uint32_t vertex) {
            corner.x = place.x, corner.y = place.y, corner.height = place.z;
            corner.vertex = vertex, corner.edge = edge;
        };
        set(segment.ends[0], at - way, 0);
        set(segment.ends[1], at + way, 1U << axis.number);
        segment.radius = capsule.radius;
    }
};

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
                         KnownSeparation& separation, std::vector<ContactManifold>& manifolds) {
    const HalfSegment along_a(a), along_b(b);
    const SolidGap gap = capsule_distance({a.centre, a.radius}, along_a.half, {b.centre, b.radius},
                                          along_b.half, limits.margin);
    if (gap.distance > limits.margin) {
        separation.direction = gap.normal;
        return false;
    }
    separation.direction = {};
    const ContactFrame frame(a.centre, gap.normal);
    const FacingAxis axis_a(a, along_a, {}, gap.normal, frame),
        axis_b(b, along_b, b.centre - a.centre, -gap.normal, frame);
    ContactCandidates candidates;
    if (!axis_a.is_end && !axis_b.is_end)
        add_segment_overlap(axis_a.segment, axis_b.segment, candidates);
    if (!(deepest_of(candidates) >= -gap.distance - limits.rounding))
        add_witness(gap, witness_name(axis_a, axis_b), frame, candidates);
    write_points(candidates, frame, limits, manifolds.emplace_back());
    return true;
}

} // namespace abut
