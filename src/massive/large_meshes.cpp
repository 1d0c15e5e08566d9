#include "massive/large_meshes.h"

#include "core/parallel.h"
#include "store/cut_mesh.h"

#include <algorithm>
#include <filesystem>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tuple>

namespace abut {

namespace {

/// Two of each side, and one that is coming in, whose triangles are in memory twice.
constexpr std::uint64_t kBlocksAThread = 6;
/// Of the budget, for the examination of a solid.
constexpr std::uint64_t kExaminationShare = 8;

std::uint64_t largest_block(const StoredParts& stored) {
    std::uint64_t bytes = 0;
    for (const LargeMesh& mesh : stored.large)
        for (const StoredBlock& block : mesh.blocks)
            bytes = std::max(bytes, block.bytes);
    return bytes;
}

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
    Blocks(BlockCache& cache, const LargeMesh& mesh, const std::string& folder,
           std::uint64_t memory)
        : ModelBlocks(mesh.triangles, boxes_of(mesh), folder, memory), cache_(cache), mesh_(mesh) {}

    [[nodiscard]] std::shared_ptr<const ModelBlock> block(std::size_t i) const override {
        return cache_.get(mesh_.blocks[i]);
    }

private:
    static std::vector<Box3> boxes_of(const LargeMesh& mesh) {
        std::vector<Box3> boxes;
        boxes.reserve(mesh.blocks.size());
        for (const StoredBlock& block : mesh.blocks)
            boxes.push_back(block.box);
        return boxes;
    }

    BlockCache& cache_;
    const LargeMesh& mesh_;
};

LargeMeshes::LargeMeshes(StoreFile& store, const StoredParts& stored, std::uint64_t budget)
    : stored_(stored), cache_(store, for_blocks(budget)) {
    const std::string folder = folder_of(store.path());
    for (const LargeMesh& mesh : stored.large)
        blocks_.push_back(
            std::make_unique<const Blocks>(cache_, mesh, folder, budget / kExaminationShare));
    if (!blocks_.empty())
        threads_ = static_cast<int>(std::clamp<std::uint64_t>(
            for_blocks(budget) / (kBlocksAThread * largest_block(stored)), 1,
            tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
}

const ModelBlocks* LargeMeshes::find(std::uint32_t mesh) const {
    const LargeMesh* const large = stored_.find_large(mesh);
    return large == nullptr ? nullptr
                            : blocks_[static_cast<std::size_t>(large - stored_.large.data())].get();
}

bool LargeMeshes::is_large(const IndexPair& pair) const {
    return stored_.find_large(stored_.parts[pair.a()].mesh) != nullptr ||
           stored_.find_large(stored_.parts[pair.b()].mesh) != nullptr;
}

void LargeMeshes::for_each_pair(std::span<const IndexPair> pairs,
                                const std::function<void(std::size_t)>& test) const {
    if (stored_.large.empty()) {
        parallel_for(pairs.size(), 1, test);
        return;
    }
    struct Place {
        std::uint32_t part;
        std::uint64_t cell;
        std::size_t k;
    };
    std::vector<std::size_t> whole;
    std::vector<Place> large;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (!is_large(pairs[k])) {
            whole.push_back(k);
            continue;
        }
        const PairCell cell = stored_.cell_of(pairs[k]);
        large.push_back({cell.part, cell.cell, k});
    }
    std::sort(large.begin(), large.end(), [](const Place& p, const Place& q) {
        return std::tie(p.part, p.cell, p.k) < std::tie(q.part, q.cell, q.k);
    });
    parallel_for(whole.size(), 1, [&](std::size_t i) { test(whole[i]); });
    tbb::task_arena arena(threads_);
    arena.execute([&] { parallel_for(large.size(), 1, [&](std::size_t i) { test(large[i].k); }); });
}

std::uint64_t LargeMeshes::bytes_needed() const {
    std::uint64_t bytes = 0;
    for (const LargeMesh& mesh : stored_.large) {
        const auto read = static_cast<std::uint64_t>(
            std::count_if(mesh.blocks.begin(), mesh.blocks.end(), [&](const StoredBlock& block) {
                return cache_.distinct().contains(block.row);
            }));
        bytes += mesh.stored_bytes * read / mesh.blocks.size();
    }
    return bytes;
}

std::uint64_t least_for_blocks(const StoredParts& stored) {
    const std::uint64_t blocks = kBlocksAThread * largest_block(stored);
    return blocks + blocks / (kExaminationShare - 1) + kExaminationShare;
}

} // namespace abut
