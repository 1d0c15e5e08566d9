#include "store/import/import_geometry.h"

#include <abut/error.h>

#include "core/parallel.h"
#include "core/parallel_pipeline.h"
#include "core/progress.h"
#include "io/file/fault.h"
#include "io/scene/part_checks.h"
#include "mesh/used_positions.h"
#include "store/import/large_mesh.h"
#include "store/import/mesh_draft.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <tbb/global_control.h>

namespace abut {

namespace {

/// The parts of a model file, grouped by mesh.
struct PartsOfMeshes {
    std::vector<std::uint64_t> first; ///< index in `parts` of each mesh's first part; one more
                                      ///< entry at the end
    std::vector<std::uint32_t> parts;

    explicit PartsOfMeshes(const SceneSource& source)
        : first(std::size_t{source.meshes()} + 1), parts(source.parts().size()) {
        PartSpool::Cursor cursor(source.parts());
        std::vector<std::uint32_t> mesh_of(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            mesh_of[i] = cursor.placement(i).mesh;
            ++first.at(mesh_of[i] + std::size_t{1});
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::uint64_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t i = 0; i < parts.size(); ++i)
            parts[next[mesh_of[i]]++] = i;
    }
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t mesh) const {
        return std::span(parts).subspan(first[mesh], first[mesh + std::size_t{1}] - first[mesh]);
    }
};

/// Some meshes that go through the pipeline together.
struct Batch {
    struct Item {
        std::uint32_t mesh = 0;
        MeshDraft draft;
        std::optional<std::int64_t> stored;
        std::vector<BlockDraft> blocks;
    };
    std::vector<Item> items;
};
using BatchPointer = std::shared_ptr<Batch>;

class GeometryImport {
public:
    GeometryImport(const SceneSource& source, const std::string& file, std::uint64_t memory,
                   const Progress& progress, StoreWriter& writer, ImportedGeometry& result)
        : source_(source), file_(file), memory_(memory), progress_(progress), writer_(writer),
          result_(result), parts_of_(source), tokens_(1 + threads()),
          meter_(progress, "geometry", total_triangles(source)) {
        result.meshes.resize(source.meshes());
        result.triangles.resize(source.meshes());
        for (std::uint32_t i = 0; i < source.meshes(); ++i)
            result.triangles[i] = static_cast<std::uint32_t>(source.size(i).triangles);
    }

    void run() {
        for (std::uint32_t i = 0; i < source_.meshes(); ++i)
            if (is_large(i))
                import_large(i);
        import_others();
        writer_.commit();
        if (!has_area_)
            throw Error(ErrorCode::bad_mesh, file_, "holds only degenerate triangles");
    }

private:
    static std::size_t threads() {
        return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    }
    static std::size_t total_triangles(const SceneSource& source) {
        std::size_t total = 0;
        for (std::uint32_t i = 0; i < source.meshes(); ++i)
            total += source.size(i).triangles;
        return total;
    }

    [[nodiscard]] bool is_large(std::uint32_t mesh) const {
        return source_.streams() && loading_bytes(source_.size(mesh)) > memory_ / tokens_;
    }

    /// Adds to a mesh's fault the file and the first part that shows the mesh.
    template <typename Work>
    void naming_part(std::uint32_t mesh, const Work& work) const {
        try {
            work();
        } catch (const Fault& fault) {
            const auto parts = parts_of_.of(mesh);
            const std::string part =
                parts.empty() ? "" : "part " + source_.parts().part(parts.front()).id + ": ";
            throw Error(fault.code(), file_, part + fault.what());
        }
    }

    [[nodiscard]] Transform placement(std::uint32_t part) const {
        const Transform world_from_mesh = source_.parts().placement(part).world_from_mesh;
        if (!stays_finite(world_from_mesh))
            throw Error(ErrorCode::bad_mesh, file_,
                        "part " + source_.parts().part(part).id +
                            ": its transform is not finite or too large");
        return world_from_mesh;
    }

    void import_large(std::uint32_t mesh) {
        const auto parts = parts_of_.of(mesh);
        std::vector<Transform> placements;
        for (const std::uint32_t part : parts)
            placements.push_back(placement(part));
        LargeMesh large;
        naming_part(mesh, [&] {
            large = import_large_mesh(source_, mesh, placements, memory_, progress_, writer_);
        });
        result_.meshes[mesh] = large.mesh;
        for (std::size_t i = 0; i < parts.size(); ++i)
            result_.set_box(parts[i], large.boxes[i]);
        if (large.has_area)
            has_area_ = true;
        meter_.advance(source_.size(mesh).triangles);
    }

    /// Reads and checks batches in parallel, and writes them in order. The numbers in the store
    /// therefore do not depend on the threads.
    void import_others() {
        parallel_pipeline<BatchPointer>(
            tokens_, [&] { return next_batch(); },
            [&](const BatchPointer& batch) {
                for (Batch::Item& item : batch->items)
                    naming_part(item.mesh, [&] { prepare(item); });
            },
            [&](const BatchPointer& batch) {
                for (Batch::Item& item : batch->items)
                    store(item);
            });
    }

    /// Returns null after the last batch.
    BatchPointer next_batch() {
        auto batch = std::make_shared<Batch>();
        const std::uint64_t most = std::min<std::uint64_t>(memory_ / tokens_, kBatchBytes);
        std::uint64_t bytes = 0;
        for (; next_ < source_.meshes(); ++next_) {
            if (is_large(next_))
                continue;
            bytes += loading_bytes(source_.size(next_));
            if (!batch->items.empty() && bytes > most)
                break;
            batch->items.emplace_back().mesh = next_;
        }
        return batch->items.empty() ? BatchPointer{} : batch;
    }

    void prepare(Batch::Item& item) {
        check_stop(progress_);
        item.draft = load_mesh(source_, item.mesh);
        const Mesh& mesh = item.draft.mesh;
        const auto parts = parts_of_.of(item.mesh);
        {
            const UsedPositions used(mesh);
            parallel_for(parts.size(), 64, [&](std::size_t i) {
                const Transform world_from_mesh = placement(parts[i]);
                result_.set_box(parts[i], world_box(used.get(), world_from_mesh));
                if (!has_area_ && has_area(mesh, world_from_mesh))
                    has_area_ = true;
            });
        }
        item.stored = writer_.find_mesh(item.draft.hash);
        if (!item.stored)
            item.blocks = encode_mesh(mesh);
    }

    void store(Batch::Item& item) {
        if (!item.stored) {
            MeshRow row;
            row.hash_low = item.draft.hash.low;
            row.hash_high = item.draft.hash.high;
            row.vertices = item.draft.mesh.positions.size();
            row.triangles = item.draft.mesh.triangles.size();
            row.closed = item.draft.closed;
            row.box = item.draft.box;
            item.stored = writer_.add_mesh(row, item.blocks);
        }
        result_.meshes[item.mesh] = *item.stored;
        meter_.advance(item.draft.mesh.triangles.size());
        item = {};
    }

    static constexpr std::uint64_t kBatchBytes = std::uint64_t{4} << 20;

    const SceneSource& source_;
    const std::string& file_;
    std::uint64_t memory_;
    const Progress& progress_;
    StoreWriter& writer_;
    ImportedGeometry& result_;
    PartsOfMeshes parts_of_;
    std::size_t tokens_;
    ProgressMeter meter_;
    std::uint32_t next_ = 0;
    std::atomic<bool> has_area_{false};
};

} // namespace

void import_geometry(const SceneSource& source, const std::string& file, std::uint64_t memory,
                     const Progress& progress, StoreWriter& writer, ImportedGeometry& result) {
    GeometryImport(source, file, memory, progress, writer, result).run();
}

} // namespace abut
