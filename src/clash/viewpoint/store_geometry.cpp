#include <abut/error.h>

#include "clash/viewpoint/mesh_runs.h"
#include "clash/viewpoint/view_geometry.h"
#include "core/arguments.h"
#include "math/transform.h"
#include "store/database/store_file.h"

#include <map>
#include <mutex>
#include <unordered_map>

namespace abut {

namespace {

/// Bytes of mesh blocks that are kept for the next viewpoints.
constexpr std::size_t kCacheBytes = std::size_t{128} << 20;

/// A mesh block with its runs.
struct BlockRuns {
    explicit BlockRuns(Mesh block) : mesh(std::move(block)), runs(mesh) {}
    Mesh mesh;
    MeshRuns runs;
    [[nodiscard]] std::size_t bytes() const {
        return mesh.positions.size() * sizeof(Vec3) + mesh.triangles.size() * 12 + runs.bytes();
    }
};

/// A store: boxes of all parts in memory, mesh blocks read where a viewpoint needs them.
class StoreGeometry : public ViewGeometry {
public:
    StoreGeometry(const Store& store, const std::vector<Scene>& models) : store_(store) {
        std::unordered_map<std::string, std::uint32_t> report_model;
        for (std::uint32_t i = 0; i < models.size(); ++i)
            report_model.emplace(models[i].file, i);
        std::vector<std::unordered_map<std::string, std::uint32_t>> by_id(models.size());
        for (std::uint32_t m = 0; m < models.size(); ++m)
            for (std::uint32_t i = 0; i < models[m].parts.size(); ++i)
                by_id[m].emplace(models[m].parts[i].id, i);
        for (const ModelRow& model : store_.file().models()) {
            up = model.world_up;
            const auto found = report_model.find(model.file);
            store_.file().for_each_part(model, [&](const PartRow& part) {
                if (found != report_model.end())
                    if (const auto at = by_id[found->second].find(part.id);
                        at != by_id[found->second].end())
                        numbers_[{found->second, at->second}] =
                            static_cast<std::uint32_t>(rows_.size());
                rows_.push_back(part.part);
                boxes.push_back(part.box);
            });
            files_[model.model] = model.file;
        }
    }

    void gather(std::uint32_t part, const Box3& box,
                std::vector<Triangle>& triangles) const override {
        const PartRow row = store_.file().part(rows_[part]);
        const MeshRow mesh = store_.file().mesh(row.mesh);
        for (const BlockRow& block : store_.file().blocks(mesh)) {
            if (!overlap(placed_box(block.box, row.world_from_mesh), box))
                continue;
            const std::shared_ptr<const BlockRuns> runs = runs_of(block.block);
            runs->runs.gather(runs->mesh, row.world_from_mesh, box, triangles);
        }
    }
    [[nodiscard]] NamedPart name(std::uint32_t part) const override {
        const PartRow row = store_.file().part(rows_[part]);
        return {files_.at(row.model), row.id};
    }
    [[nodiscard]] std::uint32_t number(const ReportPart& part) const override {
        const auto found = numbers_.find(part);
        require(found != numbers_.end(), "a clash of the report refers to a part that the store "
                                         "lacks: find the clashes again");
        return found->second;
    }

private:
    std::shared_ptr<const BlockRuns> runs_of(std::int64_t block) const {
        {
            const std::scoped_lock lock(mutex_);
            if (const auto found = cache_.find(block); found != cache_.end())
                return found->second;
        }
        auto read = std::make_shared<const BlockRuns>(store_.file().read_block(block).mesh);
        const std::scoped_lock lock(mutex_);
        if (cached_bytes_ + read->bytes() > kCacheBytes) {
            cache_.clear();
            cached_bytes_ = 0;
        }
        if (cache_.emplace(block, read).second)
            cached_bytes_ += read->bytes();
        return read;
    }

    Store store_;
    std::vector<std::int64_t> rows_; ///< of the table `part`, by number
    std::map<ReportPart, std::uint32_t> numbers_;
    std::map<std::int64_t, std::string> files_;
    mutable std::mutex mutex_; ///< guards the members below
    mutable std::unordered_map<std::int64_t, std::shared_ptr<const BlockRuns>> cache_;
    mutable std::size_t cached_bytes_ = 0;
};

} // namespace

std::unique_ptr<ViewGeometry> view_geometry(const Store& store, const std::vector<Scene>& models) {
    return std::make_unique<StoreGeometry>(store, models);
}

} // namespace abut
