#pragma once

#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Which of many boxes overlap, from step to step. docs/world.md tells how they are found.
namespace abut {

/// Two different boxes by their indices, the lower first; in one number, so that lists of pairs sort
/// and compare fast.
class IndexPair {
public:
    IndexPair() = default;
    IndexPair(std::uint32_t i, std::uint32_t k)
        : key_(i < k ? std::uint64_t{i} << 32 | k : std::uint64_t{k} << 32 | i) {}

    /// The pair with this key.
    static IndexPair of_key(std::uint64_t key) {
        IndexPair pair;
        pair.key_ = key;
        return pair;
    }

    [[nodiscard]] std::uint32_t a() const noexcept {
        return static_cast<std::uint32_t>(key_ >> 32);
    }
    [[nodiscard]] std::uint32_t b() const noexcept { return static_cast<std::uint32_t>(key_); }
    /// Grows with a, then with b.
    [[nodiscard]] std::uint64_t key() const noexcept { return key_; }
    friend bool operator==(const IndexPair&, const IndexPair&) = default;
    friend bool operator<(const IndexPair& p, const IndexPair& q) { return p.key_ < q.key_; }

private:
    std::uint64_t key_ = 0;
};

/// How pairs of boxes are found.
enum class BroadPhaseMethod : std::uint8_t {
    automatic,       ///< by size and measured coherence: one of those below, each step
    tree,            ///< wide hierarchy, refitted; built anew where its boxes have become bad
    sweep,           ///< sorted along one axis
    sweep_and_prune, ///< sorted along three axes; only what changes places is looked at
};
/// The enumerator's name.
const char* to_string(BroadPhaseMethod method);

struct BroadPhaseOptions {
    BroadPhaseMethod method = BroadPhaseMethod::automatic;
    /// Pairs (i, k), i < k, that are of interest; all if empty. Called from any thread. What it says
    /// of a pair may change only with `BroadPhase::forget`.
    std::function<bool(std::uint32_t, std::uint32_t)> filter{};
};

class PairList;
class PairSearch;

/// The overlapping pairs of boxes that move, and which begin and end. A box is known by its index.
///
/// Boxes are closed: touching ones overlap. A box with lower > upper on some axis, or that lies at
/// infinity, has no point and overlaps nothing: so indices are free to be given away and taken back.
/// Boxes may reach to infinity.
class BroadPhase {
public:
    explicit BroadPhase(BroadPhaseOptions options = {});
    ~BroadPhase();
    BroadPhase(BroadPhase&&) noexcept;
    BroadPhase& operator=(BroadPhase&&) noexcept;

    /// The next step: any box may have changed, and their number.
    ///
    /// Accuracy    exact for the given doubles, no margins.
    /// Errors      Error{bad_argument} if a bound is not a number, naming the box: nothing has
    ///             changed then.
    /// Cost        some 200 ns a box with 5 pairs each, one thread; in parallel (`set_threads`).
    void update(std::span<const Box3> boxes);
    /// The same, where only the boxes of these indices (in any order, each once) may have changed, or
    /// are new.
    ///
    /// Cost        that of what changed, and of copying the list of pairs.
    void update(std::span<const Box3> boxes, std::span<const std::uint32_t> changed);
    /// Finds everything anew in the next update: what is `filter` has changed.
    void forget();

    /// Sorted, and the same for every method and number of threads; valid until the next update.
    [[nodiscard]] const std::vector<IndexPair>& pairs() const noexcept;
    /// Of `pairs`, those that were none before the last update; sorted.
    [[nodiscard]] const std::vector<IndexPair>& begun() const noexcept;
    /// Those that are none any more; sorted.
    [[nodiscard]] const std::vector<IndexPair>& ended() const noexcept;

private:
    std::unique_ptr<PairSearch> search_;
    std::unique_ptr<PairList> list_;
    std::size_t boxes_ = 0; ///< at the last update
    bool forgotten_ = true;
};

/// The pairs (i, k), i < k, of boxes at most `gap` apart on every axis, sorted, that `filter(i, k)`
/// admits: one question, nothing remembered.
///
/// In          boxes; empty ones (lower > upper) meet nothing. `filter` is called from any thread.
/// Accuracy    exact for the given doubles.
/// Errors      Error{bad_argument} if a bound is not a number, or the gap negative or not finite.
/// Cost        O(n log n + pairs), in parallel; memory of 4 bytes a box, 16 a pair and some 10 MB, more
///             where many boxes are long.
std::vector<IndexPair>
overlapping_boxes(std::span<const Box3> boxes, double gap = 0,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& filter = {});

} // namespace abut
