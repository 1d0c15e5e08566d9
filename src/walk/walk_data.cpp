#include "walk/walk_data.h"

#include <abut/error.h>

#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"

#include <algorithm>
#include <string>

namespace abut {

namespace {

double median(double a, double b, double c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

} // namespace

WalkData::WalkData(const Store& store, const WalkOptions& options)
    : store_(store), options_(options), table_(store.file()), away_(table_.size()),
      next_entry_(table_.size()), cache_(store.file(), table_, options.memory) {
    require(options.look_ahead >= 0 && std::isfinite(options.look_ahead),
            "seconds to look ahead must not be negative, and finite");
    if (!has_room_for(0)) {
        const std::uint64_t least = table_bytes() + PartCache::least_memory(table_.largest_chunk());
        throw Error(ErrorCode::bad_argument, store.file().path(),
                    "a walk through it needs at least " + std::to_string((least >> 20) + 1) +
                        " MiB of memory: for the table of parts and the largest mesh");
    }
    cache_.set_table_bytes(table_bytes());
    if (options.prefetch)
        prefetcher_ = std::make_unique<Prefetcher>(cache_, table_);
}

std::uint64_t WalkData::table_bytes() const {
    constexpr std::uint64_t kNode = 64; // bytes of a map's node
    const std::uint64_t bytes = table_.bytes() + away_.size() / 8 + loose_.bytes() +
                                added_.size() * (sizeof(AddedPart) + kNode);
    return bytes + moved_.size() * (sizeof(MovedPart) + kNode) + loose_.size() * sizeof(Box3);
}

bool WalkData::has_room_for(std::uint64_t more) const {
    return table_bytes() + more + PartCache::least_memory(table_.largest_chunk()) <=
           options_.memory;
}

void WalkData::require_room_for_a_part(std::size_t entries) const {
    constexpr std::uint64_t kOfPart = 512, kOfEntry = 256; // at least what table_bytes() adds
    require(has_room_for(kOfPart + kOfEntry * entries),
            "the memory of the walk does not hold another part that was added or moved");
}

Vec3 WalkData::velocity_at(const Vec3& position) {
    const double seconds = since_move_.lap();
    std::rotate(velocities_.begin(), velocities_.begin() + 1, velocities_.end());
    velocities_.back() =
        position_ && seconds > 0 ? (1 / seconds) * (position - *position_) : Vec3{};
    // The median of three ticks ignores a single jump or a late tick.
    const auto& [a, b, c] = velocities_;
    return {median(a.x, b.x, c.x), median(a.y, b.y, c.y), median(a.z, b.z, c.z)};
}

void WalkData::move_to(const Vec3& position, const std::optional<Vec3>& velocity) {
    require_point(position, "position");
    if (velocity)
        require_point(*velocity, "velocity");
    const Vec3 moves = velocity_at(position);
    position_ = position;
    cache_.begin_frame();
    if (prefetcher_ == nullptr)
        return;
    const PredictedPath path(table_.narrow(position), velocity.value_or(moves),
                             options_.look_ahead);
    auto [moved, are_missing] = moved_near(path);
    prefetcher_->follow(path, std::move(moved), are_missing);
}

std::pair<std::vector<std::uint32_t>, bool> WalkData::moved_near(const PredictedPath& path) {
    constexpr std::size_t kMost = 64;
    std::vector<std::uint32_t> near;
    bool are_missing = false;
    if (moved_.empty())
        return {near, are_missing};
    NearestLanes lanes(loose_.tree(), path);
    while (near.size() < kMost) {
        const auto lane = lanes.next();
        if (!lane)
            break;
        const std::uint32_t entry = loose_.entry(lane->lane);
        if (is_added(entry))
            continue;
        near.push_back(entry);
        are_missing = are_missing || !cache_.has(entry);
    }
    return {near, are_missing};
}

void WalkData::wait() {
    if (prefetcher_ != nullptr)
        prefetcher_->wait();
}

WalkPart WalkData::add(const Model& model, const Transform& world_from_part) {
    require_finite(world_from_part, "transform of the part");
    require_room_for_a_part(1);
    const std::uint32_t entry = next_entry_++;
    const Box3 own_box = bounds_of(BodyShape(model));
    added_.emplace(entry, AddedPart{model, world_from_part, own_box});
    loose_.put(entry,
               is_empty(own_box) ? Aabb() : table_.narrow(placed_bounds(own_box, world_from_part)));
    cache_.set_table_bytes(table_bytes());
    return part_of(entry);
}

std::uint32_t WalkData::added_entry(WalkPart part) const {
    const std::int64_t serial = -1 - part.number;
    if (serial < std::int64_t{next_entry_} - table_.size()) {
        const auto entry = static_cast<std::uint32_t>(table_.size() + serial);
        if (added_.contains(entry))
            return entry;
    }
    throw Error(ErrorCode::bad_argument,
                "part " + std::to_string(part.number) + ": there is no such part");
}

std::span<const std::uint32_t> WalkData::stored_entries(WalkPart part) const {
    const std::span<const std::uint32_t> entries = table_.entries(part.number);
    const bool is_there =
        !entries.empty() && (!away_[entries.front()] || moved_.contains(part.number));
    if (!is_there)
        throw Error(ErrorCode::bad_argument,
                    "part " + std::to_string(part.number) + ": there is no such part");
    return entries;
}

void WalkData::move(WalkPart part, const Transform& world_from_part) {
    require_finite(world_from_part, "transform of the part");
    if (part.number >= 0) {
        move_stored(part, world_from_part);
        return;
    }
    const std::uint32_t entry = added_entry(part);
    AddedPart& added = added_.at(entry);
    added.world_from_part = world_from_part;
    if (!is_empty(added.own_box))
        loose_.put(entry, table_.narrow(placed_bounds(added.own_box, world_from_part)));
}

std::vector<Box3> WalkData::own_boxes(WalkPart part, std::span<const std::uint32_t> entries) const {
    StoreFile& store = store_.file();
    const MeshRow mesh = store.mesh(store.part(part.number).mesh);
    std::vector<BlockRow> blocks;
    if (mesh.blocks > 1)
        blocks = store.blocks(mesh);
    std::vector<Box3> boxes;
    for (const std::uint32_t entry : entries) {
        const StoredChunk& chunk = table_.chunk(table_.chunk_of(entry));
        boxes.push_back(mesh.box);
        for (const BlockRow& block : blocks)
            if (block.block == chunk.number)
                boxes.back() = block.box;
    }
    return boxes;
}

void WalkData::move_stored(WalkPart part, const Transform& world_from_part) {
    const std::span<const std::uint32_t> entries = stored_entries(part);
    if (!moved_.contains(part.number))
        require_room_for_a_part(entries.size());
    const bool is_new = !moved_.contains(part.number);
    if (is_new)
        moved_.emplace(part.number, MovedPart{{}, own_boxes(part, entries)});
    MovedPart& moved = moved_.at(part.number);
    moved.world_from_part = world_from_part;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Aabb box = table_.narrow(placed_bounds(moved.own_boxes[i], world_from_part));
        away_[entries[i]] = true;
        loose_.put(entries[i], box);
        cache_.place(entries[i], world_from_part);
    }
    if (is_new)
        cache_.set_table_bytes(table_bytes());
}

void WalkData::remove(WalkPart part) {
    if (part.number < 0) {
        const std::uint32_t entry = added_entry(part);
        added_.erase(entry);
        loose_.erase(entry);
        cache_.set_table_bytes(table_bytes());
        return;
    }
    for (const std::uint32_t entry : stored_entries(part)) {
        away_[entry] = true;
        loose_.erase(entry);
        cache_.remove(entry);
    }
    moved_.erase(part.number);
    cache_.set_table_bytes(table_bytes());
}

WalkPartName WalkData::name(WalkPart part) {
    if (part.number < 0) {
        static_cast<void>(added_entry(part)); // checks it
        return {};
    }
    static_cast<void>(stored_entries(part)); // checks it
    const PartRow row = store_.file().part(part.number);
    for (const ModelRow& model : store_.file().models())
        if (model.model == row.model)
            return {model.file, row.id, row.name, row.type};
    return {{}, row.id, row.name, row.type};
}

Transform WalkData::world_from_part(WalkPart part) {
    if (part.number < 0)
        return added_.at(added_entry(part)).world_from_part;
    static_cast<void>(stored_entries(part)); // checks it
    const auto moved = moved_.find(part.number);
    return moved != moved_.end() ? moved->second.world_from_part
                                 : store_.file().part(part.number).world_from_mesh;
}

Model WalkData::model(WalkPart part) {
    if (part.number < 0)
        return std::get<Model>(added_.at(added_entry(part)).shape);
    static_cast<void>(stored_entries(part)); // checks it
    return Model(store_.file().read_mesh(store_.file().part(part.number).mesh));
}

Probe WalkData::probe(WalkPart part) {
    if (part.number < 0)
        return Probe(model(part));
    const std::span<const std::uint32_t> entries = stored_entries(part);
    const bool is_whole =
        entries.size() == 1 && !table_.chunk(table_.chunk_of(entries[0])).is_block;
    if (!is_whole)
        return Probe(model(part));
    const PartCache::Pin pin = lookup(entries[0], MissingParts::wait);
    return Probe(std::get<Model>(pin->chunk->shape));
}

PartCache::Pin WalkData::lookup(std::uint32_t entry, MissingParts missing) {
    ++lookups_;
    if (PartCache::Pin pin = cache_.find(entry))
        return pin;
    ++misses_;
    if (missing == MissingParts::skip) {
        if (prefetcher_ != nullptr)
            prefetcher_->request(entry);
        return {};
    }
    const StopWatch watch;
    PartCache::Pin pin = cache_.load(entry);
    seconds_waited_ += watch.seconds();
    return pin;
}

WalkStatistics WalkData::statistics() const {
    const CacheCounters cache = cache_.counters();
    WalkStatistics result;
    result.lookups = lookups_, result.misses = misses_, result.seconds_waited = seconds_waited_;
    result.read_ahead = cache.read_ahead, result.read_in_query = cache.read_in_query;
    result.evicted = cache.evicted, result.parts_in_memory = cache.residents;
    result.table_bytes = table_bytes();
    result.bytes = cache.bytes, result.peak_bytes = cache.peak_bytes;
    return result;
}

} // namespace abut
