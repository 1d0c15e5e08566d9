#pragma once

#include <abut/types.h>

#include "store/store_file.h"
#include "walk/part_table.h"
#include "walk/predicted_path.h"
#include "world/body.h"

#include <condition_variable>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace abut {

/// A piece in memory: a model, shared by all parts that show it.
struct LoadedPiece {
    explicit LoadedPiece(Mesh mesh) : shape(Model(std::move(mesh))) {}

    BodyShape shape; ///< a Model
    /// Of a block: the numbers of its triangles in the mesh. Empty for a whole mesh.
    std::vector<std::uint32_t> triangle_ids;
    bool is_block = false;
    std::uint64_t bytes = 0;
    bool counts_solid = false; ///< `bytes` has what the model learns of itself as a solid
};

/// A part's piece in memory, and where it is.
struct Resident {
    Transform world_from_mesh;
    Aabb box; ///< as those of the table
    std::shared_ptr<LoadedPiece> piece;
    std::uint64_t last_use = 0; ///< number of the query
    std::uint32_t pins = 0;
};

struct CacheCounters {
    std::uint64_t read_ahead = 0, read_in_query = 0, evicted = 0;
    std::uint64_t residents = 0;
    std::uint64_t bytes = 0, peak_bytes = 0; ///< with the tables
};

/// Entries of a table in memory, which is bounded. What was used by the last queries stays; of the rest,
/// what is farthest from the predicted path goes first.
///
/// Two threads: one that asks (find, load and what changes parts), one that reads ahead (prefetch). While
/// a piece is read, room for twice its size is kept: for the bytes that the model is made of.
class PartCache {
public:
    /// In          store, table: must outlive the cache; memory: bytes, of which the tables take some.
    PartCache(StoreFile& store, const PartTable& table, std::uint64_t memory);

    /// Keeps an entry in memory while it lives.
    class Pin {
    public:
        Pin() = default;
        Pin(PartCache& cache, Resident& resident) : cache_(&cache), resident_(&resident) {}
        Pin(Pin&& other) noexcept
            : cache_(other.cache_), resident_(std::exchange(other.resident_, nullptr)) {}
        Pin& operator=(Pin&&) = delete;
        ~Pin() {
            if (resident_ != nullptr)
                cache_->unpin(*resident_);
        }
        explicit operator bool() const { return resident_ != nullptr; }
        const Resident* operator->() const { return resident_; }

    private:
        PartCache* cache_ = nullptr;
        Resident* resident_ = nullptr;
    };

    [[nodiscard]] bool has(std::uint32_t entry) const;
    /// Empty if the entry is not in memory.
    Pin find(std::uint32_t entry);
    /// Reads it if it is not in memory.
    ///
    /// Errors      those of the store.
    Pin load(std::uint32_t entry);
    /// Makes room for what the model learns of itself as a solid when it is first asked for that.
    void count_solid(const Pin& pin);

    enum class Outcome : std::uint8_t { present, loaded, no_room, gone };
    /// Brings an entry into memory if it is not there, instead of what is farther from the path.
    ///
    /// In          key: of its box.
    /// Errors      those of the store.
    Outcome prefetch(std::uint32_t entry, float key);
    /// What is far, from now on.
    void set_path(const PredictedPath& path);
    /// Another frame has begun.
    void begin_frame();

    /// The entry is elsewhere than the store has it.
    void place(std::uint32_t entry, const Transform& world_from_mesh, const Aabb& box);
    /// The entry is not to be had any more.
    void remove(std::uint32_t entry);

    /// Of the memory, so much is taken by tables.
    void set_table_bytes(std::uint64_t bytes);
    /// What the tables must leave at least for a piece whose model takes so much.
    static std::uint64_t least_memory(std::uint64_t bytes);
    [[nodiscard]] CacheCounters counters() const;

private:
    struct Placement {
        Transform world_from_mesh;
        Aabb box;
    };
    struct SharedPiece {
        std::shared_ptr<LoadedPiece> piece;
        std::uint32_t users = 0;
    };
    struct Victim {
        float key;
        std::uint32_t entry;
        std::uint64_t last_use;
    };
    using Lock = std::unique_lock<std::mutex>;
    /// What is freed when the lock has been left.
    using Garbage = std::vector<std::shared_ptr<LoadedPiece>>;

    Pin pin(Resident& resident);
    void unpin(Resident& resident);
    Resident* find_resident(std::uint32_t entry);
    [[nodiscard]] std::uint64_t bytes_to_load(std::uint32_t piece) const;
    Resident& bring(Lock& lock, std::uint32_t entry, Garbage& garbage);
    std::shared_ptr<LoadedPiece> read(const StoredPiece& piece);
    void wait_for_a_load(Lock& lock);
    bool make_room(std::uint64_t bytes, float farther_than, Garbage& garbage);
    bool gather_victims();
    void evict(std::unordered_map<std::uint32_t, Resident>::iterator at, Garbage& garbage);
    void release(std::uint32_t piece, Garbage& garbage);
    void add_bytes(std::uint64_t bytes);

    StoreFile& store_;
    const PartTable& table_;
    mutable std::mutex mutex_;
    std::condition_variable changed_; ///< something has been read, or could not be
    std::uint64_t memory_, table_bytes_ = 0;
    std::unordered_map<std::uint32_t, Resident> residents_;   ///< by entry
    std::unordered_map<std::uint32_t, SharedPiece> pieces_;   ///< by piece
    std::unordered_set<std::uint32_t> loading_;               ///< pieces
    std::unordered_map<std::uint32_t, Placement> placements_; ///< entries that were moved
    std::unordered_set<std::uint32_t> removed_;               ///< entries
    std::vector<Victim> victims_;                             ///< the first to go last
    PredictedPath path_;
    std::uint64_t queries_ = 0, frames_ = 0;
    std::uint64_t recent_ = 0, next_recent_ = 0; ///< queries from here on are recent
    CacheCounters counters_;
};

} // namespace abut
