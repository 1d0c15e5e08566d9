#include "massive/work/large_meshes.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <tbb/global_control.h>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// Blocks in memory per thread: two of each part, and one that is being read, whose triangles are
/// in memory twice.
constexpr std::uint64_t kBlocksAThread = 6;
/// Divisor of the budget: this share is for the examination whether a mesh bounds a solid.
constexpr std::uint64_t kExaminationShare = 8;

std::uint64_t for_blocks(std::uint64_t budget) {
    return budget - budget / kExaminationShare;
}

std::string folder_of(const std::string& store) {
    const std::string folder = std::filesystem::path(store).parent_path().string();
    return folder.empty() ? "." : folder;
}

} // namespace

class LargeMeshes::Blocks final : public ModelBlocks {
public:
    Blocks(BlockCache& cache, const MeshRow& row, std::vector<StoredBlock> blocks,
           const std::string& folder, std::uint64_t memory)
        : ModelBlocks(row.triangles, boxes_of(blocks), folder, memory), cache_(cache),
          stored_bytes_(row.stored_bytes), blocks_(std::move(blocks)) {}

    [[nodiscard]] std::shared_ptr<const ModelBlock> block(std::size_t i) const override {
        return cache_.get(blocks_[i]);
    }
    /// Compressed bytes of the blocks that were read, estimated from their mean size.
    [[nodiscard]] std::uint64_t bytes_needed() const {
        const auto read = static_cast<std::uint64_t>(
            std::ranges::count_if(blocks_, [&](const StoredBlock& block) {
                return cache_.distinct().contains(block.row);
            }));
        return stored_bytes_ * read / blocks_.size();
    }

private:
    static std::vector<Box3> boxes_of(const std::vector<StoredBlock>& blocks) {
        std::vector<Box3> boxes;
        boxes.reserve(blocks.size());
        for (const StoredBlock& block : blocks)
            boxes.push_back(block.box);
        return boxes;
    }

    BlockCache& cache_;
    std::uint64_t stored_bytes_;
    std::vector<StoredBlock> blocks_;
};

LargeMeshes::LargeMeshes(ModelReader& reader, std::uint64_t budget)
    : store_(reader.store()), budget_(budget), cache_(reader, for_blocks(budget)) {}

LargeMeshes::~LargeMeshes() = default;

const ModelBlocks& LargeMeshes::open(std::int64_t mesh) {
    std::unique_ptr<const Blocks>& blocks = meshes_[mesh];
    if (blocks == nullptr) {
        const MeshRow row = store_.mesh(mesh);
        std::vector<StoredBlock> list = stored_blocks(store_, row);
        for (const StoredBlock& block : list)
            largest_block_ = std::max(largest_block_, block.bytes);
        blocks = std::make_unique<const Blocks>(
            cache_, row, std::move(list), folder_of(store_.path()), budget_ / kExaminationShare);
    }
    return *blocks;
}

int LargeMeshes::threads() const {
    const std::uint64_t most =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    if (largest_block_ == 0)
        return static_cast<int>(most);
    return static_cast<int>(std::clamp<std::uint64_t>(
        for_blocks(budget_) / (kBlocksAThread * largest_block_), 1, most));
}

std::uint64_t LargeMeshes::bytes_needed() const {
    std::uint64_t bytes = 0;
    for (const auto& [row, blocks] : meshes_)
        bytes += blocks->bytes_needed();
    return bytes;
}

std::uint64_t least_for_blocks(const StoredParts& stored) {
    std::uint64_t largest = 0;
    for (const StoredLargeMesh& mesh : stored.large)
        largest = std::max(largest, mesh.largest_block);
    const std::uint64_t blocks = kBlocksAThread * largest;
    return blocks + blocks / (kExaminationShare - 1) + kExaminationShare;
}

} // namespace abut
