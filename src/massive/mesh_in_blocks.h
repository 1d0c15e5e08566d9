#pragma once

#include <abut/mesh.h>

#include "rigid/model_blocks.h"
#include "store/cut_mesh.h"

#include <memory>

namespace abut {

/// A mesh in memory in the blocks that a store has of it; most: triangles of a block.
///
/// Errors      Error{bad_mesh}.
std::unique_ptr<const ModelBlocks> in_blocks(const Mesh& mesh,
                                             std::uint64_t most = kPieceTriangles);

/// A block of a store as a model of its own.
ModelBlock make_model_block(MeshBlock piece);

} // namespace abut
