#pragma once

#include <abut/mesh.h>

#include "rigid/model/model_blocks.h"
#include "store/import/cut_mesh.h"

#include <memory>

namespace abut {

/// Cuts a mesh in memory into the same blocks that a store would hold.
///
/// In          most: triangles of a block, at most.
/// Errors      Error{bad_mesh}.
std::unique_ptr<const ModelBlocks> in_blocks(const Mesh& mesh,
                                             std::uint64_t most = kBlockTriangles);

/// Builds the model of one mesh block.
ModelBlock make_model_block(MeshBlock piece);

} // namespace abut
