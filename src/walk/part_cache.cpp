#include "walk/part_cache.h"

#include <abut/error.h>

#include "rigid/solid.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

/// What an entry takes besides its piece, and a piece besides its model: nodes of tables, counts.
constexpr std::uint64_t kEntryBytes = sizeof(Resident) + 96, kPieceBytes = 1024;
/// Farther than anything: whatever is in memory may go.
constexpr float kAnything = -1;

} // namespace

PartCache::PartCache(StoreFile& store, const PartTable& table, std::uint64_t memory)
    : store_(store), table_(table), memory_(memory) {}

PartCache::Pin PartCache::pin(Resident& resident) {
    ++resident.pins;
    resident.last_use = ++queries_;
    return {*this, resident};
}

void PartCache::unpin(Resident& resident) {
    const std::scoped_lock lock(mutex_);
    --resident.pins;
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
    const std::uint32_t piece = table_.piece_of(entry);
    for (;;) {
        if (Resident* const resident = find_resident(entry))
            return pin(*resident);
        if (loading_.contains(piece)) {
            changed_.wait(lock);
        } else if (make_room(bytes_to_load(piece), kAnything, garbage)) {
            break;
        } else {
            wait_for_a_load(lock);
        }
    }
    Resident& brought = bring(lock, entry, garbage);
    ++counters_.read_in_query;
    return pin(brought);
}

/// Room for whoever waits can only come from a piece that is being read: then its reserve is given back.
void PartCache::wait_for_a_load(Lock& lock) {
    if (loading_.empty())
        throw Error(ErrorCode::bad_argument, store_.path(),
                    "the memory of the walk does not hold a part and the tables");
    changed_.wait(lock);
}

void PartCache::count_solid(const Pin& pin) {
    Garbage garbage;
    Lock lock(mutex_);
    LoadedPiece& piece = *pin->piece;
    if (piece.counts_solid)
        return;
    const Mesh& mesh = std::get<Model>(piece.shape).mesh();
    const std::uint64_t bytes = most_solid_bytes(mesh.triangles.size(), mesh.positions.size());
    while (!make_room(bytes, kAnything, garbage))
        wait_for_a_load(lock);
    piece.counts_solid = true;
    piece.bytes += bytes;
    add_bytes(bytes);
}

PartCache::Outcome PartCache::prefetch(std::uint32_t entry, float key) {
    // So much nearer, or the same two take turns.
    constexpr float kNearer = 1.0625F;
    Garbage garbage;
    Lock lock(mutex_);
    const std::uint32_t piece = table_.piece_of(entry);
    if (removed_.contains(entry))
        return Outcome::gone;
    if (const auto placed = placements_.find(entry); placed != placements_.end())
        key = path_.key(placed->second.box);
    while (!residents_.contains(entry)) {
        if (!loading_.contains(piece)) {
            if (!make_room(bytes_to_load(piece), kNearer * key, garbage))
                return Outcome::no_room;
            bring(lock, entry, garbage);
            ++counters_.read_ahead;
            return Outcome::loaded;
        }
        changed_.wait(lock); // a query reads it
    }
    return Outcome::present;
}

void PartCache::set_path(const PredictedPath& path) {
    const std::scoped_lock lock(mutex_);
    path_ = path;
    victims_.clear();
}

void PartCache::begin_frame() {
    constexpr std::uint64_t kFramesOfStep = 16;
    const std::scoped_lock lock(mutex_);
    if (++frames_ % kFramesOfStep == 0)
        recent_ = std::exchange(next_recent_, queries_);
}

void PartCache::place(std::uint32_t entry, const Transform& world_from_mesh, const Aabb& box) {
    const std::scoped_lock lock(mutex_);
    placements_[entry] = {world_from_mesh, box};
    if (Resident* const resident = find_resident(entry)) {
        resident->world_from_mesh = world_from_mesh;
        resident->box = box;
    }
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
    const std::scoped_lock lock(mutex_);
    if (bytes > table_bytes_)
        make_room(bytes - table_bytes_, kAnything, garbage);
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
    return kEntryBytes + kPieceBytes + 3 * bytes; // with what it learns of itself as a solid
}
std::uint64_t PartCache::bytes_to_load(std::uint32_t piece) const {
    if (pieces_.contains(piece))
        return kEntryBytes;
    return kEntryBytes + kPieceBytes + std::uint64_t{2} * table_.piece(piece).bytes;
}

/// In: there is room. The lock is left while the store is read.
Resident& PartCache::bring(Lock& lock, std::uint32_t entry, Garbage& garbage) {
    const std::uint32_t piece = table_.piece_of(entry);
    const std::uint64_t reserved = bytes_to_load(piece);
    add_bytes(reserved);
    loading_.insert(piece);
    SharedPiece& shared = pieces_[piece];
    ++shared.users; // so it stays
    std::shared_ptr<LoadedPiece> loaded = shared.piece;
    const bool is_new = loaded == nullptr;
    const bool is_placed = placements_.contains(entry);
    Transform world_from_mesh;
    lock.unlock();
    try {
        if (!is_placed)
            world_from_mesh = store_.part(table_.row(entry)).world_from_mesh;
        if (is_new)
            loaded = read(table_.piece(piece));
    } catch (...) {
        lock.lock();
        counters_.bytes -= reserved;
        loading_.erase(piece);
        release(piece, garbage);
        changed_.notify_all();
        throw;
    }
    lock.lock();
    counters_.bytes -= reserved;
    loading_.erase(piece);
    if (is_new)
        add_bytes(loaded->bytes);
    add_bytes(kEntryBytes);
    pieces_[piece].piece = loaded;
    Resident& resident = residents_[entry];
    resident = {world_from_mesh, table_.tree().box(entry), std::move(loaded)};
    if (const auto placed = placements_.find(entry); placed != placements_.end()) {
        resident.world_from_mesh = placed->second.world_from_mesh;
        resident.box = placed->second.box;
    }
    changed_.notify_all();
    return resident;
}

std::shared_ptr<LoadedPiece> PartCache::read(const StoredPiece& piece) {
    std::shared_ptr<LoadedPiece> loaded;
    if (piece.is_block) {
        MeshBlock block = store_.read_block(piece.number);
        loaded = std::make_shared<LoadedPiece>(std::move(block.mesh));
        loaded->is_block = true;
        loaded->triangle_ids = std::move(block.triangle_ids);
    } else {
        loaded = std::make_shared<LoadedPiece>(store_.read_mesh(piece.number));
    }
    loaded->bytes = std::get<Model>(loaded->shape).bytes() +
                    loaded->triangle_ids.capacity() * sizeof(std::uint32_t) + kPieceBytes;
    return loaded;
}

/// Evicts, of what lies farther than so far, the farthest. False if that is not enough.
bool PartCache::make_room(std::uint64_t bytes, float farther_than, Garbage& garbage) {
    while (counters_.bytes + bytes > memory_) {
        if (victims_.empty() && !gather_victims())
            return false;
        const Victim victim = victims_.back();
        if (!(victim.key > farther_than))
            return false;
        victims_.pop_back();
        const auto found = residents_.find(victim.entry);
        if (found == residents_.end() || found->second.pins > 0 ||
            found->second.last_use != victim.last_use)
            continue;
        evict(found, garbage);
        ++counters_.evicted;
    }
    return true;
}

bool PartCache::gather_victims() {
    for (const auto& [entry, resident] : residents_)
        if (resident.pins == 0) {
            const bool is_recent = resident.last_use > recent_;
            victims_.push_back({is_recent ? 0 : path_.key(resident.box), entry, resident.last_use});
        }
    const auto goes_later = [](const Victim& a, const Victim& b) {
        if (a.key != b.key)
            return a.key < b.key;
        return a.last_use != b.last_use ? a.last_use > b.last_use : a.entry < b.entry;
    };
    // Some at once: to go through all for each would take too long.
    const std::size_t wanted = std::min(victims_.size(), victims_.size() / 16 + 64);
    const auto first = victims_.end() - static_cast<std::ptrdiff_t>(wanted);
    std::nth_element(victims_.begin(), first, victims_.end(), goes_later);
    victims_.erase(victims_.begin(), first);
    std::sort(victims_.begin(), victims_.end(), goes_later);
    return !victims_.empty();
}

void PartCache::evict(std::unordered_map<std::uint32_t, Resident>::iterator at, Garbage& garbage) {
    const std::uint32_t piece = table_.piece_of(at->first);
    residents_.erase(at);
    counters_.bytes -= kEntryBytes;
    release(piece, garbage);
}

void PartCache::release(std::uint32_t piece, Garbage& garbage) {
    const auto shared = pieces_.find(piece);
    if (--shared->second.users > 0)
        return;
    if (shared->second.piece != nullptr) {
        counters_.bytes -= shared->second.piece->bytes;
        garbage.push_back(std::move(shared->second.piece));
    }
    pieces_.erase(shared);
}

void PartCache::add_bytes(std::uint64_t bytes) {
    counters_.bytes += bytes;
    counters_.peak_bytes = std::max(counters_.peak_bytes, counters_.bytes);
}

} // namespace abut
