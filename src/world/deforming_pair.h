#pragma once

#include <abut/deformable.h>

#include "deform/deformable_data.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/model_data.h"
#include "rigid/trajectory.h"
#include "world/body_impact.h"
#include "world/offset_surface.h"

#include <cstdint>
#include <span>

namespace abut {

/// A part of a step.
struct TimeRange {
    double begin = 0, end = 1;
};

/// A deformable surface and the surface of a rigid body, both in motion.
///
/// Places are seen from a frame that goes straight on with the centre of the body's motion: there the
/// body only turns, about `centre`, and the vertices of the surface still move in straight lines.
class DeformingPair {
public:
    DeformingPair(const DeformableData& deformable, const MovingBody& body);

    [[nodiscard]] const MovingTree& tree_a() const { return a_.swept.tree; }
    [[nodiscard]] const Tree& tree_b() const { return b_.surface.data().tree(); }
    /// The triangles of a leaf of the deformable.
    [[nodiscard]] std::span<const std::uint32_t> triangles_a(NodeRef leaf) const;

    /// Encloses what lies below a child of a's tree, whatever rounds; between two times the bounds move
    /// in straight lines.
    [[nodiscard]] Box3 box_a(std::uint32_t name, double time) const;
    /// The same of b's tree, within b's radius, while time passes through the range.
    [[nodiscard]] Box3 box_b(std::uint32_t name, const TimeRange& range) const;

    [[nodiscard]] Triangle triangle_a(std::uint32_t triangle, double time) const;
    [[nodiscard]] Triangle triangle_b(std::uint32_t slot, double time) const;
    /// Their closest points are farther apart than their bodies, by this.
    [[nodiscard]] double radius() const { return b_.radius; }
    /// From where they are now the two triangles stay apart for at least this long, and a gap of half
    /// of the tolerance is left then.
    [[nodiscard]] double free_time(std::uint32_t triangle_a, const Triangle& a, const Triangle& b,
                                   const ClosestPoints& closest, double time,
                                   double tolerance) const;

    /// Whether the triangles share a point where `at` takes them: exact where the radius is 0.
    [[nodiscard]] bool meet(std::uint32_t triangle_a, std::uint32_t slot, double time) const;
    /// Where the frame has come to.
    [[nodiscard]] Vec3 shift(double time) const { return time * velocity_; }
    /// The body's own number of the triangle: of models and their like; else 0.
    [[nodiscard]] std::uint32_t number_b(std::uint32_t slot) const;
    /// A length below which nothing is known, for rounding.
    [[nodiscard]] double margin() const { return margin_; }
    /// The larger one's, about: half of its diagonal.
    [[nodiscard]] double size() const { return size_; }

private:
    const DeformableData& a_;
    OffsetSurface b_;
    bool is_model_; ///< b has triangles that a caller knows
    Trajectory moving_, turning_;
    Vec3 velocity_;
    double size_ = 0, margin_ = 0;
};

} // namespace abut
