#include <abut/error.h>
#include <abut/rigid.h>

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/placed_pair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Keeps the nearest pair of triangles below the bound; a contact ends the search with distance 0.
class NearestPairFinder : public LeafPairVisitor {
public:
    NearestPairFinder(const PlacedPair& pair, double bound_sq, bool first, Counters& counters)
        : first_(first), counters_(counters), leaves_(pair), best_sq_(bound_sq) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b) override {
        leaves_.fetch(leaf_a, leaf_b);
        for (std::uint32_t i = 0; i < leaves_.count_a(); ++i) {
            counters_.primitive_tests += leaf_b.count();
            if (find_contact(i) || (find_nearer(i) && first_))
                return -1;
        }
        return best_sq_;
    }

    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] Gap gap() const {
        const ClosestPoints points = triangle_triangle_distance(a_, b_);
        Gap gap;
        // Surfaces apart by less than rounding are still apart.
        gap.distance =
            contact_ ? 0
                     : std::max(std::sqrt(points.distance_sq), std::numeric_limits<double>::min());
        gap.point_a = points.a, gap.point_b = points.b;
        gap.triangle_a = indices_.a, gap.triangle_b = indices_.b;
        return gap;
    }

private:
    void keep(std::uint32_t i, std::uint32_t lane, double distance_sq) {
        found_ = true;
        best_sq_ = distance_sq;
        a_ = leaves_.a(i), b_ = leaves_.b().get(lane);
        indices_ = leaves_.indices(i, lane);
    }

    bool find_contact(std::uint32_t i) {
        std::uint32_t lanes = may_intersect(leaves_.a(i), leaves_.b()) & leaves_.lanes_b();
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            if (triangle_triangle_intersect(leaves_.a(i), leaves_.b().get(lane)) ==
                TriangleContact::none)
                continue;
            keep(i, lane, 0);
            contact_ = true;
            return true;
        }
        return false;
    }

    bool find_nearer(std::uint32_t i) {
        double lanes_sq[TriangleBlock::kLanes];
        distance_sq(leaves_.a(i), leaves_.b(), lanes_sq);
        const auto* nearest =
            std::min_element(lanes_sq, lanes_sq + std::popcount(leaves_.lanes_b()));
        if (!(*nearest < best_sq_ || (first_ && *nearest <= best_sq_)))
            return false;
        keep(i, static_cast<std::uint32_t>(nearest - lanes_sq), *nearest);
        return true;
    }

    bool first_;
    Counters& counters_;
    LeafTriangles leaves_;
    double best_sq_;
    bool found_ = false, contact_ = false;
    Triangle a_, b_;
    TrianglePair indices_;
};

void require_bound(double bound, const char* what) {
    if (!(bound >= 0))
        throw Error(ErrorCode::bad_argument, std::string(what) + " must not be negative");
}

} // namespace

Gap distance(const PlacedPair& pair, double upper_bound) {
    const std::uint64_t exact_before = exact_signs();
    Counters counters;
    NearestPairFinder finder(pair, upper_bound * upper_bound, false, counters);
    PairTraversal traversal = pair.traversal(upper_bound * upper_bound);
    traverse_best_first(traversal, finder);
    Gap gap;
    if (finder.found()) {
        gap = finder.gap();
    } else {
        gap.distance = upper_bound;
        gap.status = Status::bound_only;
    }
    counters.volume_tests = traversal.volume_tests;
    counters.exact_tests = exact_signs() - exact_before;
    gap.counters = counters;
    return gap;
}

Gap distance(const Model& a, const Transform& world_from_a, const Model& b,
             const Transform& world_from_b, const DistanceOptions& options) {
    require_bound(options.upper_bound, "distance bound");
    return distance(PlacedPair(a, world_from_a, b, world_from_b), options.upper_bound);
}

bool within(const Model& a, const Transform& world_from_a, const Model& b,
            const Transform& world_from_b, double tolerance) {
    require_bound(tolerance, "tolerance");
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    Counters counters;
    NearestPairFinder finder(pair, tolerance * tolerance, true, counters);
    PairTraversal traversal = pair.traversal(tolerance * tolerance);
    traversal.accept_early = true;
    return traverse_depth_first(traversal, finder) != Verdict::done;
}

} // namespace abut
