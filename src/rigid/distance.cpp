#include <abut/error.h>
#include <abut/rigid.h>

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/placed_pair.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Keeps the nearest pair of triangles below the bound; a contact ends the search with distance 0.
///
/// Pairs that cheap bounds do not rule out are collected, and measured eight at a time.
class NearestPairFinder : public LeafPairVisitor {
public:
    NearestPairFinder(const PlacedPair& pair, double bound_sq, bool first, Counters& counters)
        : first_(first), counters_(counters), leaves_(pair), best_sq_(bound_sq) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b) override {
        leaves_.fetch(leaf_a, leaf_b);
        for (std::uint32_t i = 0; i < leaves_.count_a(); ++i) {
            counters_.primitive_tests += leaf_b.count();
            const NearLanes lanes = near_lanes(leaves_.a(i), leaves_.b(), best_sq_);
            if (find_contact(i, lanes.may_intersect & leaves_.lanes_b()))
                return -1;
            collect(i, lanes.may_be_near & leaves_.lanes_b());
            if (found_ && first_)
                return -1;
        }
        return best_sq_;
    }

    /// Measures what is left. Call it after the traversal.
    void finish() {
        if (!contact_)
            measure();
    }

    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] Gap gap() const {
        const ClosestPoints points = triangle_triangle_distance(best_.a, best_.b);
        Gap gap;
        // Surfaces apart by less than rounding are still apart.
        gap.distance =
            contact_ ? 0
                     : std::max(std::sqrt(points.distance_sq), std::numeric_limits<double>::min());
        gap.point_a = points.a, gap.point_b = points.b;
        gap.triangle_a = best_.indices.a, gap.triangle_b = best_.indices.b;
        return gap;
    }

private:
    struct Candidate {
        Triangle a, b;
        TrianglePair indices;
    };

    bool find_contact(std::uint32_t i, std::uint32_t lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            if (triangle_triangle_intersect(leaves_.a(i), leaves_.b().get(lane)) ==
                TriangleContact::none)
                continue;
            best_ = {leaves_.a(i), leaves_.b().get(lane), leaves_.indices(i, lane)};
            found_ = contact_ = true;
            return true;
        }
        return false;
    }

    void collect(std::uint32_t i, std::uint32_t lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            block_.set(collected_, leaves_.a(i), leaves_.b(), lane);
            indices_[collected_] = leaves_.indices(i, lane);
            if (++collected_ == TrianglePairBlock::kLanes)
                measure();
        }
    }

    void measure() {
        if (collected_ == 0)
            return;
        // What stands in unused lanes is measured too, and not looked at.
        double lanes_sq[TrianglePairBlock::kLanes];
        distance_sq(block_, lanes_sq);
        const auto* nearest = std::min_element(lanes_sq, lanes_sq + collected_);
        if (*nearest < best_sq_ || (first_ && *nearest <= best_sq_)) {
            const auto lane = static_cast<std::size_t>(nearest - lanes_sq);
            found_ = true;
            best_sq_ = *nearest;
            for (std::size_t k = 0; k < 3; ++k) {
                best_.a[k] = {block_.a[k][0][lane], block_.a[k][1][lane], block_.a[k][2][lane]};
                best_.b[k] = {block_.b[k][0][lane], block_.b[k][1][lane], block_.b[k][2][lane]};
            }
            best_.indices = indices_[lane];
        }
        collected_ = 0;
    }

    bool first_;
    Counters& counters_;
    LeafTriangles leaves_;
    double best_sq_;
    bool found_ = false, contact_ = false;
    Candidate best_;
    TrianglePairBlock block_{};
    std::array<TrianglePair, TrianglePairBlock::kLanes> indices_;
    std::size_t collected_ = 0;
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
    finder.finish();
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
    if (traverse_depth_first(traversal, finder) != Verdict::done)
        return true;
    finder.finish();
    return finder.found();
}

} // namespace abut
