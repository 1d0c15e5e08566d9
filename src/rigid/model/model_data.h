#pragma once

#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/types.h>

#include "math/transform.h"
#include "rigid/model/convex_surface.h"
#include "rigid/model/slot_copies.h"
#include "rigid/model/solid.h"
#include "rigid/model/solid_boundary.h"
#include "rigid/model/tree_boxes.h"
#include "rigid/model/tree_frame.h"
#include "tree/obb_tree.h"
#include "tree/outline.h"
#include "tree/volume_tree.h"
#include "volume/support_bound.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// The part of a hierarchy that is expensive to recompute: the tree's axes and topology.
struct ModelOutline {
    TreeAxes axes{};
    TreeOutline tree;

    friend bool operator==(const ModelOutline&, const ModelOutline&) = default;
};

/// A mesh and its tree. The tree's boxes are aligned to a frame chosen so that they fit tightly.
class ModelData {
public:
    /// Errors      Error{bad_mesh}.
    ModelData(Mesh mesh, const ModelOptions& options);
    /// A model with default options, from the known outline of its hierarchy.
    ///
    /// In          outline: passes is_outline for the mesh's triangles.
    ModelData(Mesh mesh, const ModelOutline& outline);

    [[nodiscard]] ModelOutline outline() const { return {axes_, outline_of(tree_)}; }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const Tree& tree() const { return tree_; }
    [[nodiscard]] Volume volume() const { return volume_; }
    /// The bounding volumes that replace the tree's boxes; null if none were asked for.
    [[nodiscard]] const VolumeTree* volumes() const { return volumes_.get(); }
    /// Bounds on the extent of the triangles along any direction, in the mesh's frame.
    [[nodiscard]] const SupportBound& support() const { return support_; }
    /// Rigid to rounding, times a power of two: the tree has about the size 1.
    [[nodiscard]] const Transform& model_from_tree() const { return model_from_tree_; }
    /// The first vertex of slot 0 in the tree's frame. Positions relative to it avoid the rounding
    /// of a mesh far from its origin. In: the tree is not empty.
    [[nodiscard]] const Vec3& first_in_tree() const { return first_in_tree_; }
    /// The diagonal of the box of all vertices that a triangle uses, in the mesh's frame; 0 without
    /// triangles.
    [[nodiscard]] double diagonal() const { return diagonal_; }
    /// Mesh index of the triangle in a slot of the tree.
    [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const { return tree_.order[slot]; }
    /// World position of the triangle in a slot, by the formula of abut/types.h.
    [[nodiscard]] Triangle world_slot(std::uint32_t slot, const Transform& world) const {
        const auto& t = slots_[slot];
        return {apply(world, vertices_[t[0]]), apply(world, vertices_[t[1]]),
                apply(world, vertices_[t[2]])};
    }
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle, const Transform& world) const {
        const auto& t = mesh_.triangles[triangle];
        return {apply(world, mesh_.positions[t[0]]), apply(world, mesh_.positions[t[1]]),
                apply(world, mesh_.positions[t[2]])};
    }
    /// Tells whether the mesh bounds a solid. The first call examines it.
    [[nodiscard]] const Solid& solid() const { return solid_.of(mesh_); }
    /// The boundary of the solid, if that is not the whole surface. The first call searches for it.
    [[nodiscard]] const BoundarySearch& boundary() const { return boundary_.of(mesh_, solid()); }
    /// The tree's boxes in double precision. The first call makes them. In: the tree is not empty.
    [[nodiscard]] const std::vector<Box3>& tree_boxes() const { return tree_boxes_.of(*this); }
    /// Tells by slot which triangles are copies of others. The first call searches for them.
    [[nodiscard]] const std::vector<bool>& slot_copies() const { return slot_copies_.of(*this); }
    /// The planes and corners, if the mesh is the surface of a convex solid with few faces; else null.
    /// The first call examines it.
    [[nodiscard]] const ConvexSurface* convex_surface() const { return convex_surface_.of(*this); }
    [[nodiscard]] std::size_t bytes() const;

private:
    void build(const ModelOutline* outline);
    void sort_vertices();

    Mesh mesh_;
    Volume volume_ = Volume::automatic; ///< as asked for
    TreeAxes axes_{};
    SupportBound support_{{}};
    Transform model_from_tree_;
    Vec3 first_in_tree_;
    double diagonal_ = 0;
    Tree tree_;
    std::unique_ptr<const VolumeTree> volumes_;
    /// Copies of positions and triangles in the order of the leaves, so that triangles near in
    /// space are near in memory.
    std::vector<Vec3> vertices_;
    std::vector<std::array<std::uint32_t, 3>> slots_;
    LazySolid solid_;
    LazyBoundary boundary_;
    LazyTreeBoxes tree_boxes_;
    LazySlotCopies slot_copies_;
    LazyConvexSurface convex_surface_;
};

/// Upper bound on Model::bytes() for this many triangles and vertices, with the overhead of a
/// Model.
std::uint64_t most_model_bytes(std::uint64_t triangles, std::uint64_t vertices);

/// A model with the same options and transformed positions. It replaces a model under a transform
/// without an inverse, which queries cannot use.
///
/// Errors      Error{bad_mesh} if positions leave the range.
Model baked(const Model& model, const Transform& world);

} // namespace abut
