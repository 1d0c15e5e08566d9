#pragma once

#include <abut/deformable.h>

#include "deform/deformable_data.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/model/model_data.h"
#include "rigid/motion/trajectory.h"
#include "world/narrow_phase/offset_surface.h"
#include "world/schedule/body_impact.h"

#include <cstdint>
#include <span>

namespace abut {

/// A part of a step.
struct TimeRange {
    double begin = 0, end = 1;
};

/// A deformable surface and the surface of a rigid body, both in motion.
///
/// Positions are given in a frame that moves in a straight line with the centre of the body's
/// motion. In this frame the body only rotates about `centre`, and the surface's vertices still
/// move in straight lines.
class DeformingPair {
public:
    DeformingPair(const DeformableData& deformable, const MovingBody& body);

    [[nodiscard]] const MovingTree& tree_a() const { return a_.swept.tree; }
    [[nodiscard]] const Tree& tree_b() const { return b_.surface.data().tree(); }
    /// The triangles of a leaf of the deformable's tree.
    [[nodiscard]] std::span<const std::uint32_t> triangles_a(NodeRef leaf) const;

    /// A box that encloses all below a child of a's tree, rounding included. Between two times its
    /// bounds change linearly.
    [[nodiscard]] Box3 box_a(std::uint32_t name, double time) const;
    /// A box that encloses all below a child of b's tree, enlarged by b's radius, throughout a time
    /// range.
    [[nodiscard]] Box3 box_b(std::uint32_t name, const TimeRange& range) const;

    [[nodiscard]] Triangle triangle_a(std::uint32_t triangle, double time) const;
    [[nodiscard]] Triangle triangle_b(std::uint32_t slot, double time) const;
    /// The bodies are closer than the triangles by this offset.
    [[nodiscard]] double radius() const { return b_.radius; }
    /// Lower bound of the time for which the two triangles stay apart. At its end a gap of half the
    /// tolerance is left.
    [[nodiscard]] double free_time(std::uint32_t triangle_a, const Triangle& a, const Triangle& b,
                                   const ClosestPoints& closest, double time,
                                   double tolerance) const;

    /// Whether the triangles share a point at their places in the world. Exact if the radius is 0.
    [[nodiscard]] bool meet(std::uint32_t triangle_a, std::uint32_t slot, double time) const;
    /// How far the frame has moved.
    [[nodiscard]] Vec3 shift(double time) const { return time * velocity_; }
    /// The triangle's number in the body, if it is a model or a convex body; else 0.
    [[nodiscard]] std::uint32_t number_b(std::uint32_t slot) const;
    /// Rounding error of lengths: shorter ones are not certain.
    [[nodiscard]] double margin() const { return margin_; }
    /// Half the diagonal, approximately, of the smaller of the two.
    [[nodiscard]] double size() const { return size_; }

private:
    const DeformableData& a_;
    OffsetSurface b_;
    bool is_model_; ///< whether b's triangles are known to the caller
    Trajectory moving_, turning_;
    Vec3 velocity_;
    double size_ = 0, margin_ = 0;
};

} // namespace abut
