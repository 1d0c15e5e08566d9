#pragma once

#include <abut/types.h>

#include "store/model_reader.h"
#include "walk/part_table.h"
#include "world/body.h"

#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace abut {

/// A piece in memory: a model, shared by all parts that show it.
struct LoadedPiece {
    explicit LoadedPiece(Model model) : shape(std::move(model)) {}

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
    std::shared_ptr<LoadedPiece> piece;
    std::list<std::uint32_t>::iterator place; ///< in the order of eviction
    std::uint64_t last_use = 0;               ///< number of the lookup
    std::uint64_t plan = 0;                   ///< the last one that reached it
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
/// A plan goes through entries, nearest first. So a list has them in the order in which they are to go,
/// and no distance need be kept:
///
///     [ reached by older plans | by the last one, far to near | by this one, far to near ]
///       first to go
///
/// and where the first to go belongs to this plan, memory holds nothing that is farther than what comes
/// next.
///
/// Two threads: one that asks (find, load and what changes parts), one that reads ahead (begin_plan,
/// prefetch). Neither holds the lock for long. While a piece is read, room for twice its size is kept: for
/// the bytes that the model is made of.
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

    /// From now on, the first entry that is prefetched is the nearest.
    void begin_plan();
    enum class Urgency : std::uint8_t {
        at_its_place, ///< planned, where the table has it: not if it was moved
        planned,
        asked_for,
    };
    /// Brings an entry into memory if it is not there: as planned, instead of what the plan has not
    /// reached; if it was asked for, instead of anything. False if there is no such thing any more.
    ///
    /// Errors      those of the store.
    bool prefetch(std::uint32_t entry, Urgency urgency);
    /// Another frame has begun.
    void begin_frame();

    /// The entry is elsewhere than the store has it.
    void place(std::uint32_t entry, const Transform& world_from_mesh);
    /// The entry is not to be had any more.
    void remove(std::uint32_t entry);

    /// Of the memory, so much is taken by tables.
    void set_table_bytes(std::uint64_t bytes);
    /// What the tables must leave at least for a piece whose model takes so much.
    static std::uint64_t least_memory(std::uint64_t bytes);
    [[nodiscard]] CacheCounters counters() const;

private:
    struct SharedPiece {
        std::shared_ptr<LoadedPiece> piece;
        std::uint32_t users = 0;
    };
    /// What room may be made from.
    enum class Expendable : std::uint8_t { anything, beyond_plan };
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
    bool make_room_for(std::uint32_t piece, Expendable expendable, Garbage& garbage);
    bool make_room(std::uint64_t bytes, Expendable expendable, Garbage& garbage);
    void reach(Resident& resident);
    void move_to_end(Resident& resident);
    void take_out(const Resident& resident);
    void evict(std::unordered_map<std::uint32_t, Resident>::iterator at, Garbage& garbage);
    void release(std::uint32_t piece, Garbage& garbage);
    void add_bytes(std::uint64_t bytes);

    StoreFile& store_;
    ModelReader reader_;
    const PartTable& table_;
    mutable std::mutex mutex_;
    std::condition_variable changed_; ///< something has been read, or could not be
    std::uint64_t memory_, table_bytes_ = 0;
    std::unordered_map<std::uint32_t, Resident> residents_;   ///< by entry
    std::unordered_map<std::uint32_t, SharedPiece> pieces_;   ///< by piece
    std::unordered_set<std::uint32_t> loading_;               ///< pieces
    std::unordered_map<std::uint32_t, Transform> placements_; ///< of entries that were moved
    std::unordered_set<std::uint32_t> removed_;               ///< entries
    std::list<std::uint32_t> order_;                          ///< residents, first to go first
    std::list<std::uint32_t>::iterator farthest_;             ///< of this plan; or the end
    std::uint64_t plan_ = 1;
    std::size_t pinned_ = 0; ///< residents
    std::uint64_t lookups_ = 0, frames_ = 0;
    std::uint64_t recent_ = 0, next_recent_ = 0; ///< lookups after it are recent
    CacheCounters counters_;
};

} // namespace abut
