#pragma once

#include <abut/broad_phase.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace abut {

/// Some boxes of a set, marked.
using BoxMarks = std::vector<std::uint8_t>;

/// The sorted pairs of this step, and in what they differ from the last step's.
class PairList {
public:
    [[nodiscard]] const std::vector<IndexPair>& pairs() const { return pairs_; }
    [[nodiscard]] const std::vector<IndexPair>& begun() const { return begun_; }
    [[nodiscard]] const std::vector<IndexPair>& ended() const { return ended_; }

    /// The pairs of the last step, sorted.
    void assign(std::vector<IndexPair> pairs);
    /// All pairs are those in `found`, in any order, each once; `found` is used up.
    /// `boxes`: all indices are less.
    void replace_all(std::vector<std::vector<IndexPair>>& found, std::size_t boxes);
    /// The pairs with a marked box are those in `found`; the others stay.
    void replace_marked(std::vector<std::vector<IndexPair>>& found, const BoxMarks& marks);
    /// The pairs, sorted, and in what they differ; in exchange for the storage of others.
    void replace(std::vector<IndexPair>& pairs, std::vector<IndexPair> begun,
                 std::vector<IndexPair> ended);
    /// These pairs begin and end; both sorted, each once.
    void change(std::vector<IndexPair> begun, std::vector<IndexPair> ended);

private:
    void find_changes();

    std::vector<IndexPair> pairs_, last_, begun_, ended_;
};

/// Sorts pairs, which lie in several lists, into one; in parallel. Source: radix sort: by the higher
/// digits of a into runs that fit a cache, then these by the lower ones.
void sort_pairs(const std::vector<std::vector<IndexPair>>& lists, std::size_t boxes,
                std::vector<IndexPair>& sorted);

} // namespace abut
