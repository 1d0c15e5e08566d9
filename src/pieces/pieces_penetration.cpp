#include <abut/convex_pieces.h>
#include <abut/penetration.h>
#include <abut/rigid.h>

#include "convex/search/epa.h"
#include "core/stop.h"
#include "pieces/contact_proof.h"
#include "pieces/pair_search.h"
#include "pieces/pieces_containment.h"
#include "pieces/proven_room.h"
#include "rigid/model/model_data.h"
#include "rigid/penetration/separation_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace abut {

namespace {

/// Finds the pair of pieces with the largest penetration depth. A translation that separates the
/// solids separates each pair of pieces, so it is no shorter than the depth of any pair.
class DeepestPieces {
public:
    DeepestPieces(const PlacedPieces& placed, PiecesDepth& result)
        : placed_(placed), result_(result) {}

    /// Searches pairs by the depth that the spheres around hulls allow, the largest first. Pairs
    /// that cannot exceed the depth found are never measured.
    void find() {
        push({0, 0});
        SearchSteps steps;
        while (!pending_.empty() && (pending_.front().first > result_.depth || !near_)) {
            steps.take();
            std::pop_heap(pending_.begin(), pending_.end(), less);
            const HullPair pair = pending_.back().second;
            pending_.pop_back();
            if (placed_.are_pieces(pair))
                measure(pair);
            else if (PiecePairSearch(placed_, result_.counters)
                         .may_meet(pair, placed_.contact_zone()))
                placed_.for_each_child(pair, [&](const HullPair& child) { push(child); });
        }
    }

    /// Returns whether two of the pieces prove that the solids share a point.
    [[nodiscard]] bool proven() const { return proven_; }
    /// Returns whether some pieces are so near that rounding may hide that they meet.
    [[nodiscard]] bool near() const { return near_; }
    /// Returns whether pieces that were measured as apart may interpenetrate.
    [[nodiscard]] bool misses_depth() const { return misses_depth_; }

    /// The directions of the pairs that were the deepest for a while, the deepest first.
    [[nodiscard]] std::vector<Vec3> directions() const {
        return {directions_.rbegin(), directions_.rend()};
    }

private:
    using Bounded = std::pair<double, HullPair>; ///< with a bound of its depth
    static bool less(const Bounded& p, const Bounded& q) { return p.first < q.first; }

    void push(const HullPair& pair) {
        ++result_.counters.sphere_pairs;
        const double most = placed_.most_depth(pair);
        if (most < -placed_.contact_zone())
            return;
        pending_.emplace_back(most, pair);
        std::push_heap(pending_.begin(), pending_.end(), less);
    }

    void measure(const HullPair& hulls) {
        ++result_.counters.hull_pairs;
        const PolytopePair pair = placed_.hulls(hulls);
        DifferenceSimplex first;
        first.count = 1; // the first vertices
        const GjkState found = gjk(pair, first, placed_.rounding);
        result_.counters.simplices += found.steps;
        if (!found.meeting) {
            if (!near_ && may_be_near(hulls, pair, found))
                near_ = true;
            return;
        }
        near_ = true;
        proven_ = proven_ || proves_contact(placed_, hulls, found.simplex);
        const NearestBoundary nearest =
            expand_simplex(pair, placed_.rounding, found.simplex, nullptr);
        if (!result_.meet || nearest.at_least > result_.depth)
            keep(hulls, pair, nearest);
        result_.meet = true;
    }

    /// Returns whether rounding may hide that pieces meet that GJK found to be apart.
    bool may_be_near(const HullPair& hulls, const PolytopePair& pair, const GjkState& found) {
        const double zone = placed_.contact_zone(), margin = placed_.margin(hulls);
        const double room = proven_room(pair, found.gap, placed_.a.reach, placed_.b.reach, margin);
        if (room > zone || PiecePairSearch(placed_, result_.counters).measure(hulls, {}) > zone)
            return false;
        misses_depth_ = misses_depth_ || room + margin < -zone;
        return true;
    }

    void keep(const HullPair& hulls, const PolytopePair& pair, const NearestBoundary& nearest) {
        result_.depth = nearest.at_least;
        result_.direction = -nearest.normal; // b - a reaches `depth` along the normal
        result_.piece_a = placed_.node_a(hulls.a).piece;
        result_.piece_b = placed_.node_b(hulls.b).piece;
        result_.point_a = result_.point_b = placed_.origin();
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexPair& corner = nearest.corners[i];
            result_.point_a = result_.point_a + nearest.weights[i] * pair.a.vertex(corner.a);
            result_.point_b = result_.point_b + nearest.weights[i] * pair.b.vertex(corner.b);
        }
        directions_.push_back(result_.direction);
    }

    const PlacedPieces& placed_;
    PiecesDepth& result_;
    std::vector<Bounded> pending_; ///< a heap
    std::vector<Vec3> directions_;
    bool proven_ = false, near_ = false, misses_depth_ = false;
};

/// A translation of b after which the solids share no point.
Vec3 way_out(const PlacedPieces& placed, std::vector<Vec3> directions, double at_least) {
    const Vec3 middles = placed.between({0, 0});
    directions.push_back(normalized_or_zero(middles));
    const Model &a = placed.a.model, &b = placed.b.model;
    const PlacedSolid solid_a(a, a.data().solid(), placed.world_from_a),
        solid_b(b, b.data().solid(), placed.world_from_b);
    const bool is_flattened = solid_a.model().world() != placed.world_from_a ||
                              solid_b.model().world() != placed.world_from_b;
    Counters counters;
    const Vec3 way = is_flattened
                         ? penetration(a, placed.world_from_a, b, placed.world_from_b).separation
                         : find_separation(solid_a, solid_b, directions, at_least, counters);
    const Transform moved = translated(placed.world_from_b, way);
    if (!contained_point(PlacedPieces(placed.a, placed.world_from_a, placed.b, moved)))
        return way;
    // A solid that passes through itself has an outside by parity within it: moves until the balls
    // are apart.
    const double far = length(middles) + placed.size();
    return (far * (1 + 0x1p-20) / length(way)) * way;
}

} // namespace

PiecesDepth penetration(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                        const Transform& world_from_b, const PiecesPenetrationOptions& options) {
    const StopScope stopping(options.progress);
    PiecesDepth result;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    DeepestPieces deepest(placed, result);
    deepest.find();
    if (!deepest.proven()) {
        const bool touch =
            deepest.near() && collide(a.model(), world_from_a, b.model(), world_from_b).meet();
        if (!touch) {
            PiecesDepth apart;
            apart.counters = result.counters;
            result = apart;
            if (!contained_point(placed))
                return result;
            // The surfaces meet before b is outside, so the depth is at least their distance.
            result.depth = distance(a.model(), world_from_a, b.model(), world_from_b).distance;
        }
        result.meet = true;
    }
    if (a.size() > 1 || b.size() > 1 || deepest.misses_depth())
        result.status = Status::bound_only;
    if (options.separation)
        result.separation = way_out(placed, deepest.directions(), result.depth);
    return result;
}

} // namespace abut
