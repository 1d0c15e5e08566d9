#include <abut/error.h>
#include <abut/levels.h>

#include "core/parallel_pipeline.h"
#include "core/progress.h"
#include "core/stop.h"
#include "core/stop_watch.h"
#include "io/file/fault.h"
#include "math/transform.h"
#include "store/database/exclusive_store.h"
#include "store/database/level_table.h"
#include "store/database/row_hash.h"
#include "view/levels/chunk_maker.h"
#include "view/levels/level_items.h"
#include "view/levels/tree_writer.h"

#include <algorithm>
#include <memory>
#include <mutex>

namespace abut {

namespace {

constexpr std::uint64_t kLeastLevelMemory = std::uint64_t{64} << 20;
/// Upper bound on the memory of making one chunk.
constexpr std::uint64_t kJobBytes = std::uint64_t{32} << 20;
/// Bytes after which chunks are committed: what a killed build loses.
constexpr std::uint64_t kCommitBytes = std::uint64_t{16} << 20;

class LevelBuild {
public:
    LevelBuild(const std::string& path, const LevelOptions& options)
        : options_(options), store_(path, options.memory / 16, ExclusiveStore::IfMissing::fail),
          file_(path, OpenMode::immutable) {}

    LevelReport run() {
        const StopWatch watch;
        LevelReport report;
        const std::vector<ModelRow> models = file_.models();
        for (const ModelRow& model : models)
            if (model.importing)
                throw Error(ErrorCode::bad_argument, file_.path(),
                            "has an import that has not finished: import " + model.file +
                                " again before levels are built");
        const Hash128 content = level_content(models);
        Database& database = store_.database();
        if (level_tree_content(database) == content) {
            report_stored(report);
            report.seconds = watch.seconds();
            return report;
        }
        {
            Transaction transaction(database);
            create_level_tables(database);
            transaction.commit();
        }
        chunks_ = std::make_unique<LevelChunks>(database);
        items_ = list_level_items(file_, options_.memory / 2);
        nodes_ = plan_levels(items_.items);
        make_all();
        finish(content);
        report.built = true;
        report.new_chunks = new_chunks_;
        report_stored(report);
        report.seconds = watch.seconds();
        return report;
    }

private:
    struct Job {
        std::uint32_t number = 0; ///< of a node or of a shared mesh
        bool is_mesh = false;
        std::vector<MadeChunk> made;
    };

    void report_stored(LevelReport& report) {
        Database& database = store_.database();
        const auto number = [&](const char* sql) {
            return static_cast<std::uint64_t>(database.number(sql));
        };
        report.chunks = number("SELECT count(*) FROM level_chunk");
        report.triangles = number("SELECT sum(triangles) FROM level_chunk");
        report.stored_bytes = number("SELECT sum(bytes) FROM level_chunk") +
                              number("SELECT sum(length(data)) FROM level_tree");
        report.geometry_bytes = number("SELECT sum(stored_bytes) FROM mesh");
    }

    void make_all() {
        find_keys();
        std::vector<std::vector<Job>> heights(1);
        for (std::uint32_t i = 0; i < mesh_keys_.size(); ++i)
            if (!find_levels(i))
                heights[0].push_back({i, true, {}});
        std::vector<std::uint32_t> height(nodes_.size(), 0);
        for (auto i = static_cast<std::uint32_t>(nodes_.size()); i-- > 0;) {
            const PlannedNode& node = nodes_[i];
            for (std::uint32_t k = 0; k < node.children; ++k)
                height[i] = std::max(height[i], height[node.first_child + k] + 1);
            if (is_instance(node))
                continue;
            const std::optional<LevelChunkRow> found = chunks_->find(keys_[i]);
            if (found) {
                rows_[i] = *found;
                continue;
            }
            heights.resize(std::max<std::size_t>(heights.size(), height[i] + 1));
            heights[height[i]].push_back({i, false, {}});
        }
        std::size_t total = 0;
        for (const auto& jobs : heights)
            total += jobs.size();
        ProgressMeter meter(options_.progress, "levels", std::max<std::size_t>(total, 1));
        try {
            for (auto& jobs : heights)
                make(jobs, meter);
        } catch (const Error&) {
            keep_made();
            throw;
        }
        commit();
    }

    [[nodiscard]] bool is_instance(const PlannedNode& node) const {
        return node.is_leaf() && items_.items[node.begin].is_instance();
    }

    /// The key of a chunk is the hash of all that it is made from.
    void find_keys() {
        keys_.resize(nodes_.size());
        rows_.resize(nodes_.size());
        for (std::size_t i = nodes_.size(); i-- > 0;) {
            const PlannedNode& node = nodes_[i];
            RowHash hash;
            hash.add(kLevelFormat).add(items_.origin.x).add(items_.origin.y).add(items_.origin.z);
            hash.add(node.slice).add(node.slices).add(node.children);
            for (std::uint32_t k = 0; k < node.children; ++k)
                hash.add(keys_[node.first_child + k].low).add(keys_[node.first_child + k].high);
            for (std::uint32_t k = node.begin; node.is_leaf() && k < node.end; ++k)
                hash.add(items_.items[k].digest);
            keys_[i] = hash.value_128();
        }
        for (const SharedMesh& mesh : items_.shared)
            mesh_keys_.push_back(mesh.key);
        mesh_rows_.resize(mesh_keys_.size());
    }

    [[nodiscard]] Hash128 level_key(std::uint32_t mesh, std::uint32_t level) const {
        return RowHash()
            .add(kLevelFormat)
            .add(mesh_keys_[mesh].low)
            .add(mesh_keys_[mesh].high)
            .add(level)
            .value_128();
    }

    /// The levels of a mesh are added coarsest first: if the finest is there, all are.
    bool find_levels(std::uint32_t mesh) {
        for (std::uint32_t level = 0;; ++level) {
            const std::optional<LevelChunkRow> found = chunks_->find(level_key(mesh, level));
            if (!found)
                return level > 0;
            mesh_rows_[mesh].push_back(*found);
        }
    }

    void make(std::vector<Job>& jobs, ProgressMeter& meter) {
        const std::atomic<bool>* const stop = t_stop_flag;
        std::size_t next = 0;
        const auto take = [&]() -> Job* {
            poll_stop();
            return next < jobs.size() ? &jobs[next++] : nullptr;
        };
        const auto work = [&](Job* job) {
            const StopScope scope(stop);
            work_on(*job);
        };
        const auto give = [&](Job* job) {
            store(*job);
            job->made = {};
            meter.advance();
        };
        const std::size_t tokens =
            std::clamp<std::uint64_t>(options_.memory / 2 / kJobBytes, 1, 64);
        parallel_pipeline<Job*>(tokens, take, work, give);
    }

    void work_on(Job& job) {
        poll_stop();
        try {
            if (job.is_mesh) {
                const SharedMesh& mesh = items_.shared[job.number];
                job.made = make_mesh_levels(file_, mesh.mesh, mesh.centre);
                return;
            }
            const PlannedNode& node = nodes_[job.number];
            if (node.is_leaf()) {
                const std::span<const LevelItem> items(items_.items);
                job.made.push_back(make_leaf(file_,
                                             items.subspan(node.begin, node.end - node.begin),
                                             items_.origin, node.slice, node.slices));
                return;
            }
            std::vector<ChildSurface> children;
            for (std::uint32_t k = 0; k < node.children; ++k)
                children.push_back(child_surface(node.first_child + k));
            job.made.push_back(make_parent(std::move(children)));
        } catch (const Fault& fault) {
            throw Error(fault.code(), file_.path(), fault.what());
        }
    }

    ChildSurface child_surface(std::uint32_t number) {
        const PlannedNode& node = nodes_[number];
        if (is_instance(node))
            return instance_surface(file_, items_.items[node.begin], items_.origin);
        const LevelChunkRow& row = rows_[number];
        std::vector<std::byte> data;
        {
            const std::scoped_lock lock(mutex_);
            data = chunks_->read(row);
        }
        return chunk_surface(row, data);
    }

    void store(Job& job) {
        const std::scoped_lock lock(mutex_);
        if (!transaction_)
            transaction_ = std::make_unique<Transaction>(store_.database());
        if (job.is_mesh) {
            std::vector<LevelChunkRow>& rows = mesh_rows_[job.number];
            for (std::uint32_t level = 0; level < job.made.size(); ++level)
                job.made[level].row.key = level_key(job.number, level);
            for (std::size_t i = job.made.size(); i-- > 0;)
                add(job.made[i]);
            for (const MadeChunk& made : job.made)
                rows.push_back(made.row);
        } else {
            job.made[0].row.key = keys_[job.number];
            add(job.made[0]);
            rows_[job.number] = job.made[0].row;
        }
        if (pending_ >= kCommitBytes)
            commit_now();
    }

    void add(MadeChunk& made) {
        chunks_->add(made.row, made.data);
        pending_ += made.data.size();
        ++new_chunks_;
    }

    void commit() {
        const std::scoped_lock lock(mutex_);
        commit_now();
    }
    /// Keeps the chunks for the next call, if the store can still be written.
    void keep_made() noexcept {
        try {
            commit();
        } catch (const Error&) { // NOLINT: the caller tells the first error
            transaction_.reset();
        }
    }
    void commit_now() {
        if (transaction_)
            transaction_->commit();
        transaction_.reset();
        pending_ = 0;
    }

    void finish(const Hash128& content) {
        const LevelTree tree = make_tree(file_, items_, nodes_, rows_, mesh_rows_);
        std::vector<std::int64_t> used = tree.chunk_rows;
        std::sort(used.begin(), used.end());
        Transaction transaction(store_.database());
        replace_level_tree(store_.database(), {content, encode_tree(tree)}, used);
        transaction.commit();
    }

    const LevelOptions& options_;
    ExclusiveStore store_;
    StoreFile file_;   ///< reads what imports wrote, without locks
    std::mutex mutex_; ///< guards the connection that writes
    std::unique_ptr<LevelChunks> chunks_;
    std::unique_ptr<Transaction> transaction_;
    std::uint64_t pending_ = 0, new_chunks_ = 0;
    LevelItems items_;
    std::vector<PlannedNode> nodes_;
    std::vector<Hash128> keys_, mesh_keys_;
    std::vector<LevelChunkRow> rows_;                   ///< by node
    std::vector<std::vector<LevelChunkRow>> mesh_rows_; ///< by shared mesh, finest first
};

} // namespace

LevelReport build_levels(const std::string& store, const LevelOptions& options) {
    if (options.memory < kLeastLevelMemory)
        throw Error(ErrorCode::bad_argument, "levels of detail need at least 64 MiB of memory");
    static_cast<void>(open_store(store)); // refuses what is no store, and repairs it
    const StopScope scope(options.progress);
    return LevelBuild(store, options).run();
}

} // namespace abut
