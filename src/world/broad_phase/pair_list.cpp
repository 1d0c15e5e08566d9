#include "world/broad_phase/pair_list.h"

#include "core/parallel.h"

#include <algorithm>
#include <iterator>

namespace abut {

namespace {

using Pairs = std::span<const IndexPair>;

/// The pairs that are in only one of two sorted lists.
struct Differences {
    std::vector<IndexPair> only_a, only_b;
};

/// Compares two sorted lists without branching on the data, as the outcomes are unpredictable.
Differences find_differences(Pairs a, Pairs b) {
    // One element more than needed: a pair that does not belong is written and then overwritten.
    Differences result{std::vector<IndexPair>(a.size() + 1), std::vector<IndexPair>(b.size() + 1)};
    std::size_t i = 0, k = 0, count_a = 0, count_b = 0;
    while (i < a.size() && k < b.size()) {
        const IndexPair x = a[i], y = b[k];
        result.only_a[count_a] = x;
        result.only_b[count_b] = y;
        count_a += x < y ? 1 : 0;
        count_b += y < x ? 1 : 0;
        i += y < x ? 0 : 1;
        k += x < y ? 0 : 1;
    }
    result.only_a.resize(count_a);
    result.only_b.resize(count_b);
    result.only_a.insert(result.only_a.end(), a.begin() + static_cast<std::ptrdiff_t>(i), a.end());
    result.only_b.insert(result.only_b.end(), b.begin() + static_cast<std::ptrdiff_t>(k), b.end());
    return result;
}

/// Concatenates the member `part` of all elements.
void join(const std::vector<Differences>& all, std::vector<IndexPair> Differences::*part,
          std::vector<IndexPair>& to) {
    std::size_t count = 0;
    for (const Differences& each : all)
        count += (each.*part).size();
    to.clear();
    to.reserve(count);
    for (const Differences& each : all)
        to.insert(to.end(), (each.*part).begin(), (each.*part).end());
}

} // namespace

const std::vector<IndexPair>& PairList::pairs() const noexcept {
    if (is_waiting_.load(std::memory_order_acquire)) {
        const std::scoped_lock lock(joining_);
        if (is_waiting_.load(std::memory_order_relaxed)) {
            apply(waiting_.settle(), pairs_);
            waiting_.clear();
            is_waiting_.store(false, std::memory_order_release);
        }
    }
    return pairs_;
}

/// Call it after the sorted list has been set.
void PairList::set_pairs_current() {
    waiting_.clear();
    is_waiting_ = false;
    size_ = pairs_.size();
}

void PairList::find_changes() {
    // One task at least: if there are no pairs now, all those of the last step have ended.
    const std::size_t tasks =
        std::max<std::size_t>((pairs_.size() + kPairsOfTask - 1) / kPairsOfTask, 1);
    std::vector<Differences> changes(tasks);
    // Cuts the last list at the pairs at which the new list is cut. Only a task that has pairs of
    // the new list has a first pair.
    const auto cut = [&](std::size_t task) {
        if (task == 0)
            return last_.begin();
        return task == tasks
                   ? last_.end()
                   : std::lower_bound(last_.begin(), last_.end(), pairs_[task * kPairsOfTask]);
    };
    parallel_for(tasks, 1, [&](std::size_t task) {
        const std::size_t begin = task * kPairsOfTask,
                          end = std::min(pairs_.size(), begin + kPairsOfTask);
        changes[task] = find_differences(Pairs(cut(task), cut(task + 1)),
                                         Pairs(pairs_).subspan(begin, end - begin));
    });
    join(changes, &Differences::only_a, ended_);
    join(changes, &Differences::only_b, begun_);
}

void PairList::assign(std::vector<IndexPair> pairs) {
    pairs_ = std::move(pairs);
    set_pairs_current();
}

void PairList::replace(std::vector<IndexPair>& pairs, std::vector<IndexPair> begun,
                       std::vector<IndexPair> ended) {
    std::swap(pairs_, pairs);
    begun_ = std::move(begun), ended_ = std::move(ended);
    set_pairs_current();
}

void PairList::replace_all(std::vector<std::vector<IndexPair>>& found, std::size_t boxes) {
    static_cast<void>(this->pairs()); // the last step's list
    std::swap(pairs_, last_);
    sort_pairs(found, boxes, pairs_);
    find_changes();
    set_pairs_current();
}

void PairList::replace_marked(std::vector<std::vector<IndexPair>>& found, const BoxMarks& marks) {
    std::vector<IndexPair> before, now;
    sort_pairs(found, marks.size(), now);
    const std::vector<IndexPair>& last = pairs();
    std::copy_if(last.begin(), last.end(), std::back_inserter(before),
                 [&](IndexPair pair) { return (marks[pair.a()] | marks[pair.b()]) != 0; });
    Differences changes = find_differences(before, now);
    change(std::move(changes.only_b), std::move(changes.only_a));
}

void PairList::change(std::vector<IndexPair> begun, std::vector<IndexPair> ended) {
    begun_ = std::move(begun), ended_ = std::move(ended);
    if (begun_.empty() && ended_.empty())
        return;
    size_ += begun_.size();
    size_ -= ended_.size();
    // With more changes, sorting and searching them takes longer than going through the list.
    constexpr std::size_t kPairsOfChange = 32;
    if ((waiting_.size() + begun_.size() + ended_.size()) * kPairsOfChange > pairs_.size()) {
        static_cast<void>(pairs());
        merge_changes();
        return;
    }
    waiting_.add(begun_, ended_);
    // A reader must not run out of memory. Growing by half bounds how often the list is copied.
    const std::size_t most = pairs_.size() + waiting_.size();
    if (most > pairs_.capacity())
        pairs_.reserve(most + most / 2);
    is_waiting_.store(true, std::memory_order_release);
}

/// Merges the step's changes into an up-to-date list.
void PairList::merge_changes() {
    std::swap(pairs_, last_);
    pairs_.clear();
    pairs_.reserve(last_.size() + begun_.size());
    auto next_begun = begun_.begin(), next_ended = ended_.begin();
    for (const IndexPair pair : last_) {
        if (next_ended != ended_.end() && *next_ended == pair) {
            ++next_ended;
            continue;
        }
        for (; next_begun != begun_.end() && *next_begun < pair; ++next_begun)
            pairs_.push_back(*next_begun);
        pairs_.push_back(pair);
    }
    pairs_.insert(pairs_.end(), next_begun, begun_.end());
}

} // namespace abut
