#include "world/broad_phase/median_order.h"

#include "core/parallel.h"
#include "world/broad_phase/box_node.h"

#include <algorithm>
#include <span>

namespace abut {

namespace {

using Run = std::span<Middle>;

/// The widest axis, estimated from a sample spread over the run.
std::size_t widest_axis(Run run) {
    constexpr std::size_t kSample = 64;
    const std::size_t stride = std::max<std::size_t>(run.size() / kSample, 1);
    std::array<float, 3> lower = run.front().point, upper = lower;
    for (std::size_t i = 0; i < run.size(); i += stride)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], run[i].point[axis]);
            upper[axis] = std::max(upper[axis], run[i].point[axis]);
        }
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (upper[axis] - lower[axis] > upper[widest] - lower[widest])
            widest = axis;
    return widest;
}

/// Moves the elements that `belong` to the front and returns their number. Has no branch on the
/// data.
template <typename Belongs>
std::size_t partition(Run run, const Belongs& belongs) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
        const Middle middle = run[i];
        run[i] = run[count];
        run[count] = middle;
        count += belongs(middle) ? 1 : 0;
    }
    return count;
}

/// Estimates the coordinate of the element of a given rank, from a sample spread over the run.
float pivot(Run run, std::size_t axis, std::size_t rank) {
    std::array<float, 31> sample{};
    for (std::size_t i = 0; i < sample.size(); ++i)
        sample[i] = run[(run.size() - 1) * i / (sample.size() - 1)].point[axis];
    auto* const chosen =
        sample.begin() + static_cast<std::ptrdiff_t>(rank * sample.size() / run.size());
    std::nth_element(sample.begin(), chosen, sample.end());
    return *chosen;
}

/// Moves the `rank` lowest elements along the axis to the front. Source: quickselect [Hoare 1961].
void select(Run run, std::size_t axis, std::size_t rank) {
    constexpr std::size_t kSmall = 64;
    while (run.size() > kSmall && rank > 0 && rank < run.size()) {
        const float value = pivot(run, axis, rank);
        const std::size_t below =
            partition(run, [&](const Middle& m) { return m.point[axis] < value; });
        if (rank < below) {
            run = run.first(below);
            continue;
        }
        run = run.subspan(below), rank -= below;
        if (below > 0)
            continue;
        const std::size_t equal =
            partition(run, [&](const Middle& m) { return m.point[axis] == value; });
        if (rank <= equal)
            return;
        run = run.subspan(equal), rank -= equal;
    }
    if (rank > 0 && rank < run.size())
        std::nth_element(
            run.begin(), run.begin() + static_cast<std::ptrdiff_t>(rank), run.end(),
            [&](const Middle& a, const Middle& b) { return a.point[axis] < b.point[axis]; });
}

/// Cuts a run of more than 16 elements near its middle. Returns the place of the cut.
std::size_t cut(Run run) {
    constexpr std::size_t kWidth = BoxNode::kWidth;
    std::size_t unit = kWidth;
    while (unit * kWidth < run.size())
        unit *= kWidth;
    const std::size_t units = (run.size() + unit - 1) / unit, rank = units / 2 * unit;
    select(run, widest_axis(run), rank);
    return rank;
}

void order_run(Run run) {
    while (run.size() > BoxNode::kWidth) {
        const std::size_t rank = cut(run);
        order_run(run.first(rank));
        run = run.subspan(rank);
    }
}

} // namespace

void order_by_medians(std::vector<Middle>& middles) {
    // The first cuts are made one after the other, until the runs are small enough for parallel
    // tasks.
    constexpr std::size_t kRunOfTask = 4096;
    std::vector<Run> runs{Run(middles)};
    for (std::size_t i = 0; i < runs.size(); ++i)
        while (runs[i].size() > std::max(kRunOfTask, middles.size() / 64)) {
            const std::size_t rank = cut(runs[i]);
            runs.push_back(runs[i].subspan(rank));
            runs[i] = runs[i].first(rank);
        }
    parallel_for(runs.size(), 1, [&](std::size_t i) { order_run(runs[i]); });
}

} // namespace abut
