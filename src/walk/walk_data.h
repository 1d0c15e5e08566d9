#pragma once

#include <abut/walk.h>

#include "core/stop_watch.h"
#include "store/database/store_file.h"
#include "walk/box_motion.h"
#include "walk/loose_boxes.h"
#include "walk/part_cache.h"
#include "walk/part_table.h"
#include "walk/prefetcher.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut {

/// A part that was added to the walk. Its entry number follows those of the table.
struct AddedPart {
    BodyShape shape; ///< a Model
    Transform world_from_part;
    Box3 own_box;
};

/// A part of the store that was moved within the walk.
struct MovedPart {
    Transform world_from_part;
    std::vector<Box3> own_boxes; ///< of its entries, in the part's frame
};

/// The parts of a walk. Parts at their place in the store are in a tree that never changes. Parts
/// that were added or moved are loose, in a tree of their own.
class WalkData {
public:
    WalkData(const Store& store, const WalkOptions& options);

    void move_to(const Vec3& position, const std::optional<Vec3>& velocity);
    void wait();
    WalkPart add(const Model& model, const Transform& world_from_part);
    void move(WalkPart part, const Transform& world_from_part);
    void remove(WalkPart part);
    WalkPartName name(WalkPart part);
    Transform world_from_part(WalkPart part);
    Model model(WalkPart part);
    /// The part's model, in memory if it is there.
    Probe probe(WalkPart part);
    [[nodiscard]] WalkStatistics statistics() const;

    /// Calls visit(entry, key) for the entries whose boxes may be at most `reach` from a box in the
    /// world frame, nearest first. The key is a lower bound of the squared distance. visit returns
    /// the reach from then on.
    template <typename Visit>
    void for_each_near(const Box3& box, double reach, const Visit& visit);
    /// Calls visit(entry, key) for the entries whose boxes some moving boxes may meet up to the time
    /// `until`, first met first. The boxes are relative to the table (PartTable::narrow). The key is
    /// a lower bound of the time. visit returns the new `until`.
    template <typename Visit>
    void for_each_met(std::span<const BoxMotion> moving, double until, const Visit& visit);
    [[nodiscard]] const PartTable& table() const { return table_; }
    /// The reach that ends the traversal.
    static constexpr double kEnough = -HUGE_VAL;

    [[nodiscard]] bool is_added(std::uint32_t entry) const { return entry >= table_.size(); }
    [[nodiscard]] const AddedPart& added(std::uint32_t entry) const { return added_.at(entry); }
    [[nodiscard]] WalkPart part_of(std::uint32_t entry) const {
        return {is_added(entry) ? std::int64_t{table_.size()} - 1 - std::int64_t{entry}
                                : table_.row(entry)};
    }
    /// Pins an entry of the store. If it is not in memory, it is read; with MissingParts::skip it
    /// is requested instead, and the pin is empty.
    PartCache::Pin lookup(std::uint32_t entry, MissingParts missing);
    [[nodiscard]] std::uint64_t misses() const { return misses_; }
    [[nodiscard]] PartCache& cache() { return cache_; }

private:
    /// Visits the entries of both trees by ascending key. visit returns the largest key that
    /// matters from then on.
    template <typename Metric, typename Visit>
    void for_each_lane(const Metric& metric, float limit, const Visit& visit);
    /// Errors      of this and the next function: Error{bad_argument} if there is no such part.
    [[nodiscard]] std::uint32_t added_entry(WalkPart part) const;
    [[nodiscard]] std::span<const std::uint32_t> stored_entries(WalkPart part) const;
    /// Returns the boxes of the entries of a part of the store, in the part's frame.
    [[nodiscard]] std::vector<Box3> own_boxes(WalkPart part,
                                              std::span<const std::uint32_t> entries) const;
    void move_stored(WalkPart part, const Transform& world_from_part);
    Vec3 velocity_at(const Vec3& position);
    /// Returns the moved entries that are nearest to the path, and whether one of them is not in
    /// memory.
    std::pair<std::vector<std::uint32_t>, bool> moved_near(const PredictedPath& path);
    [[nodiscard]] std::uint64_t table_bytes() const;
    /// Whether the memory can hold the tables, `more` bytes and the largest stored chunk.
    [[nodiscard]] bool has_room_for(std::uint64_t more) const;
    void require_room_for_a_part(std::size_t entries) const;

    Store store_;
    WalkOptions options_;
    PartTable table_;
    std::vector<bool> away_; ///< entries of the table that were moved or removed
    LooseBoxes loose_;
    std::unordered_map<std::uint32_t, AddedPart> added_;
    std::unordered_map<std::int64_t, MovedPart> moved_; ///< by row
    std::uint32_t next_entry_;                          ///< entry of the next part that is added
    std::optional<Vec3> position_;
    StopWatch since_move_;
    std::array<Vec3, 3> velocities_{}; ///< of the last three ticks
    std::uint64_t lookups_ = 0, misses_ = 0;
    double seconds_waited_ = 0;
    PartCache cache_;
    std::unique_ptr<Prefetcher> prefetcher_; ///< null without prefetching
};

template <typename Metric, typename Visit>
void WalkData::for_each_lane(const Metric& metric, float limit, const Visit& visit) {
    NearestLanes stored(table_.tree(), metric), loose(loose_.tree(), metric);
    const auto set_limit = [&](float to) {
        limit = to;
        stored.set_limit(to), loose.set_limit(to);
    };
    set_limit(limit);
    auto next_stored = stored.next(), next_loose = loose.next();
    while (next_stored || next_loose) {
        const bool from_table = next_stored && (!next_loose || next_stored->key <= next_loose->key);
        const auto lane = from_table ? *next_stored : *next_loose;
        if (lane.key > limit)
            return;
        if (!from_table || !away_[lane.lane])
            set_limit(visit(from_table ? lane.lane : loose_.entry(lane.lane), lane.key));
        (from_table ? next_stored : next_loose) = (from_table ? stored : loose).next();
    }
}

template <typename Visit>
void WalkData::for_each_near(const Box3& box, double reach, const Visit& visit) {
    const auto limit_of = [](double to) {
        constexpr double kLargest = 1e18; // of a coordinate
        if (to == kEnough)
            return -HUGE_VALF;
        return to < kLargest ? round_up(std::max(to, 0.0) * std::max(to, 0.0)) : HUGE_VALF;
    };
    for_each_lane(GapToBox{table_.narrow(box)}, limit_of(reach),
                  [&](std::uint32_t entry, float key) { return limit_of(visit(entry, key)); });
}

template <typename Visit>
void WalkData::for_each_met(std::span<const BoxMotion> moving, double until, const Visit& visit) {
    for_each_lane(EntryTimes{moving}, round_up(until),
                  [&](std::uint32_t entry, float key) { return round_up(visit(entry, key)); });
}

} // namespace abut
