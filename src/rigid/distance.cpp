#include <abut/error.h>
#include <abut/rigid.h>

#include "core/arguments.h"
#include "geometry/leaf/triangle_pair_batch.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/pair/placed_pair.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/signed_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// The allowed excess of a distance over the true one.
struct Slack {
    double absolute = 0, relative = 0;

    [[nodiscard]] bool any() const { return absolute > 0 || relative > 0; }
    /// Pairs nearer than `distance` matter only if nearer than this: d - error(d), at least 0.
    [[nodiscard]] double least_of_interest(double distance) const {
        return std::max(0.0, distance - std::max(absolute, relative * distance));
    }
};

/// Rounds a distance down to a proven lower bound. The distance was computed for a pair of models,
/// or is the bound within which a search has found nothing.
///
/// Accuracy    certified. TrianglePairBatch says by how much a measured distance exceeds the true
///             one. `reach` bounds its sizes: no two points of the models are farther apart, so no
///             two vertices of different models are, and no edge is longer than twice that.
double rounded_down(double distance, double reach) {
    const double error = kTrianglePairError * 5 * reach + kTrianglePairUnderflow;
    const double bound = (distance - error) * (1 - 0x1p-50);
    return bound > 0 ? bound : 0; // also if the reach, squared, is not a number
}

/// Keeps the nearest pair of triangles below the bound. A contact ends the search with distance 0.
/// Pairs that cheap bounds do not rule out are collected and measured in batches of eight.
class NearestPairFinder : public LeafPairVisitor {
public:
    /// `first`: stop at the first pair within the bound. `slack`: by how much the answer may exceed
    /// the distance.
    NearestPairFinder(const PlacedPair& pair, double bound_sq, bool first, const Slack& slack = {})
        : first_(first), pair_(pair), leaves_(pair), slack_(slack), best_sq_(bound_sq) {}

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
            return kStopTraversal;
        for_each_pair(pairs.may_meet | pairs.may_be_near, [&](auto i, auto j) {
            block_.set(collected_, leaves_.a(i), leaves_.b(j));
            indices_[collected_] = leaves_.indices(i, j);
            if (++collected_ == TrianglePairBatch::kLanes)
                measure();
            return true;
        });
        return found_ && first_ ? kStopTraversal : bound_sq();
    }

    [[nodiscard]] Vec3 direction() const override {
        if (!found_)
            return {};
        const ClosestPoints points = triangle_triangle_distance(best_.a, best_.b);
        return normalized_or_zero(points.b - points.a);
    }

    /// Begins with a remembered pair of triangles. Returns whether it completes the search.
    bool begin_with(const TrianglePair& last) {
        if (!pair_.has(last))
            return false;
        const Candidate candidate{pair_.triangle_a(last.a), pair_.triangle_b(last.b), last};
        const double sq = triangle_triangle_distance(candidate.a, candidate.b).distance_sq;
        contact_ = sq == 0 &&
                   triangle_triangle_intersect(candidate.a, candidate.b) != TriangleContact::none;
        if (contact_ || sq < best_sq_ || (first_ && sq <= best_sq_))
            best_ = candidate, best_sq_ = sq, found_ = true;
        return contact_ || (found_ && first_);
    }

    /// Squared distance beyond which pairs do not matter.
    [[nodiscard]] double bound_sq() const {
        if (!found_ || !slack_.any())
            return best_sq_;
        const double bound = slack_.least_of_interest(std::sqrt(best_sq_));
        return bound * bound;
    }

    /// Measures the remaining pairs. Call it after the traversal.
    void finish() {
        if (!contact_)
            measure();
    }

    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] const TrianglePair& indices() const { return best_.indices; }
    /// The squared distance as it was compared with others.
    [[nodiscard]] double measured_sq() const { return best_sq_; }
    void report(Gap& gap) const {
        if (!found_)
            return;
        const ClosestPoints points = triangle_triangle_distance(best_.a, best_.b);
        // Surfaces that are apart by less than rounding are still apart.
        gap.distance =
            contact_ ? 0
                     : std::max(std::sqrt(points.distance_sq), std::numeric_limits<double>::min());
        gap.point_a = points.a, gap.point_b = points.b;
        gap.triangle_a = best_.indices.a, gap.triangle_b = best_.indices.b;
        gap.feature_a = points.on_a.kind, gap.index_a = points.on_a.index;
        gap.feature_b = points.on_b.kind, gap.index_b = points.on_b.index;
    }

private:
    struct Candidate {
        Triangle a, b;
        TrianglePair indices;
    };

    void measure() {
        if (collected_ == 0)
            return;
        // Unused lanes are measured too, and ignored.
        double lanes_sq[TrianglePairBatch::kLanes];
        distance_sq(block_, lanes_sq);
        for (std::size_t lane = 0; lane < collected_; ++lane) {
            // Of equal distances the smallest triangle pair wins, so that the result does not
            // depend on the order.
            const double sq = lanes_sq[lane];
            if (sq < best_sq_ ||
                (sq == best_sq_ && (found_ ? indices_[lane] < best_.indices : first_))) {
                found_ = true;
                best_sq_ = sq;
                best_ = {block_.get_a(lane), block_.get_b(lane), indices_[lane]};
            }
        }
        collected_ = 0;
    }

    bool first_;
    const PlacedPair& pair_;
    LeafTriangles leaves_;
    Slack slack_;
    double best_sq_;
    bool found_ = false, contact_ = false;
    Candidate best_;
    TrianglePairBatch block_{};
    std::array<TrianglePair, TrianglePairBatch::kLanes> indices_;
    std::size_t collected_ = 0;
};

Gap gap_beyond(double bound, double at_least) {
    Gap gap;
    gap.distance = bound;
    gap.at_least = at_least;
    gap.status = Status::bound_only;
    return gap;
}

} // namespace

Gap distance(const PlacedPair& pair, const DistanceOptions& options) {
    const std::uint64_t exact_before = exact_signs();
    const Slack slack{options.absolute_error, options.relative_error};
    NearestPairFinder finder(pair, options.upper_bound * options.upper_bound, false, slack);
    WarmStart* const warm_start = options.warm_start;
    Counters counters;
    SearchSteps steps;
    double left_sq = std::numeric_limits<double>::infinity();
    if (warm_start == nullptr || !warm_start->used || !finder.begin_with(warm_start->last)) {
        PairTraversal traversal = pair.traversal(finder.bound_sq());
        if (options.max_steps)
            traversal.steps = SearchSteps(*options.max_steps);
        pair.visit_nearest(traversal, finder);
        finder.finish();
        counters.volume = pair.volume();
        counters.volume_tests = traversal.volume_tests;
        counters.primitive_tests = traversal.primitive_tests;
        steps = traversal.steps;
        left_sq = traversal.left_sq;
    }
    const double reach = pair.reach();
    Gap gap;
    finder.report(gap);
    // The reported distance is computed anew, and differs from the compared one by rounding.
    if (!finder.found() || (gap.distance > 0 && gap.distance >= options.upper_bound)) {
        gap = gap_beyond(options.upper_bound, rounded_down(options.upper_bound, reach));
    } else {
        const double least = std::min(gap.distance, std::sqrt(finder.measured_sq()));
        gap.at_least = rounded_down(slack.least_of_interest(least), reach);
        if (slack.any() && gap.distance > 0)
            gap.status = Status::converged;
        if (warm_start != nullptr)
            *warm_start = {true, {gap.triangle_a, gap.triangle_b}};
    }
    gap.steps = steps.count();
    if (steps.ran_out()) {
        gap.out_of_steps = true;
        gap.status = Status::bound_only;
        gap.at_least = std::min(gap.at_least, rounded_down(std::sqrt(left_sq), reach));
    }
    counters.exact_tests = exact_signs() - exact_before;
    gap.counters = counters;
    return gap;
}

MeasuredGap nearest_gap(const PlacedPair& pair, double bound_sq) {
    NearestPairFinder finder(pair, bound_sq, false);
    PairTraversal traversal = pair.traversal(bound_sq);
    pair.visit_nearest(traversal, finder);
    finder.finish();
    MeasuredGap result;
    if (finder.found()) {
        finder.report(result.gap);
        result.measured_sq = finder.measured_sq();
    }
    return result;
}

Gap distance(const Model& a, const Transform& world_from_a, const Model& b,
             const Transform& world_from_b, const DistanceOptions& options) {
    require_not_negative(options.upper_bound, "distance bound");
    require_not_negative(options.absolute_error, "absolute error");
    require_not_negative(options.relative_error, "relative error");
    const StopScope stopping(options.progress);
    if (options.signed_distance)
        return signed_gap(a, world_from_a, b, world_from_b, options);
    if (std::isfinite(options.upper_bound) &&
        far_apart(a.data(), world_from_a, b.data(), world_from_b, options.upper_bound))
        return gap_beyond(options.upper_bound, options.upper_bound);
    return distance(PlacedPair(a, world_from_a, b, world_from_b), options);
}

bool within(const Model& a, const Transform& world_from_a, const Model& b,
            const Transform& world_from_b, double tolerance, const WithinOptions& options) {
    WarmStart* const warm_start = options.warm_start;
    require_not_negative(tolerance, "tolerance");
    const StopScope stopping(options.progress);
    if (tolerance == 0) // collide is exact, a distance is not
        return collide(a, world_from_a, b, world_from_b, {.warm_start = warm_start}).meet();
    if (far_apart(a.data(), world_from_a, b.data(), world_from_b, tolerance))
        return false;
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    NearestPairFinder finder(pair, tolerance * tolerance, true);
    if (warm_start != nullptr && warm_start->used && finder.begin_with(warm_start->last))
        return true;
    PairTraversal traversal = pair.traversal(tolerance * tolerance);
    if (pair.visit_within(traversal, finder) == Verdict::accepted)
        return true;
    finder.finish();
    if (warm_start != nullptr && finder.found())
        *warm_start = {true, finder.indices()};
    return finder.found();
}

} // namespace abut
