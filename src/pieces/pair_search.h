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
    double bound = 0; ///< proven: no nearer than this less the drift since (see PairFront)
    HullPair hulls;
    HullFeature a, b;   ///< where the last walk ended, or the next one begins
    Vec3 along;         ///< at first: a direction in which the hulls may be apart
    bool begun = false; ///< there are features
};

/// Pairs of hulls that together hold all pairs of pieces: where a search ended, and the next one
/// begins. Each has a bound of its distance. Between poses the bounds shrink by what the motion may
/// have brought: the drift, which is summed up, so that no bound needs to be touched.
struct PairFront {
    std::vector<BoundedPair> heap;    ///< the least bound first
    std::vector<BoundedPair> settled; ///< while a search runs: measured, and not of interest
    double drift = 0;
    /// Of the search that began at the roots: pairs that it measured, and that it left here.
    std::uint64_t fresh_pairs = 0, fresh_size = 0;
    bool worn = false; ///< to begin anew costs less than to go on
};

/// The closest pieces found.
struct ClosestPieces {
    HullPair hulls;
    ClosestPointSearch search;
    double distance = std::numeric_limits<double>::infinity();
    double at_least = 0; ///< proven: no two points of the pair are closer
    bool found = false;
    bool proven = false; ///< if they meet: so do the solids, whatever rounding did

    [[nodiscard]] bool meet() const { return found && distance == 0; }
};

/// Looks for the closest pieces of two solids, nearest bound first.
class PiecePairSearch {
public:
    PiecePairSearch(const PlacedPieces& placed, PiecesCounters& counters)
        : placed_(placed), counters_(counters) {}

    /// Nothing from here on matters; what is found must be nearer.
    void set_bound(double bound) { best_.distance = bound; }
    /// What is found may be so much farther than the closest.
    void set_slack(double slack) { slack_ = slack; }
    /// One pair within the bound is enough.
    void stop_at_first() { first_ = true; }

    /// Measures a pair of pieces, from features that were closest before. Whether it ends the
    /// search.
    bool try_pair(const HullPair& hulls, const ClosestPointSearch& start) {
        measure(hulls, start);
        return ends();
    }
    /// The same; returns a proven bound of the pair's distance.
    double measure(const HullPair& hulls, const ClosestPointSearch& start);
    /// False only if the hulls of a pair are proven to be apart, by more than `room`.
    bool may_meet(const HullPair& hulls, double room);
    /// From the front on; an empty one begins at the roots. With `keep` it is left so that it holds
    /// all pairs again.
    void run(PairFront& front, bool keep);

    [[nodiscard]] const ClosestPieces& best() const { return best_; }
    /// Proven: no two pieces are closer. After `run`.
    [[nodiscard]] double at_least() const {
        return best_.found ? std::min(at_least_, best_.distance) : at_least_;
    }
    /// Whether the distance found is that of the solids, to rounding; else rounding hides whether
    /// other pieces are nearer, or whether these meet. After `run`.
    [[nodiscard]] bool is_decided() const;

private:
    double begin(BoundedPair& pair);
    void jump(const BoundedPair& roots);
    void measure(BoundedPair& pair, double floor);
    void measure_pieces(BoundedPair& pair);
    double take(const HullPair& hulls, const PolytopePair& pair, const ClosestPointSearch& search);
    [[nodiscard]] double bound_by_walk(const HullPair& hulls, const WalkState& at,
                                       double distance) const;
    void measure_hulls(BoundedPair& pair, double floor);
    void open(const BoundedPair& pair, PairFront& front);
    [[nodiscard]] bool ends() const { return best_.found && (first_ || best_.distance == 0); }
    /// Whether what is no nearer may matter.
    [[nodiscard]] bool matters(double bound) const {
        return first_ ? bound <= best_.distance
                      : bound < best_.distance - (best_.found ? slack_ : 0);
    }

    const PlacedPieces& placed_;
    PiecesCounters& counters_;
    ClosestPieces best_;
    double slack_ = 0, at_least_ = std::numeric_limits<double>::infinity();
    /// The least bound of pairs measured whose distance is not known better than to rounding.
    double unresolved_ = std::numeric_limits<double>::infinity();
    bool first_ = false;
};

} // namespace abut
