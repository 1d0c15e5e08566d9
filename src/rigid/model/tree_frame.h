#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include "math/vector.h"

#include <cstddef>
#include <cstdint>

namespace abut {

/// The axes that a mesh's tree may have.
enum class TreeAxes : std::uint8_t { of_model, principal, of_largest_face };
inline constexpr std::size_t kTreeAxes = 3;

struct TreeFrame {
    TreeAxes axes{};
    Transform model_from_tree; ///< rigid to rounding; the origin is the centre of the mesh's box
};

/// A point relative to the centre of a box. A box and a point that are moved together, without
/// rounding, give the same bits, so a mesh's tree does not depend on where the mesh lies.
inline Vec3 from_middle(const Box3& box, const Vec3& point) {
    return (point - box.lower) - 0.5 * (box.upper - box.lower);
}

/// Chooses a rotation and origin for a mesh's tree such that the boxes of its triangles are small.
///
/// In          the box of the mesh's triangles.
/// Cost        that of a few hundred sampled triangles.
/// Source      candidates: the model's own axes, the principal axes of the surface [Gottschalk et
///             al. 1996], and the largest triangle with its second-longest edge (the longer side of
///             a halved rectangle). The least summed area of triangle boxes wins.
TreeFrame choose_tree_frame(const Mesh& mesh, const Box3& bounds);

/// The frame for axes that are already chosen.
TreeFrame tree_frame(const Mesh& mesh, const Box3& bounds, TreeAxes axes);

} // namespace abut
