#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

namespace abut {

/// A rotation and origin for a mesh's tree in which boxes of its triangles are small.
///
/// In          the box of the mesh's triangles.
/// Returns     model_from_tree, rigid to rounding; the origin is the centre of the mesh's box.
/// Cost        a few hundred sampled triangles.
/// Source      candidates: the model's own axes, the principal axes of the surface [Gottschalk et
///             al. 1996], and the largest face with its longest edge. The least summed area of
///             triangle boxes wins.
Transform choose_tree_frame(const Mesh& mesh, const Box3& bounds);

} // namespace abut
