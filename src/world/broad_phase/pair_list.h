#pragma once

#include <abut/broad_phase.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace abut {

/// A mark for each box; not 0 if marked.
using BoxMarks = std::vector<std::uint8_t>;

/// The sorted pairs of this step, and the pairs that began or ended since the last step.
class PairList {
public:
    [[nodiscard]] const std::vector<IndexPair>& pairs() const { return pairs_; }
    [[nodiscard]] const std::vector<IndexPair>& begun() const { return begun_; }
    [[nodiscard]] const std::vector<IndexPair>& ended() const { return ended_; }

    /// Sets the pairs of the last step, which must be sorted.
    void assign(std::vector<IndexPair> pairs);
    /// Replaces all pairs by those in `found`, which may be in any order, but each only once.
    /// `found` is consumed. All indices are below `boxes`.
    void replace_all(std::vector<std::vector<IndexPair>>& found, std::size_t boxes);
    /// Replaces the pairs with a marked box by those in `found`. Other pairs stay.
    void replace_marked(std::vector<std::vector<IndexPair>>& found, const BoxMarks& marks);
    /// Sets the sorted pairs and the changes. `pairs` receives the storage of the former pairs.
    void replace(std::vector<IndexPair>& pairs, std::vector<IndexPair> begun,
                 std::vector<IndexPair> ended);
    /// Adds and removes pairs. Both lists are sorted and have each pair once.
    void change(std::vector<IndexPair> begun, std::vector<IndexPair> ended);

private:
    void find_changes();

    std::vector<IndexPair> pairs_, last_, begun_, ended_;
};

/// Sorts pairs from several lists into one, in parallel. Source: radix sort, first by the higher
/// digits of a into runs that fit a cache, then each run by the lower digits.
void sort_pairs(const std::vector<std::vector<IndexPair>>& lists, std::size_t boxes,
                std::vector<IndexPair>& sorted);

} // namespace abut
