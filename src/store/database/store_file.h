#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include "store/codec/mesh_codec.h"
#include "store/database/hierarchy_table.h"
#include "store/database/schema.h"
#include "store/database/sqlite.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace abut {

/// A mesh block with its row.
struct StoredBlockData {
    BlockRow row;
    MeshBlock block;
};

/// A store opened for reading: the input of jobs on models that do not fit into memory. Every row
/// and block is compared with its checksum when it is read.
///
/// All members may be called from any thread. Each call takes a connection of its own from a pool.
///
/// Errors      of all members: Error, naming the store: malformed for damage, unreadable while
///             another process writes, bad_argument for a number that is not in the store.
class StoreFile {
public:
    StoreFile(std::string path, bool read_only)
        : StoreFile(std::move(path), read_only ? OpenMode::read_only : OpenMode::read_write) {}
    /// In: mode. `immutable` reads what an import wrote, while a job of this program records its
    /// results in the same file.
    StoreFile(std::string path, OpenMode mode);
    ~StoreFile();
    StoreFile(const StoreFile&) = delete;
    StoreFile& operator=(const StoreFile&) = delete;

    [[nodiscard]] const std::string& path() const noexcept { return path_; }

    /// All models by number, which is the order of their first import.
    std::vector<ModelRow> models();

    /// As Scene::precision, of a model by its number.
    ModelPrecision precision(std::int64_t model);

    /// Visits the parts of all models, or of one, in the order of the file. A model that is being
    /// imported still has its former parts. Checks that no part is missing.
    void for_each_part(const std::function<void(const PartRow&)>& take);
    void for_each_part(const ModelRow& model, const std::function<void(const PartRow&)>& take);
    PartRow part(std::int64_t part);
    /// The properties of parts, and the relations between them, by their places in the list.
    ///
    /// In          parts: rows, each once
    Properties properties(std::span<const std::int64_t> parts);
    std::vector<PartRelation> relations(std::span<const std::int64_t> parts);
    /// The properties of these names only.
    Properties properties(std::span<const std::int64_t> parts, std::span<const std::string> names);

    void for_each_mesh(const std::function<void(const MeshRow&)>& take);
    MeshRow mesh(std::int64_t mesh);

    /// The whole mesh, bit for bit as it was imported.
    Mesh read_mesh(std::int64_t mesh);

    /// The rows of a mesh's blocks, without their data. Mainly used for the boxes.
    std::vector<BlockRow> blocks(const MeshRow& mesh);
    /// One mesh block. If the mesh was cut, with the numbers that its vertices
    /// and triangles have in the whole mesh.
    MeshBlock read_block(std::int64_t block) { return read_block_and_row(block).block; }
    StoredBlockData read_block_and_row(std::int64_t block);
    /// The mesh that lies in one block.
    Mesh whole_mesh(const MeshRow& row, MeshBlock block) const;

    /// The stored hierarchy of a block. None if there is none of this format, or if it cannot be
    /// read: the caller can build it.
    std::optional<HierarchyRow> find_hierarchy(const BlockRow& block);

    /// Compressed bytes of mesh blocks and hierarchies that were read since the store was opened.
    [[nodiscard]] std::uint64_t bytes_read() const noexcept { return bytes_read_; }

    /// Runs work(database) with a connection of the pool.
    template <typename Work>
    auto with_connection(const Work& work) {
        Lease lease(*this);
        return work(lease.connection->database);
    }

private:
    struct Connection {
        Connection(const std::string& path, OpenMode mode);
        Database database;
        Statement block, block_row, mesh, part;
        std::optional<Statement> hierarchy; ///< prepared once the table exists
    };
    struct Lease {
        explicit Lease(StoreFile& file);
        ~Lease();
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        StoreFile& owner;
        std::unique_ptr<Connection> connection;
    };

    StoredBlockData decode(const Statement& row);

    std::string path_;
    OpenMode mode_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Connection>> idle_;
    std::atomic<std::uint64_t> bytes_read_{0};
};

} // namespace abut
