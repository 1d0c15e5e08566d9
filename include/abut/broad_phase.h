#pragma once

#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Finds which of many boxes overlap, step after step. docs/world.md explains the methods.
namespace abut {

/// The indices of two different boxes, the lower one first. They are packed into one number, so
/// that lists of pairs sort and compare fast.
class IndexPair {
public:
    IndexPair() = default;
    IndexPair(std::uint32_t i, std::uint32_t k)
        : key_(i < k ? std::uint64_t{i} << 32 | k : std::uint64_t{k} << 32 | i) {}

    /// Returns the pair that has this key.
    static IndexPair of_key(std::uint64_t key) {
        IndexPair pair;
        pair.key_ = key;
        return pair;
    }

    [[nodiscard]] std::uint32_t a() const noexcept {
        return static_cast<std::uint32_t>(key_ >> 32);
    }
    [[nodiscard]] std::uint32_t b() const noexcept { return static_cast<std::uint32_t>(key_); }
    /// Increases with a, then with b.
    [[nodiscard]] std::uint64_t key() const noexcept { return key_; }
    friend bool operator==(const IndexPair&, const IndexPair&) = default;
    friend bool operator<(const IndexPair& p, const IndexPair& q) { return p.key_ < q.key_; }

private:
    std::uint64_t key_ = 0;
};

/// The method that finds pairs of boxes.
enum class BroadPhaseMethod : std::uint8_t {
    automatic,       ///< tree; for up to 16,384 boxes in slow motion, loose boxes around them
    tree,            ///< wide hierarchy, refitted; rebuilt where its boxes have become too loose
    sweep,           ///< boxes sorted along one axis
    sweep_and_prune, ///< boxes sorted along three axes; examines only those that change places
};
/// The enumerator's name.
const char* to_string(BroadPhaseMethod method);

struct BroadPhaseOptions {
    BroadPhaseMethod method = BroadPhaseMethod::automatic;
    /// Returns whether the pair (i, k), i < k, is of interest; if empty, all pairs are. It is
    /// called from any thread. Its answer for a pair may change only together with a call of
    /// `BroadPhase::forget`.
    std::function<bool(std::uint32_t, std::uint32_t)> filter{};
};

class PairList;
class PairSearch;

/// The overlapping pairs of moving boxes, and the pairs that begin and end in each step. A box is
/// identified by its index.
///
/// Boxes are closed: boxes that touch overlap. A box may extend to infinity. A box with lower >
/// upper on some axis, or one that lies at infinity, contains no point and overlaps nothing. Such a
/// box can stand at an index that is not in use.
class BroadPhase {
public:
    explicit BroadPhase(BroadPhaseOptions options = {});
    ~BroadPhase();
    BroadPhase(BroadPhase&&) noexcept;
    BroadPhase& operator=(BroadPhase&&) noexcept;

    /// Starts the next step. Any box, and the number of boxes, may have changed.
    ///
    /// Accuracy    exact for the given doubles, without margins.
    /// Errors      Error{bad_argument}, naming the box, if a bound is not a number; the object is
    ///             then unchanged.
    /// Cost        about 200 ns a box with 5 pairs each, on one thread; parallel (`set_threads`).
    void update(std::span<const Box3> boxes);
    /// Starts the next step, in which only the boxes with these indices have changed or are new.
    /// The indices may be in any order; each occurs once.
    ///
    /// Cost        proportional to the changes. The next call of `pairs` merges them into the list.
    void update(std::span<const Box3> boxes, std::span<const std::uint32_t> changed);
    /// Makes the next update find all pairs anew. Call it when the answers of `filter` have
    /// changed.
    void forget();

    /// The overlapping pairs, sorted. The list is the same for every method and number of threads,
    /// and is valid until the next update.
    [[nodiscard]] const std::vector<IndexPair>& pairs() const noexcept;
    /// The pairs that began with the last update, sorted.
    [[nodiscard]] const std::vector<IndexPair>& begun() const noexcept;
    /// The pairs that ended with the last update, sorted.
    [[nodiscard]] const std::vector<IndexPair>& ended() const noexcept;

private:
    std::unique_ptr<PairSearch> search_;
    std::unique_ptr<PairList> list_;
    std::size_t boxes_ = 0; ///< at the last update
    bool forgotten_ = true;
};

/// Returns the pairs (i, k), i < k, of boxes that are at most `gap` apart on every axis and that
/// `filter(i, k)` accepts, sorted. Nothing is remembered between calls.
///
/// In          boxes; empty ones (lower > upper) overlap nothing. `filter` is called from any
///             thread.
/// Accuracy    exact for the given doubles.
/// Errors      Error{bad_argument} if a bound is not a number, or if the gap is negative or not
///             finite.
/// Cost        O(n log n + pairs), parallel. Memory: 4 bytes a box, 16 bytes a pair and about 10
///             MB, more where many boxes are long.
std::vector<IndexPair>
overlapping_boxes(std::span<const Box3> boxes, double gap = 0,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& filter = {});

} // namespace abut
