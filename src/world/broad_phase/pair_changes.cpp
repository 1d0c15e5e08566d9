#include "world/broad_phase/pair_changes.h"

namespace abut {

void PairChanges::add(std::span<const IndexPair> begun, std::span<const IndexPair> ended) {
    for (const IndexPair pair : begun)
        log_.push_back({pair, 1});
    for (const IndexPair pair : ended)
        log_.push_back({pair, -1});
}

std::span<const PairChanges::Change> PairChanges::settle() {
    std::sort(log_.begin(), log_.end(),
              [](const Change& p, const Change& q) { return p.pair < q.pair; });
    // A pair's changes alternate, so that their sum tells what became of it.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < log_.size();) {
        Change sum = log_[i];
        for (++i; i < log_.size() && log_[i].pair == sum.pair; ++i)
            sum.by += log_[i].by;
        if (sum.by != 0)
            log_[kept++] = sum;
    }
    log_.resize(kept);
    return log_;
}

void apply(std::span<const PairChanges::Change> changes, std::vector<IndexPair>& pairs) {
    const auto index_of = [&](IndexPair pair, std::size_t begin, std::size_t end) {
        const auto first = pairs.begin();
        return static_cast<std::size_t>(std::lower_bound(first + static_cast<std::ptrdiff_t>(begin),
                                                         first + static_cast<std::ptrdiff_t>(end),
                                                         pair) -
                                        first);
    };
    // Pairs that ended are closed up from the front: [from, ...) has not been moved yet.
    std::size_t kept = 0, from = 0, left = 0;
    for (const PairChanges::Change& change : changes) {
        if (change.by > 0) {
            ++left;
            continue;
        }
        const std::size_t at = index_of(change.pair, from, pairs.size());
        move_run(pairs, from, at, kept);
        kept += at - from, from = at + 1;
    }
    move_run(pairs, from, pairs.size(), kept);
    kept += pairs.size() - from;
    // Pairs that began are written from the back: [0, kept) has not been moved yet.
    pairs.resize(kept + left);
    for (std::size_t i = changes.size(); i > 0; --i) {
        const PairChanges::Change& change = changes[i - 1];
        if (change.by < 0)
            continue;
        const std::size_t at = index_of(change.pair, 0, kept);
        move_run(pairs, at, kept, at + left);
        pairs[at + --left] = change.pair;
        kept = at;
    }
}

} // namespace abut
