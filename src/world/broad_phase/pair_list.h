#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/pair_changes.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

namespace abut {

/// A mark for each box; not 0 if marked.
using BoxMarks = std::vector<std::uint8_t>;

/// The sorted pairs of this step, and the pairs that began or ended since the last step.
///
/// If few pairs change, the sorted list waits until someone reads it (`PairChanges`). Several
/// threads may read at once.
class PairList {
public:
    /// How many pairs a task compares with those of the last step.
    static constexpr std::size_t kPairsOfTask = std::size_t{1} << 14;

    [[nodiscard]] const std::vector<IndexPair>& pairs() const noexcept;
    /// The number of pairs. The sorted list need not be up to date for it.
    [[nodiscard]] std::size_t size() const { return size_; }
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
    void merge_changes();
    void set_pairs_current();

    std::vector<IndexPair> last_, begun_, ended_;
    std::size_t size_ = 0;
    // The list as of an earlier step, and the changes since then. A reader joins them.
    mutable std::vector<IndexPair> pairs_;
    mutable PairChanges waiting_;
    mutable std::atomic<bool> is_waiting_ = false;
    mutable std::mutex joining_;
};

/// Sorts pairs from several lists into one, in parallel. Source: radix sort, first by the higher
/// digits of a into runs that fit a cache, then each run by the lower digits.
void sort_pairs(const std::vector<std::vector<IndexPair>>& lists, std::size_t boxes,
                std::vector<IndexPair>& sorted);

} // namespace abut
