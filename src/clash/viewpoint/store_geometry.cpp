#include <abut/error.h>

#include "clash/viewpoint/mesh_runs.h"
#include "clash/viewpoint/view_geometry.h"
#include "core/arguments.h"
#include "math/transform.h"
#include "store/database/store_file.h"

#include <map>
#include <mutex>
#include <optional>
#include <string_view>
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
    /// In          find(file, part, place): the name by which clashes refer to a part, or none;
    ///             `place` counts the store's models, and the parts of each.
    template <typename Find>
    StoreGeometry(const Store& store, const Find& find) : store_(store) {
        ReportPart place;
        for (const ModelRow& model : store_.file().models()) {
            up = model.world_up;
            place.part = 0;
            store_.file().for_each_part(model, [&](const PartRow& part) {
                if (const std::optional<ReportPart> named = find(model.file, part, place))
                    numbers_[*named] = static_cast<std::uint32_t>(rows_.size());
                rows_.push_back(part.part);
                boxes.push_back(part.box);
                ++place.part;
            });
            files_[model.model] = model.file;
            ++place.model;
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
    std::unordered_map<std::string_view, std::uint32_t> model_of;
    std::vector<std::unordered_map<std::string_view, std::uint32_t>> part_of(models.size());
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        model_of.emplace(models[m].file, m);
        for (std::uint32_t i = 0; i < models[m].parts.size(); ++i)
            part_of[m].emplace(models[m].parts[i].id, i);
    }
    const auto in_report = [&](const std::string& file, const PartRow& row,
                               const ReportPart&) -> std::optional<ReportPart> {
        const auto model = model_of.find(file);
        if (model == model_of.end())
            return std::nullopt;
        const auto part = part_of[model->second].find(row.id);
        if (part == part_of[model->second].end())
            return std::nullopt;
        return ReportPart{model->second, part->second};
    };
    return std::make_unique<StoreGeometry>(store, in_report);
}

NamedGeometry view_geometry(const Store& store, std::span<const NamedPart> parts) {
    NamedGeometry result;
    result.parts.resize(parts.size());
    std::size_t found = 0;
    const auto by_words = [&](const std::string& file, const PartRow& row,
                              const ReportPart& place) -> std::optional<ReportPart> {
        std::optional<ReportPart> named;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (parts[i].id == row.id && parts[i].file == file) {
                result.parts[i] = {place, row};
                named = place;
                ++found;
            }
        return named;
    };
    result.geometry = std::make_unique<StoreGeometry>(store, by_words);
    require(found == parts.size(), "a part of the clash is not in the store");
    return result;
}

} // namespace abut
