#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include "math/vector.h"

#include <cstddef>
#include <cstdint>

namespace abut {

/// Axes that a mesh's tree may have.
enum class TreeAxes : std::uint8_t { of_model, principal, of_largest_face };
inline constexpr std::size_t kTreeAxes = 3;

struct TreeFrame {
    TreeAxes axes{};
    Transform model_from_tree; ///< rigid to rounding; the origin is the centre of the mesh's box
};

/// A point as seen from the middle of a box. A box and a point that are moved together, without
/// rounding, give the same bits: so a mesh's tree does not depend on where the mesh lies.
inline Vec3 from_middle(const Box3& box, const Vec3& point) {
    return (point - box.lower) - 0.5 * (box.upper - box.lower);
}

/// A rotation and origin for a mesh's tree in which boxes of its triangles are small.
///
/// In          the box of the mesh's triangles.
/// Cost        a few hundred sampled triangles.
/// Source      candidates: the model's own axes, the principal axes of the surface [Gottschalk et
///             al. 1996], and the largest face with its longest edge. The least summed area of
///             triangle boxes wins.
TreeFrame choose_tree_frame(const Mesh& mesh, const Box3& bounds);

/// The same where it is known which axes win.
TreeFrame tree_frame(const Mesh& mesh, const Box3& bounds, TreeAxes axes);

} // namespace abut
