#include <abut/error.h>
#include <abut/rigid.h>

#include "core/arguments.h"
#include "geometry/leaf/triangle_pair_batch.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/pair/gap_search.h"
#include "rigid/pair/placed_pair.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/signed_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace abut {

namespace {

/// Bounds the error of a measured distance of two models. `reach` bounds its sizes: no two points of the
/// models are farther apart, so no two vertices of different models are, and no edge is longer than
/// twice that.
double measuring_error(double reach) {
    return kTrianglePairError * 5 * reach + kTrianglePairUnderflow;
}

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
///             one.
double rounded_down(double distance, double reach) {
    const double bound = (distance - measuring_error(reach)) * (1 - 0x1p-50);
    return bound > 0 ? bound : 0; // also if the reach, squared, is not a number
}

/// What a search is for, which decides what it may leave out.
enum class Goal : std::uint8_t {
    nearest, ///< a distance that is right to rounding, and one pair that has it
    first,   ///< whether a pair is within the bound, to rounding
    least,   ///< of the pairs with the least measured distance, the one with the smallest indices
};

/// Keeps the nearest pair of triangles below the bound. A contact ends the search with distance 0.
/// Pairs that cheap bounds do not rule out are collected and measured in batches of eight.
///
/// From time to time the visitor looks across the gap, along the closest points measured so far. If no
/// vertex lies between the two planes there, the search has ended, whatever pairs are left: this is so
/// where faces look at each other, and where triangles coincide.
class NearestPairFinder : public GapVisitor {
public:
    /// `slack`: by how much the answer may exceed the distance.
    NearestPairFinder(const PlacedPair& pair, double bound_sq, Goal goal, const Slack& slack = {})
        : goal_(goal), pair_(pair), leaves_(pair), slack_(slack), reach_(pair.reach()),
          triangles_(pair.a().mesh().triangles.size() + pair.b().mesh().triangles.size()),
          next_look_(std::max<std::uint64_t>(kFirstLook, vertices() / kVerticesAVisit)),
          best_sq_(bound_sq) {
        take_bound();
    }

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
        if ((found_ && goal_ == Goal::first) || (++visits_ >= next_look_ && look()))
            return kStopTraversal;
        return bound_sq();
    }

    [[nodiscard]] Vec3 direction() const override {
        if (!found_)
            return {};
        const ClosestPoints points = triangle_triangle_distance(best_.a, best_.b);
        return normalized_or_zero(points.b - points.a);
    }

    /// For Goal::nearest, also pairs that are as near as the nearest one, to a few roundings of the
    /// computed gap, if `Gap::at_least` is proven for them.
    [[nodiscard]] bool is_beyond(double computed, double sizes) const override {
        switch (goal_) {
        case Goal::first: // decided to rounding
            return computed > beyond_;
        case Goal::nearest: {
            // Where rounding is as large as the bound, a pair may still be nearer, or a contact.
            const double certain = certain_gap(computed, sizes);
            if (!(certain > 0))
                return false;
            const bool ties = sure_ > 0 && certain >= sure_ &&
                              computed >= beyond_ * (1 - 8 * kUnit) - 4 * kUnit * sizes;
            return ties || certain > beyond_;
        }
        default: // a pair may be measured as nearer than it is
            return certain_gap(computed, sizes) - measuring_error(reach_) > beyond_;
        }
    }

    /// Begins with a remembered pair of triangles. Returns whether it completes the search.
    bool begin_with(const TrianglePair& last) {
        if (!pair_.has(last))
            return false;
        const Candidate candidate{pair_.triangle_a(last.a), pair_.triangle_b(last.b), last};
        const double sq = triangle_triangle_distance(candidate.a, candidate.b).distance_sq;
        contact_ = sq == 0 &&
                   triangle_triangle_intersect(candidate.a, candidate.b) != TriangleContact::none;
        if (contact_ || sq < best_sq_ || (goal_ == Goal::first && sq <= best_sq_))
            take(candidate, sq);
        return contact_ || (found_ && goal_ == Goal::first);
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
    /// Whether the traversal was stopped because it hardly drops any pair. The search is to be continued
    /// by search_gap, in the frame `across`.
    [[nodiscard]] bool is_hard() const { return hard_; }
    [[nodiscard]] GapFrame across() const {
        if (closest_sq_ < std::numeric_limits<double>::infinity())
            return GapFrame::between(best_.a, best_.b);
        const Vec3 from = pair_.a().world_slot(0, pair_.world_from_a())[0],
                   to = pair_.b().world_slot(0, pair_.world_from_b())[0];
        return {from, to - from};
    }
    /// Call it before search_gap: there is no other way left to search.
    void search_to_the_end() {
        hard_ = false;
        next_look_ = std::numeric_limits<std::uint64_t>::max();
    }
    /// So many steps of a traversal are more than a search needs whose bounds drop pairs.
    [[nodiscard]] std::uint64_t most_steps() const { return 4 * triangles_ + 1024; }

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
    /// The first look, and by how much later each further one is. A look costs about as much as a visit
    /// for so many vertices, so it comes when as much was done.
    static constexpr std::uint64_t kFirstLook = 64, kLater = 4, kVerticesAVisit = 256;
    /// search_gap first takes as long as a visit for so many triangles.
    static constexpr std::uint64_t kTrianglesAVisit = 8;
    /// Single precision hides lateral distances of some 2e-3 of a gap, see search_gap. It hides whole
    /// triangles where gaps are so many times as long as their edges.
    static constexpr double kFar = 100;
    static constexpr double kUnit = 0x1p-53; ///< the largest relative error of one rounding

    struct Candidate {
        Triangle a, b;
        TrianglePair indices;
    };

    [[nodiscard]] std::size_t vertices() const {
        return pair_.a().mesh().positions.size() + pair_.b().mesh().positions.size();
    }

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
            if (sq < best_sq_ || (sq == best_sq_ &&
                                  (found_ ? indices_[lane] < best_.indices : goal_ == Goal::first)))
                take({block_.get_a(lane), block_.get_b(lane), indices_[lane]}, sq);
            else if (!found_ && sq < closest_sq_)
                // Not within the bound, but it shows where to look across the gap.
                best_ = {block_.get_a(lane), block_.get_b(lane), indices_[lane]}, closest_sq_ = sq;
        }
        collected_ = 0;
    }

    void take(const Candidate& candidate, double sq) {
        found_ = true;
        best_ = candidate;
        best_sq_ = closest_sq_ = sq;
        take_bound();
    }

    /// Sets what is_beyond compares with.
    void take_bound() {
        beyond_ = std::sqrt(bound_sq());
        sure_ = rounded_down(beyond_, reach_);
    }

    /// Looks across the gap. Returns whether the traversal is to be stopped: the search has ended, or is
    /// hard.
    bool look() {
        if (collected_ > 0 && closest_sq_ == std::numeric_limits<double>::infinity())
            measure();
        const bool all_ties = found_ && goal_ == Goal::least;
        if (!all_ties && closest_sq_ > 0 && nothing_between())
            return true;
        const std::uint64_t early = triangles_ / kTrianglesAVisit;
        hard_ = visits_ >= 8 * triangles_ || (visits_ >= early && is_far());
        next_look_ = visits_ < early ? std::min(kLater * visits_, early) : kLater * visits_;
        return hard_;
    }

    /// Whether no vertex lies between the planes through the closest points that would be needed for a
    /// nearer pair. For Goal::first, takes a pair whose distance is the bound to rounding if no pair is
    /// nearer than that.
    bool nothing_between() {
        constexpr double kRounding = 16 * kUnit;
        const GapFrame frame = across();
        double least_of_b = std::numeric_limits<double>::infinity();
        for (const Vec3& vertex : best_.b)
            least_of_b = std::min(least_of_b, frame.height(vertex));
        // The vertices of a are within 2 reach_ of one another, and within reach_ of those of b.
        const double sizes = 3 * reach_;
        const bool at_bound =
            goal_ == Goal::first && std::sqrt(closest_sq_) <= beyond_ * (1 + kRounding);
        double gap = 0;
        const auto enough = [&](double computed) {
            gap = computed;
            return is_beyond(computed, sizes) ||
                   (at_bound && sure_ > 0 && certain_gap(computed, sizes) >= sure_);
        };
        if (!are_apart_along(pair_, frame, least_of_b, enough))
            return false;
        if (at_bound && !is_beyond(gap, sizes))
            found_ = true;
        return true;
    }

    /// Whether the gap is many times as long as an edge of the closest triangles.
    [[nodiscard]] bool is_far() const {
        double edge_sq = 0;
        for (const Triangle& t : {best_.a, best_.b})
            for (std::size_t i = 0; i < 3; ++i)
                edge_sq = std::max(edge_sq, length_sq(t[(i + 1) % 3] - t[i]));
        return closest_sq_ < std::numeric_limits<double>::infinity() &&
               closest_sq_ > kFar * kFar * edge_sq;
    }

    Goal goal_;
    const PlacedPair& pair_;
    LeafTriangles leaves_;
    Slack slack_;
    double reach_;
    std::uint64_t triangles_, visits_ = 0, next_look_;
    double best_sq_;               ///< the bound, or that of `best_` if one was found
    double beyond_ = 0, sure_ = 0; ///< the root of bound_sq(), and a proven bound below it
    bool found_ = false, contact_ = false, hard_ = false;
    Candidate best_; ///< if none was found: the closest that was measured, if any
    double closest_sq_ = std::numeric_limits<double>::infinity(); ///< of `best_`
    TrianglePairBatch block_{};
    std::array<TrianglePair, TrianglePairBatch::kLanes> indices_;
    std::size_t collected_ = 0;
};

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// How a search ended.
struct Searched {
    Verdict verdict = Verdict::done;
    std::uint64_t steps = 0;
};

/// Searches a pair of models: `traverse` first, and where that hardly drops any pair, search_gap.
template <typename Traverse>
Searched search(PairTraversal& traversal, const PlacedPair& pair, NearestPairFinder& finder,
                std::uint64_t most_steps, const Traverse& traverse) {
    const std::uint64_t at_first = std::min(most_steps, finder.most_steps());
    traversal.steps = SearchSteps(at_first);
    const Verdict verdict = traverse(traversal, finder);
    const std::uint64_t steps = traversal.steps.count();
    const bool goes_on = traversal.steps.ran_out() ? at_first < most_steps : finder.is_hard();
    if (!goes_on)
        return {verdict, steps};
    finder.finish();
    finder.search_to_the_end();
    traversal.left_sq = std::numeric_limits<double>::infinity();
    traversal.steps = SearchSteps(most_steps - steps);
    const Verdict rest = search_gap(pair, finder.across(), traversal, finder);
    return {rest, steps + traversal.steps.count()};
}

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
    NearestPairFinder finder(pair, options.upper_bound * options.upper_bound, Goal::nearest, slack);
    WarmStart* const warm_start = options.warm_start;
    Counters counters;
    Searched searched;
    double left_sq = std::numeric_limits<double>::infinity();
    if (warm_start == nullptr || !warm_start->used || !finder.begin_with(warm_start->last)) {
        PairTraversal traversal = pair.traversal(finder.bound_sq());
        searched = search(traversal, pair, finder, options.max_steps.value_or(kNoLimit),
                          [&](auto& t, auto& visitor) { return pair.visit_nearest(t, visitor); });
        finder.finish();
        counters.volume = pair.volume();
        counters.volume_tests = traversal.volume_tests;
        counters.primitive_tests = traversal.primitive_tests;
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
    gap.steps = searched.steps;
    if (searched.verdict == Verdict::out_of_steps) {
        gap.out_of_steps = true;
        gap.status = Status::bound_only;
        gap.at_least = std::min(gap.at_least, rounded_down(std::sqrt(left_sq), reach));
    }
    counters.exact_tests = exact_signs() - exact_before;
    gap.counters = counters;
    return gap;
}

MeasuredGap nearest_gap(const PlacedPair& pair, double bound_sq) {
    NearestPairFinder finder(pair, bound_sq, Goal::least);
    PairTraversal traversal = pair.traversal(bound_sq);
    search(traversal, pair, finder, kNoLimit,
           [&](auto& t, auto& visitor) { return pair.visit_nearest(t, visitor); });
    finder.finish();
    MeasuredGap result;
    result.gap.counters.volume_tests = traversal.volume_tests;
    result.gap.counters.primitive_tests = traversal.primitive_tests;
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
    NearestPairFinder finder(pair, tolerance * tolerance, Goal::first);
    if (warm_start != nullptr && warm_start->used && finder.begin_with(warm_start->last))
        return true;
    PairTraversal traversal = pair.traversal(tolerance * tolerance);
    if (search(traversal, pair, finder, kNoLimit, [&](auto& t, auto& visitor) {
            return pair.visit_within(t, visitor);
        }).verdict == Verdict::accepted)
        return true;
    finder.finish();
    if (warm_start != nullptr && finder.found())
        *warm_start = {true, finder.indices()};
    return finder.found();
}

} // namespace abut
