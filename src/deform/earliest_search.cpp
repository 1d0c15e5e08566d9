#include "deform/earliest_search.h"

#include "ccd/elementary_filter.h"
#include "core/set_bits.h"
#include "deform/candidate_search.h"
#include "deform/impact_collector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace abut {

namespace {

/// Bounds how far a computed time may be below the first contact.
constexpr double kTimeError = 0x1p-29;

/// The largest coordinate of a surface's boxes at both ends.
double largest_coordinate(const MovingTree& tree) {
    const MovingBox box = moving_tree::bounds_of(tree.nodes[0]);
    double largest = 0;
    for (const StepEnd end : kStepEnds)
        for (const auto& side : {box.at(end).lower, box.at(end).upper})
            for (const float bound : side)
                largest = std::max(largest, std::abs(double{bound}));
    return largest;
}

/// See ElementaryOptions::thickness: at its computed time, an impact's features are at most this
/// far apart. Sizes of features are at most 2 `largest`.
double reach_of(const ElementaryOptions& options, double largest) {
    if (options.thickness == 0 && options.absolute_error == 0)
        return 0;
    return options.thickness +
           std::max({1e-6 * options.thickness, options.absolute_error, 12e-12 * largest});
}

/// A sink of pairs of one kind that passes on those that may meet within the window.
///
/// The pair's vertices are moved to their rounded positions at the window's end. Between two rounded
/// features, the filter then demands a gap that also covers the rounding.
template <ElementaryKind kind>
class WindowFilter {
public:
    WindowFilter(const DeformableData& a, const DeformableData& b, double least_gap,
                 const TimeWindow& window)
        : geometry_(a, b), least_gap_(least_gap), window_(window) {}

    /// Calls pass(ids) for pairs that have been added and may meet.
    template <typename Pass>
    void add(FeatureIds ids, bool wanted, const Pass& pass) {
        ids_[count_] = ids;
        count_ += wanted ? 1 : 0;
        if (count_ == ElementaryBatch::kLanes)
            flush(pass);
    }
    template <typename Pass>
    void flush(const Pass& pass) {
        const double end = window_.end();
        for (std::size_t lane = 0; lane < count_; ++lane) {
            const PairVertices vertices = geometry_.vertices(ids_[lane]);
            for (std::size_t i = 0; i < 4; ++i) {
                const MovingVertex& v = *vertices[i];
                batch_.set_vertex(lane, i, v.start, (1 - end) * v.start + end * v.end);
            }
        }
        const std::uint32_t used = (1U << count_) - 1;
        count_ = 0;
        if (used != 0)
            for (const std::size_t lane :
                 SetBits(possible_impacts(batch_, kind, least_gap_) & used))
                pass(ids_[lane]);
    }

private:
    PairGeometry<kind> geometry_;
    double least_gap_;
    const TimeWindow& window_;
    ElementaryBatch batch_;
    std::array<FeatureIds, ElementaryBatch::kLanes> ids_{};
    std::size_t count_ = 0;
};

/// Keeps the earliest impact and shortens the window.
struct EarliestKeeper {
    TimeWindow& window;
    EarliestImpact& earliest;

    void keep(const FeatureImpact& impact) {
        earliest.keep(impact);
        window.end_after(impact.time);
    }
    static bool is_done() { return false; }
};

/// A sink of pairs (see FeaturePairs) that tests those that may meet within the window.
class WindowCollector {
public:
    WindowCollector(const DeformableData& a, const DeformableData& b,
                    const ElementaryOptions& options, double least_gap, EarliestKeeper& keeper)
        : window_(keeper.window), tests_(a, b, options, keeper), edges_(a, b, least_gap, window_),
          vertex_face_(a, b, least_gap, window_), face_vertex_(b, a, least_gap, window_) {}

    void add(PairKind kind, FeatureIds ids, bool wanted) {
        if (window_.end() == 1)
            tests_.add(kind, ids, wanted);
        else if (kind == PairKind::edges)
            edges_.add(ids, wanted, pass(kind));
        else
            (kind == PairKind::vertex_face ? vertex_face_ : face_vertex_)
                .add(ids, wanted, pass(kind));
    }
    static bool is_done() { return false; }
    /// Tests the pairs that still wait for a full batch.
    void finish() {
        edges_.flush(pass(PairKind::edges));
        vertex_face_.flush(pass(PairKind::vertex_face));
        face_vertex_.flush(pass(PairKind::face_vertex));
        tests_.finish();
    }

private:
    /// Hands on pairs of one kind.
    struct Pass {
        ImpactCollector<EarliestKeeper>& tests;
        PairKind kind;
        void operator()(FeatureIds ids) const { tests.add(kind, ids, true); }
    };
    Pass pass(PairKind kind) { return {tests_, kind}; }

    const TimeWindow& window_;
    ImpactCollector<EarliestKeeper> tests_;
    WindowFilter<ElementaryKind::edge_edge> edges_;
    WindowFilter<ElementaryKind::vertex_face> vertex_face_, face_vertex_;
};

/// Visits pairs of leaves until the window's end.
class WindowLeafPairs final : public UntilVisitor {
public:
    WindowLeafPairs(const LeafSource& a, const LeafSource& b, float margin,
                    FeaturePairs<WindowCollector>& pairs, const TimeWindow& window)
        : leaves_(a, b, margin, pairs), window_(window) {}

    [[nodiscard]] float until() const override { return window_.until(); }
    bool visit(std::uint32_t i, std::uint32_t j) override {
        leaves_.set_until(window_.until());
        return leaves_.visit(i, j);
    }

private:
    RepresentativePairs<WindowCollector> leaves_;
    const TimeWindow& window_;
};

} // namespace

void TimeWindow::end_after(double time) {
    const double end = std::min(time + kTimeError, 1.0);
    double before = end_.load(std::memory_order_relaxed);
    while (end < before)
        if (end_.compare_exchange_weak(before, end, std::memory_order_relaxed)) {
            before = end;
            break;
        }
    // Another thread may have stored an earlier end meanwhile; until() then only is too large.
    const float until = round_up(end);
    float last = until_.load(std::memory_order_relaxed);
    while (until < last && !until_.compare_exchange_weak(last, until, std::memory_order_relaxed)) {
    }
}

void EarliestImpact::keep(const FeatureImpact& other) {
    const auto key = [](const FeatureImpact& i) { return std::tuple(i.time, list_key(i)); };
    if (!impact || key(other) < key(*impact))
        impact = other;
}

EarliestSearch::EarliestSearch(const DeformableData& a, const DeformableData& b,
                               const ElementaryOptions& options)
    : a_(a), b_(b), options_(options), leaves_a_(a, a.swept),
      leaves_b_(b, b.swept), traversal_{a.swept.tree, b.swept.tree} {
    double largest = 0;
    for (const MovingTree* tree : {&a.swept.tree, &b.swept.tree})
        if (!tree->empty())
            largest = std::max(largest, largest_coordinate(*tree));
    // An interpolated coordinate is off by at most 8 units in the last place, so a distance by less
    // than 32 of them; or by a few of the least doubles.
    reach_ = reach_of(options, largest);
    slack_ = 0x1p-48 * largest + 0x1p-1060;
    traversal_.margin = margin_of(reach_);
    if (&a == &b && options.thickness == 0)
        traversal_.skipped = a.flat_regions.flat();
}

void EarliestSearch::run(std::span<const TimedPair> starts, TimeWindow& window,
                         EarliestImpact& earliest, std::vector<TimedPair>* later) const {
    EarliestKeeper keeper{window, earliest};
    WindowCollector collector(a_, b_, options_, reach_ + slack_, keeper);
    FeaturePairs<WindowCollector> pairs(a_, b_, collector);
    WindowLeafPairs visitor(leaves_a_, leaves_b_, traversal_.margin, pairs, window);
    for (const TimedPair& start : starts)
        traverse_until(traversal_, start, visitor, later);
    collector.finish();
}

} // namespace abut
