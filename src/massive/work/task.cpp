#include "massive/work/task.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// Returns the index of a value in a sorted list that contains it.
std::uint32_t place_of(const std::vector<std::uint32_t>& sorted, std::uint32_t value) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(sorted, value) - sorted.begin());
}

/// The sort key of a pair with a large mesh: pairs of one part and cell follow each other.
struct PlaceOfPair {
    std::uint32_t part = 0;
    std::uint64_t cell = 0;
    std::uint32_t pair = 0;
    friend bool operator<(const PlaceOfPair& a, const PlaceOfPair& b) {
        return std::tie(a.part, a.cell, a.pair) < std::tie(b.part, b.cell, b.pair);
    }
};

std::vector<std::uint32_t> large_pairs(const StoredParts& stored,
                                       const std::vector<IndexPair>& pairs) {
    const auto is_large = [&](std::uint32_t part) {
        return stored.find_large(stored.parts[part].mesh) != nullptr;
    };
    std::vector<PlaceOfPair> places;
    for (std::uint32_t k = 0; k < pairs.size(); ++k)
        if (is_large(pairs[k].a()) || is_large(pairs[k].b())) {
            const PairCell cell = stored.cell_of(pairs[k]);
            places.push_back({cell.part, cell.cell, k});
        }
    std::sort(places.begin(), places.end());
    std::vector<std::uint32_t> order;
    order.reserve(places.size());
    for (const PlaceOfPair& place : places)
        order.push_back(place.pair);
    return order;
}

/// The terms of a task's pairs, each once.
class TermsOfTask {
public:
    TermsOfTask(Task& task, const RuleTable& rules) : task_(task), rules_(rules) {}

    void set(const IndexPair& pair, Task::Pair& of_task) {
        PairTerms terms;
        if (const auto known = rules_.terms(pair.a(), pair.b()))
            terms = *known;
        of_task.touch = std::exchange(terms.touch, 0);
        of_task.rounding = std::exchange(terms.rounding, 0);
        const ClashRule* const rule = std::exchange(terms.rule, nullptr);
        const auto [at, is_new] = places_.try_emplace({rule, terms.neighbours}, places_.size());
        if (is_new)
            task_.terms.push_back(
                {terms, rule == nullptr ? "" : rule->name, rule == nullptr ? "" : rule->severity});
        of_task.terms = at->second;
    }

private:
    Task& task_;
    const RuleTable& rules_;
    /// Pairs of one rule have equal terms, but for their neighbours, touch tolerances and roundings.
    std::map<std::pair<const ClashRule*, std::optional<Neighbours>>, std::uint32_t> places_;
};

} // namespace

Task make_task(const StoredParts& stored, const std::vector<WorkUnit>& units, std::size_t unit,
               const RuleTable* rules) {
    const WorkUnit& work = units[unit];
    Task task;
    task.unit = static_cast<std::uint32_t>(unit);
    task.alone = work.alone;
    for (const std::uint32_t mesh : work.meshes)
        task.meshes.push_back({stored.meshes[mesh].mesh, stored.meshes[mesh].bytes, Task::kNoUse});
    std::vector<std::uint32_t> parts;
    parts.reserve(2 * work.pairs.size());
    for (const IndexPair& pair : work.pairs)
        parts.insert(parts.end(), {pair.a(), pair.b()});
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    const auto whole = static_cast<std::uint32_t>(work.meshes.size());
    for (const std::uint32_t part : parts) {
        const StoredPart& p = stored.parts[part];
        std::uint32_t mesh = 0;
        if (stored.find_large(p.mesh) == nullptr) {
            mesh = place_of(work.meshes, p.mesh);
        } else {
            const std::int64_t row = stored.meshes[p.mesh].mesh;
            const auto at = std::ranges::find(task.large, row);
            mesh = whole + static_cast<std::uint32_t>(at - task.large.begin());
            if (at == task.large.end())
                task.large.push_back(row);
        }
        task.parts.push_back({p.row, mesh, p.model});
    }
    for (const IndexPair& pair : work.pairs)
        task.pairs.push_back({place_of(parts, pair.a()), place_of(parts, pair.b()), 0, 0, 0, 0});
    if (rules != nullptr) {
        TermsOfTask terms(task, *rules);
        for (std::size_t k = 0; k < work.pairs.size(); ++k)
            terms.set(work.pairs[k], task.pairs[k]);
    }
    if (!task.large.empty())
        task.large_pairs = large_pairs(stored, work.pairs);
    return task;
}

} // namespace abut
