#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace abut {

/// Disjoint sets of the numbers below a count (union-find). The root of a set is its least member.
///
/// Cost        root() and unite(): O(log n) amortised, since root() halves the paths that it takes.
class DisjointSets {
public:
    /// Starts with one set for each number.
    explicit DisjointSets(std::size_t count = 0) { reset(count); }
    /// Starts with the sets that the parents describe. In: parents[i] <= i.
    explicit DisjointSets(std::vector<std::uint32_t> parents) : parent_(std::move(parents)) {}

    /// Starts anew with one set for each number. Uses the memory again.
    void reset(std::size_t count) {
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// Unites the sets of i and j. Returns the root of the union.
    std::uint32_t unite(std::uint32_t i, std::uint32_t j) {
        const auto [low, high] = std::minmax({root(i), root(j)});
        parent_[high] = low;
        return low;
    }

    /// Returns the root of each number.
    std::vector<std::uint32_t> roots() && {
        for (std::uint32_t& parent : parent_) // parents are lower, so that theirs are final
            parent = parent_[parent];
        return std::move(parent_);
    }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace abut
