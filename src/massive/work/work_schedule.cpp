#include "massive/work/work_schedule.h"

#include <algorithm>

namespace abut {

namespace {

/// Estimates the cost of a unit, in bytes of models to read and build. A pair takes some
/// microseconds, as reading kBytesPerPair bytes does. An error is corrected when a worker that has
/// finished takes over half of another's run.
std::uint64_t work_of_unit(const WorkUnit& unit) {
    constexpr std::uint64_t kBytesPerPair = 1024;
    return unit.bytes + kBytesPerPair * unit.pairs.size();
}

} // namespace

WorkSchedule::WorkSchedule(const StoredParts& stored, const std::vector<WorkUnit>& units,
                           std::size_t workers, const RuleTable* rules)
    : stored_(stored), units_(units), rules_(rules), runs_(workers), work_before_(units.size() + 1),
      first_use_(stored.meshes.size() + 1) {
    for (std::size_t u = 0; u < units.size(); ++u) {
        work_before_[u + 1] = work_before_[u] + work_of_unit(units[u]);
        for (const std::uint32_t mesh : units[u].meshes)
            ++first_use_[mesh + 1];
    }
    for (std::size_t i = 1; i < first_use_.size(); ++i)
        first_use_[i] += first_use_[i - 1];
    uses_.resize(first_use_.back());
    std::vector<std::uint32_t> next(first_use_.begin(), first_use_.end() - 1);
    for (std::uint32_t u = 0; u < units.size(); ++u)
        for (const std::uint32_t mesh : units[u].meshes)
            uses_[next[mesh]++] = u;

    const std::uint64_t share = work_before_.back() / workers;
    for (std::size_t w = 0; w < workers; ++w)
        runs_[w] = {unit_after(w * share),
                    w + 1 < workers ? unit_after((w + 1) * share) : units.size()};
}

std::size_t WorkSchedule::unit_after(std::uint64_t work) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(work_before_, work) -
                                    work_before_.begin());
}

void WorkSchedule::take_over_half(Run& run) {
    Run& longest =
        *std::ranges::max_element(runs_, {}, [this](const Run& other) { return work_of(other); });
    if (longest.begin == longest.end)
        return;
    // At least one unit is taken over, even if it is the only one.
    const std::uint64_t half = work_before_[longest.begin] + work_of(longest) / 2;
    const std::size_t middle = std::min(unit_after(half), longest.end - 1);
    run = {middle, longest.end};
    longest.end = middle;
}

std::uint32_t WorkSchedule::next_use(std::uint32_t mesh, const Run& run) const {
    const auto begin = uses_.begin() + first_use_[mesh], end = uses_.begin() + first_use_[mesh + 1];
    const auto use = std::lower_bound(begin, end, static_cast<std::uint32_t>(run.begin));
    return use == end || *use >= run.end ? Task::kNoUse : *use;
}

std::optional<Task> WorkSchedule::next(std::size_t worker) {
    Run& run = runs_[worker];
    if (run.begin == run.end)
        take_over_half(run);
    if (run.begin == run.end)
        return std::nullopt;
    const std::size_t unit = run.begin++;
    Task task = make_task(stored_, units_, unit, rules_);
    for (std::size_t i = 0; i < task.meshes.size(); ++i)
        task.meshes[i].next_use = next_use(units_[unit].meshes[i], run);
    return task;
}

} // namespace abut
