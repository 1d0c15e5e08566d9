#include <abut/error.h>
#include <abut/rigid.h>

#include "geometry/triangle_pair_block.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/placed_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Keeps the nearest pair of triangles below the bound; a contact ends the search with distance 0.
///
/// Pairs that cheap bounds do not rule out are collected, and measured eight at a time.
class NearestPairFinder : public LeafPairVisitor {
public:
    NearestPairFinder(const PlacedPair& pair, double bound_sq, bool first)
        : first_(first), leaves_(pair), best_sq_(bound_sq) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& pairs) override {
        leaves_.set_leaves(leaf_a, leaf_b);
        const auto take_contact = [&](auto i, auto j) {
            best_ = {leaves_.a(i), leaves_.b(j), leaves_.indices(i, j)};
            found_ = contact_ = true;
            return false;
        };
        const bool apart = for_each_pair(pairs.cross, take_contact) &&
                           for_each_pair(pairs.may_meet, [&](auto i, auto j) {
                               return triangle_triangle_intersect(leaves_.a(i), leaves_.b(j)) ==
                                          TriangleContact::none ||
                                      take_contact(i, j);
                           });
        if (!apart)
            return -1;
        for_each_pair(pairs.may_meet | pairs.may_be_near, [&](auto i, auto j) {
            block_.set(collected_, leaves_.a(i), leaves_.b(j));
            indices_[collected_] = leaves_.indices(i, j);
            if (++collected_ == TrianglePairBlock::kLanes)
                measure();
            return true;
        });
        return found_ && first_ ? -1 : best_sq_;
    }

    [[nodiscard]] Vec3 direction() const override {
        if (!found_)
            return {};
        const ClosestPoints points = triangle_triangle_distance(best_.a, best_.b);
        return normalized_or_zero(points.b - points.a);
    }

    /// Begins with a pair of triangles.
    void seed(const Triangle& a, const Triangle& b, const TrianglePair& indices) {
        const double sq = triangle_triangle_distance(a, b).distance_sq;
        if (sq < best_sq_) {
            best_sq_ = sq;
            found_ = true;
            best_ = {a, b, indices};
        }
    }
    [[nodiscard]] double best_sq() const { return best_sq_; }

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
            best_ = {block_.get_a(lane), block_.get_b(lane), indices_[lane]};
        }
        collected_ = 0;
    }

    bool first_;
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

TrianglePair g_seed{~0U, ~0U};
Gap distance(const PlacedPair& pair, double upper_bound) {
    const std::uint64_t exact_before = exact_signs();
    NearestPairFinder finder(pair, upper_bound * upper_bound, false);
    if (g_seed.a != ~0U) {
        const auto tri = [](const ModelData& m, std::uint32_t t, const Transform& w) {
            const auto& x = m.mesh().triangles[t];
            return Triangle{apply(w, m.mesh().positions[x[0]]), apply(w, m.mesh().positions[x[1]]),
                            apply(w, m.mesh().positions[x[2]])};
        };
        finder.seed(tri(pair.a(), g_seed.a, pair.world_from_a()),
                    tri(pair.b(), g_seed.b, pair.world_from_b()), g_seed);
    }
    PairTraversal traversal = pair.traversal(finder.best_sq());
    traverse_nearest(traversal, finder);
    finder.finish();
    Gap gap;
    if (finder.found()) {
        gap = finder.gap();
    } else {
        gap.distance = upper_bound;
        gap.status = Status::bound_only;
    }
    gap.counters = {traversal.volume_tests, traversal.primitive_tests,
                    exact_signs() - exact_before};
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
    NearestPairFinder finder(pair, tolerance * tolerance, true);
    PairTraversal traversal = pair.traversal(tolerance * tolerance);
    if (traverse_within(traversal, finder) != Verdict::done)
        return true;
    finder.finish();
    return finder.found();
}

} // namespace abut
