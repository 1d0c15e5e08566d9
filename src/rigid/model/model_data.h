#pragma once

#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/types.h>

#include "math/transform.h"
#include "rigid/model/solid.h"
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

/// What is dear to find of a model's hierarchy.
struct ModelOutline {
    TreeAxes axes{};
    TreeOutline tree;

    friend bool operator==(const ModelOutline&, const ModelOutline&) = default;
};

/// A mesh and its tree. The tree's boxes are aligned to a frame of its own, chosen so that they fit
/// tightly.
class ModelData {
public:
    /// Errors      Error{bad_mesh}.
    ModelData(Mesh mesh, const ModelOptions& options);
    /// As with default options, of a hierarchy whose outline is known.
    ///
    /// In          outline: passes is_outline for the mesh's triangles.
    ModelData(Mesh mesh, const ModelOutline& outline);

    [[nodiscard]] ModelOutline outline() const { return {axes_, outline_of(tree_)}; }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const Tree& tree() const { return tree_; }
    /// What was asked for.
    [[nodiscard]] const ModelOptions& options() const { return options_; }
    /// The volumes that were asked for in place of the tree's boxes; null if none were.
    [[nodiscard]] const VolumeTree* volumes() const { return volumes_.get(); }
    /// How far the triangles reach, in the mesh's frame.
    [[nodiscard]] const SupportBound& support() const { return support_; }
    /// Rigid to rounding, and a power of two in scale: the tree is about as large as 1.
    [[nodiscard]] const Transform& model_from_tree() const { return model_from_tree_; }
    /// Where the first vertex of slot 0 lies in the tree's frame. From there, what is elsewhere follows
    /// without the rounding that a mesh far from its origin brings. In: the tree is not empty.
    [[nodiscard]] const Vec3& first_in_tree() const { return first_in_tree_; }
    /// Of the bounding box of the vertices that a triangle uses, in the mesh's frame; 0 without any.
    [[nodiscard]] double diagonal() const { return diagonal_; }
    /// Mesh index of the triangle in a slot of the tree.
    [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const { return tree_.order[slot]; }
    /// World position of the triangle in a slot, by the formula of abut/types.h.
    [[nodiscard]] Triangle world_slot(std::uint32_t slot, const Transform& world) const {
        const auto& t = slots_[slot];
        return {apply(world, vertices_[t[0]]), apply(world, vertices_[t[1]]),
                apply(world, vertices_[t[2]])};
    }
    /// World position of a triangle by its mesh index.
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle, const Transform& world) const {
        const auto& t = mesh_.triangles[triangle];
        return {apply(world, mesh_.positions[t[0]]), apply(world, mesh_.positions[t[1]]),
                apply(world, mesh_.positions[t[2]])};
    }
    /// Whether the mesh bounds a solid; the first question examines it.
    [[nodiscard]] const Solid& solid() const { return solid_.of(mesh_); }
    [[nodiscard]] std::size_t bytes() const;

private:
    void build(const ModelOutline* outline);
    void sort_vertices();

    Mesh mesh_;
    ModelOptions options_;
    TreeAxes axes_{}; ///< of the tree
    SupportBound support_{{}};
    Transform model_from_tree_;
    Vec3 first_in_tree_;
    double diagonal_ = 0;
    Tree tree_;
    std::unique_ptr<const VolumeTree> volumes_;
    /// Copies of positions and triangles in the order of the leaves: what is near in space is near
    /// in memory.
    std::vector<Vec3> vertices_;
    std::vector<std::array<std::uint32_t, 3>> slots_;
    LazySolid solid_;
};

/// At least Model::bytes() of a mesh so large, and what a Model takes around it.
std::uint64_t most_model_bytes(std::uint64_t triangles, std::uint64_t vertices);

/// A model of the same mesh and options, its positions transformed: for a transform without an
/// inverse, under which the model itself cannot be asked.
///
/// Errors      Error{bad_mesh} if positions leave the range.
Model baked(const Model& model, const Transform& world);

} // namespace abut
