#pragma once

#include <abut/broad_phase.h>

#include "core/parallel.h"
#include "core/progress.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace abut {

/// Calls append(pair, k, results) for the k-th pair, in parallel. Sets the results to all of them, in order.
///
/// In          parts: memory that is used again. expected: number of results, about.
template <typename Result, typename Append>
void find_all(const Progress& progress, std::string_view stage, const std::vector<IndexPair>& pairs,
              const Append& append, std::vector<std::vector<Result>>& parts,
              std::vector<Result>& results, std::size_t expected = 0) {
    constexpr std::size_t kPairsOfTask = 16;
    const StopScope stopping(progress);
    ProgressMeter meter(progress, stage, pairs.size());
    results.clear();
    results.reserve(expected);
    const auto append_task = [&](std::size_t task, std::vector<Result>& part) {
        const std::size_t end = std::min(pairs.size(), (task + 1) * kPairsOfTask);
        for (std::size_t k = task * kPairsOfTask; k < end; ++k)
            append(pairs[k], k, part);
        meter.advance(end - task * kPairsOfTask);
    };
    const std::size_t tasks = (pairs.size() + kPairsOfTask - 1) / kPairsOfTask;
    if (is_sequential()) {
        for (std::size_t task = 0; task < tasks; ++task) {
            poll_stop();
            append_task(task, results);
        }
        return;
    }
    if (parts.size() < tasks)
        parts.resize(tasks);
    parallel_for(tasks, 1, [&](std::size_t task) {
        parts[task].clear();
        append_task(task, parts[task]);
    });
    for (std::size_t task = 0; task < tasks; ++task)
        results.insert(results.end(), parts[task].begin(), parts[task].end());
}

/// As find_all, where find(pair, k) returns a result or none.
template <typename Result, typename Find>
void find_each(const Progress& progress, std::string_view stage,
               const std::vector<IndexPair>& pairs, const Find& find,
               std::vector<std::vector<Result>>& parts, std::vector<Result>& results) {
    find_all<Result>(
        progress, stage, pairs,
        [&](IndexPair pair, std::size_t k, std::vector<Result>& part) {
            if (std::optional<Result> result = find(pair, k))
                part.push_back(*result);
        },
        parts, results);
}

} // namespace abut
