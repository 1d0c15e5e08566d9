#include "massive/work_schedule.h"

#include <algorithm>

namespace abut {

namespace {

/// About what it costs: models are read and built at some bytes a nanosecond, a pair takes some
/// microseconds. Runs that are cut wrong are cut again.
std::uint64_t work_of_unit(const WorkUnit& unit) {
    constexpr std::uint64_t kBytesPerPair = 1024;
    return unit.bytes + kBytesPerPair * unit.pairs.size();
}

} // namespace

WorkSchedule::WorkSchedule(const std::vector<WorkUnit>& units, std::size_t meshes,
                           std::size_t workers)
    : runs_(workers), done_by_(units.size() + 1), first_use_(meshes + 1) {
    for (std::size_t u = 0; u < units.size(); ++u) {
        done_by_[u + 1] = done_by_[u] + work_of_unit(units[u]);
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

    const std::uint64_t share = done_by_.back() / workers;
    for (std::size_t w = 0; w < workers; ++w)
        runs_[w] = {unit_at(w * share), w + 1 < workers ? unit_at((w + 1) * share) : units.size()};
}

std::size_t WorkSchedule::unit_at(std::uint64_t work) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(done_by_, work) - done_by_.begin());
}

std::optional<std::size_t> WorkSchedule::next(std::size_t worker) {
    Run& run = runs_[worker];
    if (run.begin == run.end) {
        Run& longest = *std::ranges::max_element(
            runs_, {}, [this](const Run& other) { return work_of(other); });
        if (longest.begin == longest.end)
            return std::nullopt;
        const std::uint64_t half = done_by_[longest.begin] + work_of(longest) / 2;
        // At least one unit changes hands, be it the only one.
        const std::size_t middle = std::min(unit_at(half), longest.end - 1);
        run = {middle, longest.end};
        longest.end = middle;
    }
    return run.begin++;
}

std::uint32_t WorkSchedule::next_use(std::size_t worker, std::uint32_t mesh,
                                     std::size_t unit) const {
    const auto begin = uses_.begin() + first_use_[mesh], end = uses_.begin() + first_use_[mesh + 1];
    const auto use = std::upper_bound(begin, end, static_cast<std::uint32_t>(unit));
    return use == end || *use >= runs_[worker].end ? WorkPiece::kNoUse : *use;
}

} // namespace abut
