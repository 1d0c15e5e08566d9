#include "clash/mesh_in_blocks.h"

#include "core/parallel.h"
#include "mesh/topology.h"
#include "mesh/used_positions.h"

#include <filesystem>
#include <utility>

namespace abut {

namespace {

/// Memory for the examination whether a mesh bounds a solid. It sorts on disk what exceeds this.
constexpr std::size_t kMemory = std::size_t{1} << 30;

class MeshInBlocks final : public ModelBlocks {
public:
    MeshInBlocks(std::uint64_t triangles, std::vector<Box3> boxes,
                 std::vector<std::shared_ptr<const ModelBlock>> blocks)
        : ModelBlocks(triangles, std::move(boxes), std::filesystem::temp_directory_path().string(),
                      kMemory),
          blocks_(std::move(blocks)) {}

    [[nodiscard]] std::shared_ptr<const ModelBlock> block(std::size_t i) const override {
        return blocks_[i];
    }

private:
    std::vector<std::shared_ptr<const ModelBlock>> blocks_;
};

} // namespace

ModelBlock make_model_block(MeshBlock piece) {
    return {Model(std::move(piece.mesh)), std::move(piece.triangle_ids)};
}

std::unique_ptr<const ModelBlocks> in_blocks(const Mesh& mesh, std::uint64_t most) {
    require_valid(mesh);
    std::vector<MeshBlock> pieces;
    std::vector<Box3> boxes;
    cut_into_blocks(mesh, most, [&](const MeshBlock& piece) {
        if (piece.triangle_ids.empty())
            return;
        boxes.push_back({});
        for (const Vec3& p : piece.mesh.positions)
            extend(boxes.back(), p);
        pieces.push_back(piece);
    });
    std::vector<std::shared_ptr<const ModelBlock>> blocks(pieces.size());
    parallel_for(pieces.size(), 1, [&](std::size_t i) {
        blocks[i] = std::make_shared<const ModelBlock>(make_model_block(std::move(pieces[i])));
    });
    return std::make_unique<const MeshInBlocks>(mesh.triangles.size(), std::move(boxes),
                                                std::move(blocks));
}

} // namespace abut
