#pragma once

#include <abut/convex_pieces.h>

#include "convex/search/closest_points.h"
#include "pieces/placed_pieces.h"
#include "pieces/relative_motion.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace abut {

/// A pair of hulls, and what is known of its distance.
struct BoundedPair {
    double bound = 0; ///< proven lower bound of the distance, plus PairFront::drift
    HullPair hulls;
    HullFeature a, b;   ///< where the last walk ended, or the next one begins
    Vec3 along;         ///< initially: a direction along which the hulls may be apart
    bool begun = false; ///< a and b are set
};

/// Pairs of hulls that together cover all pairs of pieces, each with a bound of its distance: a
/// search ends with a front, and the next one begins with it. Between poses the bounds decrease by
/// how far the bodies may have approached. That is summed up in `drift`, so that no bound needs to
/// be changed.
struct PairFront {
    std::vector<BoundedPair> heap; ///< a heap: the smallest bound first
    /// While a search runs: pairs that are measured and no longer matter.
    std::vector<BoundedPair> settled;
    double drift = 0;
    /// For the search that began at the roots: the pairs that it measured, and that it left here.
    std::uint64_t fresh_pairs = 0, fresh_size = 0;
    bool worn = false; ///< beginning anew costs less than continuing
};

struct ClosestPieces {
    HullPair hulls;
    ClosestPointSearch search;
    double distance = std::numeric_limits<double>::infinity();
    double at_least = 0; ///< proven lower bound of the pair's distance
    bool found = false;
    bool proven = false; ///< if the pieces meet: the solids are proven to meet

    [[nodiscard]] bool meet() const { return found && distance == 0; }
};

/// Finds the closest pieces of two solids, the pair with the smallest bound first.
class PiecePairSearch {
public:
    PiecePairSearch(const PlacedPieces& placed, PiecesCounters& counters)
        : placed_(placed), counters_(counters) {}

    /// Looks only for pieces that are nearer than this.
    void set_bound(double bound) { best_.distance = bound; }
    /// Allows the found distance to exceed the smallest by this much.
    void set_slack(double slack) { slack_ = slack; }
    /// Ends the search at the first pair within the bound.
    void stop_at_first() { first_ = true; }

    /// Measures a pair of pieces, beginning at features that were closest before. Returns whether
    /// that ends the search.
    bool try_pair(const HullPair& hulls, const ClosestPointSearch& start) {
        measure(hulls, start);
        return ends();
    }
    /// Measures a pair of pieces. Returns a proven lower bound of its distance.
    double measure(const HullPair& hulls, const ClosestPointSearch& start);
    /// Returns false only if the hulls of a pair are proven to be farther apart than `room`.
    bool may_meet(const HullPair& hulls, double room);
    /// Searches from the front; an empty one begins at the roots. With `keep`, the front covers all
    /// pairs again afterwards.
    void run(PairFront& front, bool keep);

    [[nodiscard]] const ClosestPieces& best() const { return best_; }
    /// Proven lower bound of the distance of all pieces. Call it after `run`.
    [[nodiscard]] double at_least() const {
        return best_.found ? std::min(at_least_, best_.distance) : at_least_;
    }
    /// Returns whether the found distance is that of the solids, to rounding. If not, rounding
    /// hides whether other pieces are nearer, or whether these meet. Call it after `run`.
    [[nodiscard]] bool is_decided() const;

private:
    double begin(BoundedPair& pair);
    void jump(const BoundedPair& roots);
    void measure(BoundedPair& pair, double floor);
    void measure_pieces(BoundedPair& pair);
    double take(const HullPair& hulls, const PolytopePair& pair, const ClosestPointSearch& search);
    [[nodiscard]] double bound_by_walk(const HullPair& hulls, const PolytopePair& pair,
                                       const WalkState& at, double distance) const;
    void measure_hulls(BoundedPair& pair, double floor);
    void open(const BoundedPair& pair, PairFront& front, bool keep);
    [[nodiscard]] bool ends() const { return best_.found && (first_ || best_.distance == 0); }
    /// Returns whether pairs with this bound may matter.
    [[nodiscard]] bool matters(double bound) const {
        return first_ ? bound <= best_.distance
                      : bound < best_.distance - (best_.found ? slack_ : 0);
    }

    const PlacedPieces& placed_;
    PiecesCounters& counters_;
    ClosestPieces best_;
    double slack_ = 0, at_least_ = std::numeric_limits<double>::infinity();
    /// The smallest bound of measured pairs whose distance is known only to rounding.
    double unresolved_ = std::numeric_limits<double>::infinity();
    bool first_ = false;
};

} // namespace abut
