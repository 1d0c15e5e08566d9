#include <abut/walk.h>

#include "rigid/shapes/shape_arguments.h"
#include "walk/near_entry.h"
#include "walk/probe.h"
#include "walk/walk_data.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace abut {

namespace {

/// The traversal of one query. It visits the entries in reach, nearest boxes first.
class Reach {
public:
    Reach(WalkData& walk, const PlacedProbe& probe, const WalkQuery& query, Depths depths,
          WalkAnswer& answer)
        : walk_(walk), probe_(probe), answer_(answer),
          visit_entry_(walk, query, depths == Depths::yes || probe.asks_for_solids(), answer) {}

    /// Calls visit(entry) for each entry in reach. visit returns the reach from then on.
    template <typename Visit>
    void visit(double reach, const Visit& visit) {
        if (is_empty(probe_.box()))
            return;
        walk_.for_each_near(probe_.box(), reach, [&](std::uint32_t entry, float key) {
            reach = visit_entry_(entry, reach, visit, [&] { skip(key); });
            return skipped_ < kMostSkipped ? reach : WalkData::kEnough;
        });
    }

    /// Lower bound of the distances of all skipped parts.
    [[nodiscard]] double least_skipped() const { return least_skipped_; }

private:
    /// A query that has skipped this many entries ends: in a region that is not in memory it would
    /// otherwise visit every part of the store, and ask for each.
    static constexpr std::uint32_t kMostSkipped = 1024;

    void skip(float key) {
        ++skipped_;
        answer_.complete = false;
        const double gap = std::sqrt(double{key});
        least_skipped_ = std::min(least_skipped_, gap > 0 ? gap : -probe_.radius());
    }

    WalkData& walk_;
    const PlacedProbe& probe_;
    WalkAnswer& answer_;
    EntryVisit visit_entry_;
    double least_skipped_ = HUGE_VAL;
    std::uint32_t skipped_ = 0;
};

BodyGap measure(const NearEntry& entry, const PlacedProbe& probe, double upper_bound,
                Depths depths) {
    PairWarmStart warm_start;
    return gap_between(entry.body(), probe.body(), upper_bound, depths, warm_start);
}

WalkGap gap_to(const NearEntry& entry, const PlacedProbe& probe, Depths depths) {
    const BodyGap gap = measure(entry, probe, HUGE_VAL, depths);
    WalkGap result;
    result.part = entry.part;
    result.distance = gap.distance;
    result.point_part = gap.point_a, result.point_probe = gap.point_b;
    result.normal = gap.normal;
    result.triangle_part = entry.triangle(gap.triangle_a);
    result.triangle_probe = gap.triangle_b;
    result.status = gap.status;
    return result;
}

/// The depth of two models in a limited number of steps, which are used up.
WalkGap depth_within(const NearEntry& entry, const PlacedProbe& probe, std::uint64_t& steps) {
    const PlacedBody part = entry.body(), held = probe.body();
    const auto* a = std::get_if<Model>(&part.shape);
    const auto* b = std::get_if<Model>(&held.shape);
    if (a == nullptr || b == nullptr)
        return gap_to(entry, probe, Depths::yes);
    DistanceOptions options;
    options.signed_distance = true;
    options.max_steps = steps;
    const Gap gap = distance(*a, part.world_from_body, *b, held.world_from_body, options);
    steps -= std::min(gap.steps, steps);
    WalkGap result;
    result.part = entry.part;
    result.status = gap.status;
    // The models touch, so what the steps did not suffice for is a distance of 0.
    if (gap.distance < 0) {
        result.distance = gap.distance;
        result.status = Status::bound_only; // the depth of a point, not that of the bodies
        result.point_part = gap.point_a, result.point_probe = gap.point_b;
        result.normal = normalized_or_zero(gap.point_a - gap.point_b);
        result.triangle_part = entry.triangle(gap.triangle_a);
        result.triangle_probe = gap.triangle_b;
    } else {
        result.distance = 0;
        result.point_part = result.point_probe = gap.point_a;
    }
    return result;
}

/// Returns the gap of an entry, or none if it is proven to exceed the bound. The bound is used only
/// to reject. With a bound, the last bits of a gap could depend on which of several equally near
/// pairs of triangles is found. The reported gap is therefore measured without one, and does not
/// depend on the parts visited before.
std::optional<WalkGap> gap_up_to(const NearEntry& entry, const PlacedProbe& probe, double bound) {
    if (bound < HUGE_VAL) {
        const double above = bound + std::max(0x1p-40 * std::abs(bound), 0x1p-1000);
        if (measure(entry, probe, above, Depths::no).distance >= above)
            return std::nullopt;
    }
    return gap_to(entry, probe, Depths::no);
}

bool touches(const NearEntry& entry, const PlacedProbe& probe) {
    PairWarmStart warm_start;
    return touch(entry.body(), probe.body(), warm_start);
}

/// Keeps only the nearest entry of each part. Sorts by part.
void keep_one_a_part(std::vector<WalkGap>& gaps) {
    std::sort(gaps.begin(), gaps.end(), [](const WalkGap& a, const WalkGap& b) {
        return a.part != b.part ? a.part < b.part
                                : std::pair(a.distance, a.triangle_part) <
                                      std::pair(b.distance, b.triangle_part);
    });
    gaps.erase(std::unique(gaps.begin(), gaps.end(),
                           [](const WalkGap& a, const WalkGap& b) { return a.part == b.part; }),
               gaps.end());
}

} // namespace

Walk::Walk(const Store& store, const WalkOptions& options)
    : data_(std::make_unique<WalkData>(store, options)) {}
Walk::~Walk() = default;
Walk::Walk(Walk&&) noexcept = default;
Walk& Walk::operator=(Walk&&) noexcept = default;

void Walk::move_to(const Vec3& position) {
    data_->move_to(position, std::nullopt);
}
void Walk::move_to(const Vec3& position, const Vec3& velocity) {
    data_->move_to(position, velocity);
}
void Walk::wait() {
    data_->wait();
}

NearestPart Walk::distance(const Probe& probe, const Transform& world_from_probe,
                           const WalkQuery& query) {
    require_bound(query.upper_bound);
    const StopScope stopping(query.progress);
    const PlacedProbe placed(probe, world_from_probe);
    NearestPart answer;
    double reach = query.upper_bound;
    Reach search(*data_, placed, query, Depths::no, answer);
    search.visit(reach, [&](const NearEntry& entry) {
        const auto gap = gap_up_to(entry, placed, reach);
        const bool is_nearer =
            gap && (gap->distance < reach ||
                    (answer.found && gap->distance == reach && gap->part < answer.gap.part));
        if (is_nearer) {
            answer.found = true;
            answer.gap = *gap;
            reach = gap->distance;
        }
        return reach;
    });
    answer.at_least = std::min(reach, search.least_skipped());
    // The answer is complete if all skipped parts are farther than the nearest one.
    answer.complete = answer.complete || search.least_skipped() > reach;
    return answer;
}

NearParts Walk::within(const Probe& probe, const Transform& world_from_probe, double tolerance,
                       const WalkQuery& query) {
    require(tolerance >= 0 && tolerance < HUGE_VAL, "tolerance must be a length, not negative");
    const StopScope stopping(query.progress);
    const PlacedProbe placed(probe, world_from_probe);
    NearParts answer;
    Reach(*data_, placed, query, Depths::no, answer).visit(tolerance, [&](const NearEntry& entry) {
        const auto gap = gap_up_to(entry, placed, tolerance);
        if (gap && gap->distance <= tolerance)
            answer.parts.push_back(*gap);
        return tolerance;
    });
    keep_one_a_part(answer.parts);
    return answer;
}

TouchedParts Walk::collide(const Probe& probe, const Transform& world_from_probe,
                           const WalkQuery& query) {
    const StopScope stopping(query.progress);
    const PlacedProbe placed(probe, world_from_probe);
    TouchedParts answer;
    Reach(*data_, placed, query, Depths::no, answer).visit(0, [&](const NearEntry& entry) {
        if (touches(entry, placed))
            answer.parts.push_back(entry.part);
        const bool enough = query.mode == ContactMode::first && !answer.parts.empty();
        return enough ? WalkData::kEnough : 0;
    });
    std::sort(answer.parts.begin(), answer.parts.end());
    answer.parts.erase(std::unique(answer.parts.begin(), answer.parts.end()), answer.parts.end());
    return answer;
}

NearParts Walk::penetration(const Probe& probe, const Transform& world_from_probe,
                            const WalkQuery& query) {
    const StopScope stopping(query.progress);
    const PlacedProbe placed(probe, world_from_probe);
    NearParts answer;
    std::uint64_t steps = query.max_steps.value_or(0);
    Reach(*data_, placed, query, Depths::yes, answer).visit(0, [&](const NearEntry& entry) {
        if (!touches(entry, placed))
            return 0.0;
        const bool is_open = entry.chunk != nullptr && entry.chunk->is_block;
        answer.parts.push_back(query.max_steps && !is_open
                                   ? depth_within(entry, placed, steps)
                                   : gap_to(entry, placed, is_open ? Depths::no : Depths::yes));
        if (is_open)
            answer.parts.back().status = Status::bound_only;
        return 0.0;
    });
    keep_one_a_part(answer.parts);
    return answer;
}

NearestPart Walk::distance(WalkPart part, WalkQuery query) {
    query.except = part;
    return distance(data_->probe(part), data_->world_from_part(part), query);
}
NearParts Walk::within(WalkPart part, double tolerance, WalkQuery query) {
    query.except = part;
    return within(data_->probe(part), data_->world_from_part(part), tolerance, query);
}
TouchedParts Walk::collide(WalkPart part, WalkQuery query) {
    query.except = part;
    return collide(data_->probe(part), data_->world_from_part(part), query);
}
NearParts Walk::penetration(WalkPart part, WalkQuery query) {
    query.except = part;
    return penetration(data_->probe(part), data_->world_from_part(part), query);
}

WalkPart Walk::add(const Model& model, const Transform& world_from_part) {
    return data_->add(model, world_from_part);
}
void Walk::move(WalkPart part, const Transform& world_from_part) {
    data_->move(part, world_from_part);
}
void Walk::remove(WalkPart part) {
    data_->remove(part);
}
WalkPartName Walk::name(WalkPart part) {
    return data_->name(part);
}
Transform Walk::world_from_part(WalkPart part) {
    return data_->world_from_part(part);
}
Model Walk::model(WalkPart part) {
    return data_->model(part);
}
WalkStatistics Walk::statistics() const {
    return data_->statistics();
}

} // namespace abut
