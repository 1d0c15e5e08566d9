#pragma once

#include <abut/convex_pieces.h>

#include "pieces/pair_search.h"

#include <optional>

namespace abut {

/// What is remembered of two solids between poses.
class PiecesWarmStart::Data {
public:
    std::uint64_t id_a = 0, id_b = 0;
    PosePair poses; ///< of the last query
    PairFront front;
    HullPair closest; ///< the closest pieces
    ClosestPointSearch search;
    bool has_closest = false;
    HullPair named;         ///< pieces to which `triangles` belongs
    TrianglePair triangles; ///< that held the closest points
    bool has_triangles = false;
    /// The distance of the pieces in the last query that decided whether one solid lies inside the
    /// other, less the approach since then. While it is positive, that answer holds.
    double undisturbed = 0;
    std::optional<bool> contained;
    WarmStart surfaces; ///< of the queries on triangles
};

/// One query on two solids: the warm start; the search; whether one solid lies inside the other;
/// and the triangles, which decide where rounding hides what the hulls do.
class PiecesQuery {
public:
    PiecesQuery(const PlacedPieces& placed, PiecesWarmStart* warm_start, PiecesCounters& counters);

    [[nodiscard]] PiecePairSearch& search() { return search_; }
    /// Finds the closest pieces, or what else `search` was set to. Returns whether it found any.
    bool run();
    /// The triangles that held the last closest points, if these were on the same pieces; else
    /// null.
    [[nodiscard]] const TrianglePair* last_triangles() const {
        return last_ != nullptr && last_->has_triangles && last_->named == search_.best().hulls
                   ? &last_->triangles
                   : nullptr;
    }
    void remember(const TrianglePair& triangles) {
        if (last_ != nullptr) {
            last_->named = search_.best().hulls;
            last_->triangles = triangles;
            last_->has_triangles = true;
        }
    }
    /// A point in both solids, if one lies inside the other. In: no pieces meet; the distance of
    /// the pieces is at least `apart`.
    std::optional<Vec3> contained_point(double apart);
    /// The distance of the surfaces, if it is at most `bound`; else bound_only.
    [[nodiscard]] Gap surface_gap(double bound) const;
    /// Two triangles that share a point, if there are any.
    [[nodiscard]] std::optional<TrianglePair> touching_triangles() const;

private:
    void recall();

    const PlacedPieces& placed_;
    PiecesWarmStart::Data* last_ = nullptr;
    PiecePairSearch search_;
};

} // namespace abut
