#pragma once

#include <abut/types.h>

#include "store/model_reader.h"
#include "walk/part_table.h"
#include "world/narrow_phase/body.h"

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

/// A stored chunk in memory. All parts that refer to it share it.
struct LoadedChunk {
    explicit LoadedChunk(Model model) : shape(std::move(model)) {}

    BodyShape shape; ///< a Model
    /// For a mesh block: the index in the whole mesh of each triangle. Empty for a whole mesh.
    std::vector<std::uint32_t> triangle_ids;
    bool is_block = false;
    std::uint64_t bytes = 0;
    bool counts_solid = false; ///< `bytes` includes the model's data as a solid
};

/// An entry in memory: its stored chunk and its transform.
struct Resident {
    Transform world_from_mesh;
    std::shared_ptr<LoadedChunk> chunk;
    std::list<std::uint32_t>::iterator place; ///< position in the order of eviction
    std::uint64_t last_use = 0;               ///< number of the last lookup that used it
    std::uint64_t plan = 0;                   ///< the last plan that reached it
    std::uint32_t pins = 0;
};

struct CacheCounters {
    std::uint64_t read_ahead = 0, read_in_query = 0, evicted = 0;
    std::uint64_t residents = 0;
    std::uint64_t bytes = 0, peak_bytes = 0; ///< including the tables
};

/// A cache of the entries of a table, in bounded memory. Entries that recent queries used stay. Of
/// the others, the one that is farthest from the predicted path is evicted first.
///
/// A plan is one pass over the entries near the predicted path, nearest first. A list keeps the
/// order of eviction, so that no distances need be stored:
///
///     [ reached by older plans | by the last one, far to near | by this one, far to near ]
///       evicted first
///
/// If the first one belongs to this plan, memory holds nothing that is farther than the next entry
/// of the plan.
///
/// Two threads use the cache: one queries (find, load and functions that change parts), one reads
/// ahead (begin_plan, prefetch). Neither holds the lock for long. While a stored chunk is read,
/// twice its size is reserved, because the bytes that the model is built from are in memory too.
class PartCache {
public:
    /// In          store, table: must outlive the cache; memory: bytes, tables included.
    PartCache(StoreFile& store, const PartTable& table, std::uint64_t memory);

    /// Keeps an entry in memory for its own lifetime.
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
    /// Pins an entry that is in memory. Returns an empty pin if it is not.
    Pin find(std::uint32_t entry);
    /// Pins an entry, and reads it first if it is not in memory.
    ///
    /// Errors      those of the store.
    Pin load(std::uint32_t entry);
    /// Makes room for the data that a model computes when it is first queried as a solid.
    void count_solid(const Pin& pin);

    /// Begins a new plan. Its entries are then prefetched, nearest first.
    void begin_plan();
    enum class Urgency : std::uint8_t {
        at_its_place, ///< planned at its place in the table; ignored if the part was moved
        planned,
        asked_for, ///< requested by a query
    };
    /// Reads an entry if it is not in memory. A planned entry may evict only entries that the plan
    /// has not reached; a requested one may evict any. Returns false if there is not enough to
    /// evict.
    ///
    /// Errors      those of the store.
    bool prefetch(std::uint32_t entry, Urgency urgency);
    /// Begins another tick of the walk.
    void begin_frame();

    /// Gives an entry another transform than the store has.
    void place(std::uint32_t entry, const Transform& world_from_mesh);
    /// Removes an entry. It is not read again.
    void remove(std::uint32_t entry);

    /// Sets how much of the memory the tables take, and makes room for them.
    void set_table_bytes(std::uint64_t bytes);
    /// Returns the memory that must remain beside the tables for a stored chunk whose model takes
    /// `bytes`.
    static std::uint64_t least_memory(std::uint64_t bytes);
    [[nodiscard]] CacheCounters counters() const;

private:
    struct SharedChunk {
        std::shared_ptr<LoadedChunk> chunk;
        std::uint32_t users = 0;
    };
    /// Which entries may be evicted.
    enum class Expendable : std::uint8_t { anything, beyond_plan };
    using Lock = std::unique_lock<std::mutex>;
    /// Evicted chunks, which are freed after the lock is released.
    using Garbage = std::vector<std::shared_ptr<LoadedChunk>>;

    Pin pin(Resident& resident);
    void unpin(Resident& resident);
    Resident* find_resident(std::uint32_t entry);
    [[nodiscard]] std::uint64_t bytes_to_load(std::uint32_t chunk) const;
    Resident& bring(Lock& lock, std::uint32_t entry, Garbage& garbage);
    std::shared_ptr<LoadedChunk> read(const StoredChunk& chunk);
    void wait_for_a_load(Lock& lock);
    bool make_room_for(std::uint32_t chunk, Expendable expendable, Garbage& garbage);
    bool make_room(std::uint64_t bytes, Expendable expendable, Garbage& garbage);
    void reach(Resident& resident);
    void move_to_end(Resident& resident);
    void take_out(const Resident& resident);
    void evict(std::unordered_map<std::uint32_t, Resident>::iterator at, Garbage& garbage);
    void release(std::uint32_t chunk, Garbage& garbage);
    void add_bytes(std::uint64_t bytes);

    StoreFile& store_;
    ModelReader reader_;
    const PartTable& table_;
    mutable std::mutex mutex_;
    std::condition_variable changed_; ///< a read has ended or failed
    std::uint64_t memory_, table_bytes_ = 0;
    std::unordered_map<std::uint32_t, Resident> residents_;   ///< by entry
    std::unordered_map<std::uint32_t, SharedChunk> chunks_;   ///< by chunk
    std::unordered_set<std::uint32_t> loading_;               ///< stored chunks that are being read
    std::unordered_map<std::uint32_t, Transform> placements_; ///< of moved entries
    std::unordered_set<std::uint32_t> removed_;               ///< removed entries
    std::list<std::uint32_t> order_;              ///< residents in the order of eviction
    std::list<std::uint32_t>::iterator farthest_; ///< the first of this plan, or the end
    std::uint64_t plan_ = 1;
    std::size_t pinned_ = 0; ///< number of pinned residents
    std::uint64_t lookups_ = 0, frames_ = 0;
    std::uint64_t recent_ = 0, next_recent_ = 0; ///< lookups after recent_ are recent
    CacheCounters counters_;
};

} // namespace abut
