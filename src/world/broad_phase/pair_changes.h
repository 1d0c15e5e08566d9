#pragma once

#include <abut/broad_phase.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The changes of a set of pairs over several steps, kept until a sorted list is brought up to
/// date. A step then costs as much as its changes, not as much as the list.
class PairChanges {
public:
    struct Change {
        IndexPair pair;
        std::int64_t by = 0; ///< 1: the pair began; -1: it ended
    };

    /// Adds the changes of a step. They follow those that were added before.
    void add(std::span<const IndexPair> begun, std::span<const IndexPair> ended);
    void add(IndexPair pair, bool begins) { log_.push_back({pair, begins ? 1 : -1}); }
    void clear() { log_.clear(); }
    [[nodiscard]] std::size_t size() const { return log_.size(); }
    [[nodiscard]] bool empty() const { return log_.empty(); }

    /// Sorts the changes and leaves out the pairs that are again as they were. Each pair occurs at
    /// most once in the result. No memory is allocated.
    std::span<const Change> settle();

private:
    std::vector<Change> log_;
};

/// Brings a sorted list up to date. In: settled changes that follow from the list.
///
/// Cost        O(changes log pairs), plus moving the runs of pairs between changes. No memory is
///             allocated if the list has room for the pairs that begin.
void apply(std::span<const PairChanges::Change> changes, std::vector<IndexPair>& pairs);

/// Brings the values of pairs up to date, one value for each pair of a sorted list. Values of pairs
/// that began are new.
///
/// In          pairs: the list to which the changes lead; values: those of the list before.
template <typename Value>
void apply(std::span<const PairChanges::Change> changes, std::span<const IndexPair> pairs,
           std::vector<Value>& values);

/// Moves [begin, end) of a list so that it begins at `to`.
template <typename Value>
void move_run(std::vector<Value>& list, std::size_t begin, std::size_t end, std::size_t to) {
    const auto at = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
    if (to < begin)
        std::move(at(begin), at(end), at(to));
    else if (to > begin)
        std::move_backward(at(begin), at(end), at(to + (end - begin)));
}

template <typename Value>
void apply(std::span<const PairChanges::Change> changes, std::span<const IndexPair> pairs,
           std::vector<Value>& values) {
    // Where each change is: in the list before if the pair ended, in `pairs` if it began.
    std::vector<std::size_t> removed, added;
    for (const PairChanges::Change& change : changes) {
        const auto place = std::lower_bound(pairs.begin(), pairs.end(), change.pair);
        const auto at = static_cast<std::size_t>(place - pairs.begin());
        if (change.by > 0)
            added.push_back(at);
        else
            removed.push_back(at - added.size() + removed.size());
    }
    std::size_t kept = removed.empty() ? values.size() : removed.front();
    for (std::size_t i = 0; i < removed.size(); ++i) {
        const std::size_t begin = removed[i] + 1,
                          end = i + 1 < removed.size() ? removed[i + 1] : values.size();
        move_run(values, begin, end, kept);
        kept += end - begin;
    }
    values.resize(kept);
    values.resize(pairs.size());
    for (std::size_t i = added.size(); i > 0; --i) {
        const std::size_t at = added[i - 1], begin = at - (i - 1);
        move_run(values, begin, kept, at + 1);
        values[at] = Value();
        kept = begin;
    }
}

} // namespace abut
