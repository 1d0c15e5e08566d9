#include "core/parallel.h"
#include "world/broad_phase/pair_list.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace abut {

namespace {

/// Distributes pairs to runs by the higher bits of a. Each run fits a cache and is sorted by the
/// rest of the key: the lower bits of a, and b.
class Runs {
public:
    Runs(std::size_t boxes, std::size_t pairs)
        : index_bits_(std::bit_width(std::max<std::size_t>(boxes, 1) - 1)) {
        const int filter = std::bit_width(pairs / kPairsOfRun);
        shift_ = std::max(0, index_bits_ - std::min(filter, kMostBits));
        count_ = ((std::max<std::size_t>(boxes, 1) - 1) >> shift_) + 1;
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t of(IndexPair pair) const { return pair.a() >> shift_; }
    /// Number of different first boxes a in one run, and which of them a pair has.
    [[nodiscard]] std::size_t rows() const { return std::size_t{1} << shift_; }
    [[nodiscard]] std::size_t row(IndexPair pair) const { return pair.a() & (rows() - 1); }
    /// Number of key bits that distinguish the pairs of one run, and these bits of a pair.
    [[nodiscard]] int rest_bits() const { return shift_ + index_bits_; }
    [[nodiscard]] std::uint64_t rest(IndexPair pair) const {
        const std::uint64_t low_a = pair.a() & ((std::uint64_t{1} << shift_) - 1);
        return low_a << index_bits_ | pair.b();
    }

private:
    static constexpr std::size_t kPairsOfRun = 4096;
    static constexpr int kMostBits = 10;
    int index_bits_, shift_;
    std::size_t count_;
};

struct SortScratch {
    std::vector<IndexPair> pairs;
    std::vector<std::uint32_t> first;
};

/// Sorts the pairs of one box by rank: a pair's place is the number of smaller pairs. Has no branch
/// on the data.
void sort_row(std::span<const IndexPair> row, IndexPair* to) {
    for (const IndexPair pair : row) {
        std::size_t rank = 0;
        for (const IndexPair other : row)
            rank += other.b() < pair.b() ? 1 : 0;
        to[rank] = pair;
    }
}

/// Sorts a run with few pairs for each box: distributes the pairs to the boxes, then sorts each
/// box's.
void sort_rows(std::span<IndexPair> run, const Runs& runs, SortScratch& scratch) {
    constexpr std::size_t kLongRow = 24;
    scratch.first.assign(runs.rows() + 1, 0);
    for (const IndexPair pair : run)
        ++scratch.first[runs.row(pair) + 1];
    for (std::size_t row = 1; row < scratch.first.size(); ++row)
        scratch.first[row] += scratch.first[row - 1];
    for (const IndexPair pair : run)
        scratch.pairs[scratch.first[runs.row(pair)]++] = pair;
    // Each entry now is where the next box's pairs begin.
    std::uint32_t begin = 0;
    for (std::size_t row = 0; row < runs.rows(); ++row) {
        const std::uint32_t end = scratch.first[row];
        const auto pairs = std::span(scratch.pairs).subspan(begin, end - begin);
        if (pairs.size() > kLongRow)
            std::sort(pairs.begin(), pairs.end());
        if (pairs.size() > kLongRow)
            std::copy(pairs.begin(), pairs.end(), run.begin() + begin);
        else
            sort_row(pairs, run.data() + begin);
        begin = end;
    }
}

/// Sorts a run by radix sort, least significant digit first.
void sort_run(std::span<IndexPair> run, const Runs& runs, SortScratch& scratch) {
    constexpr int kMostBits = 10;
    constexpr std::size_t kSmall = 128;
    if (run.size() < kSmall) {
        std::sort(run.begin(), run.end());
        return;
    }
    scratch.pairs.resize(run.size());
    const int passes = std::max((runs.rest_bits() + kMostBits - 1) / kMostBits, 1);
    constexpr std::size_t kPairsOfRow = 12;
    if (passes > 2 && run.size() < kPairsOfRow * runs.rows()) {
        sort_rows(run, runs, scratch);
        return;
    }
    const int bits = (runs.rest_bits() + passes - 1) / passes;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    std::span<IndexPair> from = run, to(scratch.pairs);
    for (int pass = 0; pass < passes; ++pass) {
        std::array<std::uint32_t, (1 << kMostBits) + 1> first{};
        const auto digit = [&](IndexPair pair) { return runs.rest(pair) >> pass * bits & mask; };
        for (const IndexPair pair : from)
            ++first[digit(pair) + 1];
        for (std::size_t i = 1; i <= mask; ++i)
            first[i] += first[i - 1];
        for (const IndexPair pair : from)
            to[first[digit(pair)]++] = pair;
        std::swap(from, to);
    }
    if (from.data() != run.data())
        std::copy(from.begin(), from.end(), run.begin());
}

using Lists = std::vector<std::vector<IndexPair>>;

/// Distributes the pairs of all lists to the runs. Returns where each run begins, and the end. The
/// lists are divided into groups with their own counts, so that groups need not wait for each
/// other.
std::vector<std::size_t> deal(const Lists& lists, const Runs& runs, std::span<IndexPair> to) {
    constexpr std::size_t kMostGroups = 64, kPairsOfGroup = 1 << 14;
    const std::size_t groups = std::min(kMostGroups, to.size() / kPairsOfGroup + 1);
    std::vector<std::size_t> next(groups * runs.count(), 0);
    const auto for_each_pair = [&](std::size_t group, const auto& visit) {
        const std::size_t begin = lists.size() * group / groups,
                          end = lists.size() * (group + 1) / groups;
        for (std::size_t i = begin; i < end; ++i)
            for (const IndexPair pair : lists[i])
                visit(pair, next[group * runs.count() + runs.of(pair)]);
    };
    parallel_for(groups, 1, [&](std::size_t group) {
        for_each_pair(group, [](IndexPair, std::size_t& count) { ++count; });
    });
    std::vector<std::size_t> first;
    std::size_t sum = 0;
    for (std::size_t run = 0; run < runs.count(); ++run) {
        first.push_back(sum);
        for (std::size_t group = 0; group < groups; ++group)
            sum += std::exchange(next[group * runs.count() + run], sum);
    }
    first.push_back(sum);
    parallel_for(groups, 1, [&](std::size_t group) {
        for_each_pair(group, [&](IndexPair pair, std::size_t& place) { to[place++] = pair; });
    });
    return first;
}

} // namespace

void sort_pairs(const Lists& lists, std::size_t boxes, std::vector<IndexPair>& sorted) {
    std::size_t count = 0;
    for (const auto& list : lists)
        count += list.size();
    sorted.resize(count);
    const Runs runs(boxes, count);
    const std::vector<std::size_t> first = deal(lists, runs, sorted);
    constexpr std::size_t kRunsOfTask = 8;
    parallel_for((runs.count() + kRunsOfTask - 1) / kRunsOfTask, 1, [&](std::size_t task) {
        SortScratch scratch;
        const std::size_t end = std::min((task + 1) * kRunsOfTask, runs.count());
        for (std::size_t run = task * kRunsOfTask; run < end; ++run)
            sort_run(std::span(sorted).subspan(first[run], first[run + 1] - first[run]), runs,
                     scratch);
    });
}

} // namespace abut
