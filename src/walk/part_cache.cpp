#include "walk/part_cache.h"

#include <abut/error.h>

#include "rigid/model/solid.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

/// Overhead of an entry without its stored chunk, and of a chunk without its model: map nodes,
/// reference counts.
constexpr std::uint64_t kEntryBytes = sizeof(Resident) + 128, kChunkBytes = 1536;

} // namespace

PartCache::PartCache(StoreFile& store, const PartTable& table, std::uint64_t memory)
    : store_(store), reader_(store, 0), table_(table), memory_(memory), farthest_(order_.end()) {}

PartCache::Pin PartCache::pin(Resident& resident) {
    pinned_ += resident.pins++ == 0 ? 1 : 0;
    resident.last_use = ++lookups_;
    return {*this, resident};
}

void PartCache::unpin(Resident& resident) {
    const std::scoped_lock lock(mutex_);
    pinned_ -= --resident.pins == 0 ? 1 : 0;
}

Resident* PartCache::find_resident(std::uint32_t entry) {
    const auto found = residents_.find(entry);
    return found != residents_.end() ? &found->second : nullptr;
}

bool PartCache::has(std::uint32_t entry) const {
    const std::scoped_lock lock(mutex_);
    return residents_.contains(entry);
}

PartCache::Pin PartCache::find(std::uint32_t entry) {
    const std::scoped_lock lock(mutex_);
    Resident* const resident = find_resident(entry);
    return resident != nullptr ? pin(*resident) : Pin();
}

PartCache::Pin PartCache::load(std::uint32_t entry) {
    Garbage garbage;
    Lock lock(mutex_);
    const std::uint32_t chunk = table_.chunk_of(entry);
    for (;;) {
        if (Resident* const resident = find_resident(entry))
            return pin(*resident);
        if (loading_.contains(chunk)) {
            changed_.wait(lock);
        } else if (make_room_for(chunk, Expendable::anything, garbage)) {
            break;
        } else {
            wait_for_a_load(lock);
        }
    }
    Resident& brought = bring(lock, entry, garbage);
    ++counters_.read_in_query;
    return pin(brought);
}

/// Waits until a read ends, since that returns its reserve. Throws if none is under way: then no
/// more room can become free.
void PartCache::wait_for_a_load(Lock& lock) {
    if (loading_.empty())
        throw Error(ErrorCode::bad_argument, store_.path(),
                    "the memory of the walk does not hold a part and the tables");
    changed_.wait(lock);
}

void PartCache::count_solid(const Pin& pin) {
    Garbage garbage;
    Lock lock(mutex_);
    LoadedChunk& chunk = *pin->chunk;
    if (chunk.counts_solid)
        return;
    const Mesh& mesh = std::get<Model>(chunk.shape).mesh();
    const std::uint64_t bytes = most_solid_bytes(mesh.triangles.size(), mesh.positions.size());
    while (!make_room(bytes, Expendable::anything, garbage))
        wait_for_a_load(lock);
    chunk.counts_solid = true;
    chunk.bytes += bytes;
    add_bytes(bytes);
}

void PartCache::begin_plan() {
    const std::scoped_lock lock(mutex_);
    ++plan_;
    farthest_ = order_.end();
}

bool PartCache::prefetch(std::uint32_t entry, Urgency urgency) {
    Garbage garbage;
    Lock lock(mutex_);
    if (urgency == Urgency::at_its_place && placements_.contains(entry))
        return true;
    const std::uint32_t chunk = table_.chunk_of(entry);
    for (;;) {
        if (Resident* const resident = find_resident(entry)) {
            urgency == Urgency::asked_for ? move_to_end(*resident) : reach(*resident);
            return true;
        }
        if (removed_.contains(entry))
            return true;
        if (!loading_.contains(chunk))
            break;
        changed_.wait(lock); // a query is reading it
    }
    const bool is_urgent = urgency == Urgency::asked_for;
    if (!make_room_for(chunk, is_urgent ? Expendable::anything : Expendable::beyond_plan, garbage))
        return false;
    Resident& resident = bring(lock, entry, garbage);
    if (removed_.contains(entry)) { // it was removed while it was read
        evict(residents_.find(entry), garbage);
        return true;
    }
    is_urgent ? move_to_end(resident) : reach(resident);
    ++counters_.read_ahead;
    return true;
}

void PartCache::begin_frame() {
    constexpr std::uint64_t kFramesOfStep = 16;
    const std::scoped_lock lock(mutex_);
    if (++frames_ % kFramesOfStep == 0)
        recent_ = std::exchange(next_recent_, lookups_);
}

void PartCache::place(std::uint32_t entry, const Transform& world_from_mesh) {
    const std::scoped_lock lock(mutex_);
    placements_[entry] = world_from_mesh;
    if (Resident* const resident = find_resident(entry))
        resident->world_from_mesh = world_from_mesh;
}

void PartCache::remove(std::uint32_t entry) {
    Garbage garbage;
    const std::scoped_lock lock(mutex_);
    placements_.erase(entry);
    removed_.insert(entry);
    if (const auto found = residents_.find(entry); found != residents_.end())
        evict(found, garbage);
}

void PartCache::set_table_bytes(std::uint64_t bytes) {
    Garbage garbage;
    Lock lock(mutex_);
    while (bytes > table_bytes_ && !make_room(bytes - table_bytes_, Expendable::anything, garbage))
        wait_for_a_load(lock);
    counters_.bytes -= table_bytes_;
    add_bytes(bytes);
    table_bytes_ = bytes;
}

CacheCounters PartCache::counters() const {
    const std::scoped_lock lock(mutex_);
    CacheCounters counters = counters_;
    counters.residents = residents_.size();
    return counters;
}

std::uint64_t PartCache::least_memory(std::uint64_t bytes) {
    return kEntryBytes + kChunkBytes + 3 * bytes; // twice to read it, once for its data as a solid
}
std::uint64_t PartCache::bytes_to_load(std::uint32_t chunk) const {
    if (chunks_.contains(chunk))
        return kEntryBytes;
    return kEntryBytes + kChunkBytes + std::uint64_t{2} * table_.chunk(chunk).bytes;
}

/// Reads an entry. The caller has made room. The lock is released while the store is read.
Resident& PartCache::bring(Lock& lock, std::uint32_t entry, Garbage& garbage) {
    const std::uint32_t chunk = table_.chunk_of(entry);
    const std::uint64_t reserved = bytes_to_load(chunk);
    add_bytes(reserved);
    loading_.insert(chunk);
    SharedChunk& shared = chunks_[chunk];
    ++shared.users; // keeps the chunk in the table
    std::shared_ptr<LoadedChunk> loaded = shared.chunk;
    const bool is_new = loaded == nullptr;
    const bool is_placed = placements_.contains(entry);
    Transform world_from_mesh;
    lock.unlock();
    try {
        if (!is_placed)
            world_from_mesh = store_.part(table_.row(entry)).world_from_mesh;
        if (is_new)
            loaded = read(table_.chunk(chunk));
    } catch (...) {
        lock.lock();
        counters_.bytes -= reserved;
        loading_.erase(chunk);
        release(chunk, garbage);
        changed_.notify_all();
        throw;
    }
    lock.lock();
    counters_.bytes -= reserved;
    loading_.erase(chunk);
    if (is_new)
        add_bytes(loaded->bytes);
    add_bytes(kEntryBytes);
    chunks_[chunk].chunk = loaded;
    if (const auto placed = placements_.find(entry); placed != placements_.end())
        world_from_mesh = placed->second;
    Resident& resident = residents_[entry];
    resident = {world_from_mesh, std::move(loaded), order_.insert(order_.end(), entry)};
    changed_.notify_all();
    return resident;
}

std::shared_ptr<LoadedChunk> PartCache::read(const StoredChunk& chunk) {
    std::shared_ptr<LoadedChunk> loaded;
    if (chunk.is_block) {
        ModelBlock block = reader_.read_block(chunk.number);
        loaded = std::make_shared<LoadedChunk>(std::move(block.model));
        loaded->is_block = true;
        loaded->triangle_ids = std::move(block.numbers);
    } else {
        loaded = std::make_shared<LoadedChunk>(reader_.read_mesh(chunk.number));
    }
    loaded->bytes = std::get<Model>(loaded->shape).bytes() +
                    loaded->triangle_ids.capacity() * sizeof(std::uint32_t) + kChunkBytes;
    return loaded;
}

/// Makes room to read a stored chunk.
bool PartCache::make_room_for(std::uint32_t chunk, Expendable expendable, Garbage& garbage) {
    for (;;) {
        const std::uint64_t bytes = bytes_to_load(chunk);
        if (!make_room(bytes, expendable, garbage))
            return false;
        if (bytes_to_load(chunk) == bytes)
            return true;
        // The chunk was in memory for another part and was evicted with it: more room is needed.
    }
}

/// Evicts entries until `bytes` are free. Returns false if there is not enough to evict.
bool PartCache::make_room(std::uint64_t bytes, Expendable expendable, Garbage& garbage) {
    // At most this many recently used entries are spared. If there are more, the memory is too
    // small to keep all of them.
    constexpr int kMostSpared = 64;
    int spared = 0;
    while (counters_.bytes + bytes > memory_) {
        if (order_.size() <= pinned_)
            return false;
        const auto first = residents_.find(order_.front());
        Resident& resident = first->second;
        if (expendable == Expendable::beyond_plan && resident.plan == plan_)
            return false;
        const bool is_recent = resident.last_use > recent_;
        const bool is_spared =
            is_recent && (expendable == Expendable::beyond_plan || spared++ < kMostSpared);
        if (resident.pins > 0 || is_spared) {
            move_to_end(resident);
            continue;
        }
        evict(first, garbage);
        ++counters_.evicted;
    }
    return true;
}

/// Marks an entry as reached by the plan. It becomes the farthest of those that the plan has
/// reached.
void PartCache::reach(Resident& resident) {
    if (resident.plan == plan_)
        return;
    order_.splice(farthest_, order_, resident.place);
    farthest_ = resident.place;
    resident.plan = plan_;
}

/// Treats an entry as the nearest of the plan.
void PartCache::move_to_end(Resident& resident) {
    take_out(resident);
    order_.splice(order_.end(), order_, resident.place);
    resident.plan = plan_;
}

/// Prepares an entry to leave its place in order_.
void PartCache::take_out(const Resident& resident) {
    if (farthest_ == resident.place)
        ++farthest_;
}

void PartCache::evict(std::unordered_map<std::uint32_t, Resident>::iterator at, Garbage& garbage) {
    const std::uint32_t chunk = table_.chunk_of(at->first);
    take_out(at->second);
    order_.erase(at->second.place);
    residents_.erase(at);
    counters_.bytes -= kEntryBytes;
    release(chunk, garbage);
}

void PartCache::release(std::uint32_t chunk, Garbage& garbage) {
    const auto shared = chunks_.find(chunk);
    if (--shared->second.users > 0)
        return;
    if (shared->second.chunk != nullptr) {
        counters_.bytes -= shared->second.chunk->bytes;
        garbage.push_back(std::move(shared->second.chunk));
    }
    chunks_.erase(shared);
}

void PartCache::add_bytes(std::uint64_t bytes) {
    counters_.bytes += bytes;
    counters_.peak_bytes = std::max(counters_.peak_bytes, counters_.bytes);
}

} // namespace abut
