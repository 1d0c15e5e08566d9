#include "world/schedule/deforming_impact.h"

#include <abut/deformable.h>

#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "rigid/motion/impact_steps.h"
#include "rigid/motion/motion_bounds.h"
#include "rigid/solid/containment.h"
#include "world/narrow_phase/narrow_phase.h"
#include "world/narrow_phase/offset_surface.h"
#include "world/schedule/deforming_pair.h"
#include "world/schedule/half_space_impact.h"
#include "world/schedule/surface_impact.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

namespace abut {

namespace {

constexpr double kNoContact = std::numeric_limits<double>::infinity();

double diagonal(const Box3& box) {
    return length(box.upper - box.lower);
}
Box3 united(Box3 a, const Box3& b) {
    extend(a, b.lower), extend(a, b.upper);
    return a;
}

/// Restricts a range within [0, 1] to the shares of time at which a quantity is not above 0. The
/// quantity changes linearly from `start` to `end`. The range is slightly enlarged for rounding.
/// Returns false if nothing is left.
bool keep_below_zero(double start, double end, TimeRange& shares) {
    constexpr double kMore = 0x1p-40;
    const double zero = start / (start - end);
    if (start > 0)
        shares.begin = end > 0 ? kNoContact : std::max(shares.begin, zero - kMore);
    else if (end > 0)
        shares.end = std::min(shares.end, zero + kMore);
    return shares.begin <= shares.end;
}

/// The part of a time range in which a moving box overlaps a fixed one. The moving box's bounds
/// change linearly from `start` to `end` during the range.
std::optional<TimeRange> overlap_time(const Box3& start, const Box3& end, const Box3& other,
                                      const TimeRange& range) {
    TimeRange shares;
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = component(other.lower, axis), upper = component(other.upper, axis);
        if (!keep_below_zero(component(start.lower, axis) - upper,
                             component(end.lower, axis) - upper, shares) ||
            !keep_below_zero(lower - component(start.upper, axis),
                             lower - component(end.upper, axis), shares))
            return std::nullopt;
    }
    const double length = range.end - range.begin;
    return TimeRange{range.begin + shares.begin * length, range.begin + shares.end * length};
}

/// Finds the earliest contact of a deformable surface and a rigid body that do not touch at the
/// start.
class DeformingSearch {
public:
    DeformingSearch(const DeformingPair& pair, const ImpactOptions& options)
        : pair_(pair), tree_a_(pair.tree_a()), tree_b_(pair.tree_b()),
          asked_tolerance_(options.absolute_error.value_or(kImpactTolerance * pair.size())),
          tolerance_(std::max(asked_tolerance_, 4 * pair.margin())), steps_(options) {}

    Impact run() {
        if (!tree_a_.empty() && !tree_b_.empty())
            keep_if_near({{0, 1}, kRootName, kRootName});
        while (!queue_.empty() && queue_.front().range.begin <= found_.time) {
            std::pop_heap(queue_.begin(), queue_.end(), Later{});
            const Waiting pair = queue_.back();
            queue_.pop_back();
            is_refused_ = !steps_.take(pair.range.begin);
            if (!is_refused_)
                open(pair);
            if (is_refused_)
                return with_counts(out_of_steps(pair.range.begin));
        }
        return with_counts(impact());
    }

private:
    /// Maximum number of steps for two triangles. A pair that reaches it is reported as a hit, to
    /// be safe.
    static constexpr int kMostSteps = 1000;
    /// Shorter time ranges are not halved.
    static constexpr double kShortestRange = 0x1p-12;

    /// Two boxes, given by their names, and the time range in which they may meet.
    struct Waiting {
        TimeRange range;
        std::uint32_t a, b;
    };
    /// Orders by the earliest range. For equal ranges, the pair deeper in the trees comes first.
    struct Later {
        bool operator()(const Waiting& x, const Waiting& y) const {
            // The root's name is the largest number; adding one makes it 0.
            return std::tuple(x.range.begin, x.range.end, y.a + 1, y.b + 1) >
                   std::tuple(y.range.begin, y.range.end, x.a + 1, x.b + 1);
        }
    };
    /// Two triangles that come near each other. b is given by its slot.
    struct Found {
        double time = kNoContact;
        std::uint32_t a = 0, b = 0;
        ClosestPoints closest{};
        double speed = 0; ///< estimated closing speed
    };

    /// Queues a pair for the time in which its boxes overlap.
    void keep_if_near(const Waiting& pair) {
        ++counters_.volume_tests;
        const TimeRange& range = pair.range;
        const auto near =
            overlap_time(pair_.box_a(pair.a, range.begin), pair_.box_a(pair.a, range.end),
                         pair_.box_b(pair.b, range), range);
        if (!near || near->begin > found_.time)
            return;
        queue_.push_back({*near, pair.a, pair.b});
        std::push_heap(queue_.begin(), queue_.end(), Later{});
    }

    /// Replaces a pair of boxes by two halves of its time range, or by the pairs below it.
    void open(const Waiting& pair) {
        const NodeRef a = tree_a_.named(pair.a), b = tree_b_.named(pair.b);
        if (a.is_leaf() && b.is_leaf()) {
            open_leaves(a, b, pair.range);
            return;
        }
        const TimeRange& range = pair.range;
        const Box3 start_a = pair_.box_a(pair.a, range.begin),
                   start_b = pair_.box_b(pair.b, {range.begin, range.begin});
        const double size_a = diagonal(start_a), size_b = diagonal(start_b);
        const double moved =
            std::max(diagonal(united(start_a, pair_.box_a(pair.a, range.end))) - size_a,
                     diagonal(pair_.box_b(pair.b, range)) - size_b);
        if (moved > std::max(size_a, size_b) && range.end - range.begin > kShortestRange) {
            const double middle = 0.5 * (range.begin + range.end);
            keep_if_near({{range.begin, middle}, pair.a, pair.b});
            keep_if_near({{middle, range.end}, pair.a, pair.b});
            return;
        }
        if (!a.is_leaf() && (b.is_leaf() || size_a >= size_b)) {
            for_each_child(tree_a_.nodes[a.index()], a.index(), [&](std::uint32_t child) {
                keep_if_near({range, child, pair.b});
            });
        } else {
            for_each_child(tree_b_.nodes[b.index()], b.index(), [&](std::uint32_t child) {
                keep_if_near({range, pair.a, child});
            });
        }
    }
    template <typename AnyNode, typename Visit>
    static void for_each_child(const AnyNode& node, std::uint32_t index, const Visit& visit) {
        for (std::uint32_t lane = 0; lane < AnyNode::kWidth && !node.child[lane].is_none(); ++lane)
            visit(child_name(index, lane));
    }

    void open_leaves(NodeRef a, NodeRef b, const TimeRange& range) {
        for (const std::uint32_t triangle : pair_.triangles_a(a))
            for (std::uint32_t slot = b.first(); slot < b.first() + b.count(); ++slot)
                advance(triangle, slot, range);
    }

    /// Advances two triangles in time while they are certainly apart.
    void advance(std::uint32_t triangle, std::uint32_t slot, const TimeRange& range) {
        Found pair{range.begin, triangle, slot, {}, 0};
        for (int step = 0; pair.time <= std::min(range.end, found_.time); ++step) {
            is_refused_ = !steps_.take(range.begin);
            if (is_refused_)
                return;
            ++counters_.primitive_tests;
            const Triangle a = pair_.triangle_a(triangle, pair.time),
                           b = pair_.triangle_b(slot, pair.time);
            pair.closest = triangle_triangle_distance(a, b);
            const double gap = gap_of(pair);
            const double free =
                pair_.free_time(triangle, a, b, pair.closest, pair.time, tolerance_);
            if (gap <= tolerance_ || step == kMostSteps) {
                keep(pair);
                return;
            }
            pair.speed = gap / free;
            pair.time += free;
        }
    }
    [[nodiscard]] double gap_of(const Found& pair) const {
        return std::sqrt(pair.closest.distance_sq) - pair_.radius();
    }
    void keep(const Found& pair) {
        const auto key = [](const Found& p) { return std::tuple(p.time, p.a, p.b); };
        if (key(pair) < key(found_))
            found_ = pair;
    }

    [[nodiscard]] Impact with_counts(Impact impact) const {
        impact.counters = counters_;
        impact.steps = steps_.count();
        return impact;
    }

    [[nodiscard]] Impact impact() const {
        Impact impact;
        if (found_.time == kNoContact)
            return impact;
        const Vec3 shift = pair_.shift(found_.time);
        impact.meet = true, impact.time = found_.time;
        impact.gap = std::max(gap_of(found_), 0.0);
        impact.normal = normalized_or_zero(found_.closest.b - found_.closest.a);
        impact.point_a = found_.closest.a + shift;
        impact.point_b = found_.closest.b - pair_.radius() * impact.normal + shift;
        impact.triangle_a = found_.a, impact.triangle_b = pair_.number_b(found_.b);
        impact.contact_time = contact_time();
        impact.status = !(impact.contact_time < kNoContact) ? Status::bound_only
                        : impact.gap <= asked_tolerance_    ? Status::exact
                                                            : Status::converged;
        return impact;
    }
    /// A time at which the two triangles meet, if they do so about when expected.
    [[nodiscard]] double contact_time() const {
        const double expected = found_.speed > 0 ? tolerance_ / found_.speed : 0;
        for (const double part : {0.0, 1.0, 2.0, 4.0, 16.0}) {
            const double time = std::min(1.0, found_.time + part * expected);
            if (pair_.meet(found_.a, found_.b, time))
                return time;
        }
        return kNoContact;
    }

    const DeformingPair& pair_;
    const MovingTree& tree_a_;
    const Tree& tree_b_;
    double asked_tolerance_, tolerance_;
    ImpactSteps steps_;
    bool is_refused_ = false;    ///< whether the step limit refused a step
    std::vector<Waiting> queue_; ///< a heap
    Found found_;
    Counters counters_;
};

const Deformable* deformable_of(const MovingBody& body) {
    const auto* shape = std::get_if<DeformableShape>(&body.shape);
    return shape != nullptr ? shape->surface.get() : nullptr;
}

/// The impact of bodies that already share a point at the start; none if they do not.
std::optional<Impact> impact_at_start(const MovingBody& a, const MovingBody& b) {
    const Transform world_from_a = a.motion.start, world_from_b = b.motion.start;
    PairWarmStart warm_start;
    if (!touch({a.shape, world_from_a}, {b.shape, world_from_b}, warm_start))
        return std::nullopt;
    const BodyGap gap =
        gap_between({a.shape, world_from_a}, {b.shape, world_from_b}, 0, Depths::no, warm_start);
    Impact impact;
    impact.meet = true;
    impact.time = impact.contact_time = impact.gap = 0;
    impact.point_a = gap.point_a, impact.point_b = gap.point_b;
    impact.triangle_a = gap.triangle_a, impact.triangle_b = gap.triangle_b;
    return impact;
}

/// The impact at the start of a surface of which a component lies in the polyhedron around a curved
/// shape, outside of the shape. It may meet the shape without crossing the polyhedron's faces.
std::optional<Impact> impact_in_polyhedron(const MovingBody& surface, const MovingBody& curved) {
    const Model& model = std::get<DeformableShape>(surface.shape).snapshot->model();
    const OffsetSurface around = offset_surface_of(curved.shape);
    const Transform world_from_curved = curved.motion.start;
    if (!any_component_inside(PlacedSolid(model, model.data().solid(), {}),
                              PlacedSolid(around.surface, around.surface.data().solid(),
                                          compose(world_from_curved, around.body_from_surface))))
        return std::nullopt;
    PairWarmStart warm_start;
    const BodyGap gap = gap_between({surface.shape, {}}, {curved.shape, world_from_curved},
                                    kNoContact, Depths::no, warm_start);
    Impact impact;
    impact.meet = true, impact.time = 0, impact.gap = std::max(gap.distance, 0.0);
    impact.contact_time = kNoContact, impact.status = Status::bound_only;
    impact.point_a = gap.point_a, impact.point_b = gap.point_b, impact.normal = gap.normal;
    impact.triangle_a = gap.triangle_a;
    return impact;
}

} // namespace

Impact deforming_impact(const MovingBody& a, const MovingBody& b, const ImpactOptions& options) {
    if (const auto impact = impact_at_start(a, b))
        return *impact;
    const Deformable *surface_a = deformable_of(a), *surface_b = deformable_of(b);
    if (surface_a != nullptr && surface_b != nullptr)
        return surface_impact(*surface_a, *surface_b);
    const auto with_rigid = [&](const MovingBody& soft, const MovingBody& body) {
        const Deformable& surface = *deformable_of(soft);
        if (is_half_space(body.shape))
            return half_space_impact(surface, body, options);
        const bool is_curved = std::holds_alternative<CurvedShape>(body.shape);
        if (is_curved)
            if (const auto impact = impact_in_polyhedron(soft, body))
                return *impact;
        Impact impact = DeformingSearch(DeformingPair(surface.data(), body), options).run();
        if (is_curved && impact.meet)
            // The polyhedron around the shape was met, not the shape.
            impact.contact_time = kNoContact, impact.status = Status::bound_only;
        return impact;
    };
    return surface_a != nullptr ? with_rigid(a, b) : turned_round(with_rigid(b, a));
}

} // namespace abut
