#include <abut/walk.h>

#include "core/arguments.h"
#include "walk/moving_probe.h"
#include "walk/near_entry.h"
#include "walk/walk_data.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace abut {

namespace {

/// Visits the entries in the way of a probe, in the order of their boxes.
class WaySearch {
public:
    WaySearch(WalkData& walk, const MovingProbe& probe, const WalkQuery& query, WalkAnswer& answer)
        : walk_(walk), probe_(probe), query_(query),
          visit_entry_(walk, query, probe.placed().asks_for_solids(), answer) {
        require_not_negative(query.absolute_error.value_or(0), "absolute error");
    }

    /// Calls take(impact) for the contact with each entry that is met. take returns the time up to
    /// which further contacts matter.
    template <typename Take>
    void visit(const Take& take) {
        const std::vector<BoxMotion> boxes = probe_.boxes(walk_.table());
        double until = 1;
        walk_.for_each_met(boxes, until, [&](std::uint32_t entry, float key) {
            until = visit_entry_(
                entry, until,
                [&](const NearEntry& near) { return measure(near, key, until, take); },
                [&] { least_skipped_ = std::min(least_skipped_, double{key}); });
            return until;
        });
    }

    /// A lower bound of the time at which a skipped part is met.
    [[nodiscard]] double least_skipped() const { return least_skipped_; }

private:
    template <typename Take>
    double measure(const NearEntry& entry, float key, double until, const Take& take) const {
        bool meets = false;
        PartImpact impact = probe_.contact(entry, until, key <= 0, query_, meets);
        if (!meets)
            return until;
        // The bound is used only to reject, so that the last bits of the time do not depend on the
        // parts visited before.
        if (until < 1)
            impact = probe_.contact(entry, 1, key <= 0, query_, meets);
        return meets ? take(impact) : until;
    }

    WalkData& walk_;
    const MovingProbe& probe_;
    const WalkQuery& query_;
    EntryVisit visit_entry_;
    double least_skipped_ = HUGE_VAL;
};

bool is_earlier(const PartImpact& a, const PartImpact& b) {
    return std::tuple(a.time, a.part.number, a.triangle_part) <
           std::tuple(b.time, b.part.number, b.triangle_part);
}

FirstContact first_contact(WalkData& walk, const MovingProbe& probe, const WalkQuery& query) {
    FirstContact answer;
    WaySearch search(walk, probe, query, answer);
    search.visit([&](const PartImpact& impact) {
        if (!answer.meet || is_earlier(impact, answer.impact)) {
            answer.meet = true;
            answer.impact = impact;
        }
        return answer.impact.time;
    });
    const double first = answer.meet ? answer.impact.time : 1;
    // The answer is complete if all skipped parts are met later, if at all.
    answer.complete = search.least_skipped() > first;
    answer.time_free = std::min(first, search.least_skipped());
    return answer;
}

} // namespace

FirstContact Walk::sweep(const Probe& probe, const Transform& world_from_probe,
                         const Vec3& translation, const WalkQuery& query) {
    const StopScope stopping(query.progress);
    return first_contact(*data_, MovingProbe(probe, world_from_probe, translation), query);
}

FirstContact Walk::time_of_impact(const Probe& probe, const Motion& motion,
                                  const WalkQuery& query) {
    const StopScope stopping(query.progress);
    return first_contact(*data_, MovingProbe(probe, motion), query);
}

PartsInWay Walk::parts_in_way(const Probe& probe, const Motion& motion, const WalkQuery& query) {
    const StopScope stopping(query.progress);
    const MovingProbe moving(probe, motion);
    PartsInWay answer;
    std::map<WalkPart, PartImpact> first; // a cut part has several entries
    WaySearch search(*data_, moving, query, answer);
    search.visit([&](const PartImpact& impact) {
        const auto [at, is_new] = first.try_emplace(impact.part, impact);
        if (!is_new && is_earlier(impact, at->second))
            at->second = impact;
        return 1.0;
    });
    for (const auto& [part, impact] : first)
        answer.parts.push_back(impact);
    std::sort(answer.parts.begin(), answer.parts.end(), is_earlier);
    answer.complete = search.least_skipped() > 1;
    answer.time_free =
        std::min(answer.parts.empty() ? 1.0 : answer.parts.front().time, search.least_skipped());
    return answer;
}

} // namespace abut
