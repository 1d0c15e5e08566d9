#include <abut/error.h>
#include <abut/motion.h>

#include "geometry/triangle_pair_block.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/contacts.h"
#include "rigid/motion_bounds.h"
#include "rigid/moving_boxes.h"
#include "rigid/moving_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

constexpr double kEnd = 1; ///< of the time that is looked at
constexpr double kNever = std::numeric_limits<double>::infinity();
/// Default tolerance, of the larger model's diagonal.
constexpr double kTolerance = 1e-6;
/// How often pairs of triangles within the tolerance are followed, in all, before contact is
/// reported as possible.
constexpr int kMostFollowed = 4096;
/// Below this many times the margin for rounding, nothing is told from contact: twice, so that what
/// is left of larger gaps always moves the time on.
constexpr double kUndecided = 2;
/// Radians by which both together turn within a window: bounds hold for one, and are good for
/// turns this small.
constexpr double kMostTurn = 0.5;
/// A moment is used again while no point has moved farther than this share of a box's radius.
constexpr double kStale = 0.125;

/// Two boxes, or two triangles, that certainly do not meet before `time`.
struct Waiting {
    double time = 0;
    std::uint32_t a = 0, b = 0;
    bool triangles = false; ///< a and b are slots of triangles; else name boxes
    bool operator<(const Waiting& other) const { return time > other.time; }
};

TreeBox box_of(const Tree& tree, std::uint32_t name, double scale) {
    return name == kRootName ? root_box(tree, scale)
                             : child_box(tree.nodes[node_of(name)], lane_of(name), scale);
}

/// Advances all pairs in the order of the times before which they cannot meet.
class ImpactSearch {
public:
    ImpactSearch(const Model& a, const Model& b, const MovingPair& pair, double tolerance)
        : a_(a), b_(b), pair_(pair), tolerance_(std::max(tolerance, kUndecided * pair.margin)),
          window_(kMostTurn /
                  (pair.a.trajectory.speed_of_rotation() + pair.b.trajectory.speed_of_rotation())) {
    }

    Impact run() {
        for (double begin = 0; begin <= kEnd && !answered_; begin = next_begin_)
            search_from(begin);
        impact_.counters = counters_;
        return impact_;
    }

private:
    /// One window of time. What can only meet after it is not kept: the next window finds it again
    /// from the roots, in fewer pairs than the many small ones into which it was split here.
    void search_from(double begin) {
        window_end_ = std::min(kEnd, begin + window_);
        next_begin_ = kNever;
        waiting_.clear();
        push({begin, kRootName, kRootName, false});
        while (!waiting_.empty() && !answered_) {
            std::pop_heap(waiting_.begin(), waiting_.end());
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            if (next.triangles)
                advance(next);
            else
                open(next);
        }
    }

    void push(const Waiting& pair) {
        if (pair.time <= window_end_) {
            waiting_.push_back(pair);
            std::push_heap(waiting_.begin(), waiting_.end());
        } else {
            next_begin_ = std::min(next_begin_, pair.time);
        }
    }

    /// The moment of the time, or one before it that serves boxes of this size as well.
    const Moment& moment_for(double time, double radius) {
        if (moment_.time < 0 || (time - moment_.time) * pair_.speed > kStale * radius)
            moment_ = Moment(pair_, time);
        return moment_;
    }

    /// Replaces a pair of boxes by the pairs below it.
    void open(const Waiting& pair) {
        const NodeRef ref_a = a_.data().tree().named(pair.a),
                      ref_b = b_.data().tree().named(pair.b);
        const TreeBox tree_box_a = box_of(a_.data().tree(), pair.a, pair_.a.scale),
                      tree_box_b = box_of(b_.data().tree(), pair.b, pair_.b.scale);
        const double radius_a = tree_box_a.radius, radius_b = tree_box_b.radius;
        const Moment& now = moment_for(pair.time, std::min(radius_a, radius_b));
        const MovingBox box_a = box_of_a(pair_, now, tree_box_a),
                        box_b = box_of_b(pair_, now, tree_box_b);
        if (ref_a.is_leaf() && ref_b.is_leaf()) {
            open_leaves(pair, ref_a, ref_b, box_a, box_b);
            return;
        }
        const bool open_a = !ref_a.is_leaf() && (ref_b.is_leaf() || radius_a > radius_b);
        const std::uint32_t index = (open_a ? ref_a : ref_b).index();
        const Node& node = (open_a ? a_ : b_).data().tree().nodes[index];
        for (std::uint32_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i) {
            ++counters_.volume_tests;
            const TreeBox child = child_box(node, i, (open_a ? pair_.a : pair_.b).scale);
            const double free = open_a ? free_time(pair_, now, box_of_a(pair_, now, child), box_b,
                                                   window_end_ - now.time, kEnd - now.time)
                                       : free_time(pair_, now, box_a, box_of_b(pair_, now, child),
                                                   window_end_ - now.time, kEnd - now.time);
            const std::uint32_t name = child_name(index, i);
            push({std::max(pair.time, now.time + free), open_a ? name : pair.a,
                  open_a ? pair.b : name, false});
        }
    }

    void open_leaves(const Waiting& pair, NodeRef leaf_a, NodeRef leaf_b, const MovingBox& box_a,
                     const MovingBox& box_b) {
        // No direction is known yet: the approach is bounded by the speed in any.
        const double rate_a = pair_.a.trajectory.speed_of_rotation(),
                     rate_b = pair_.b.trajectory.speed_of_rotation();
        Approach approach;
        approach.closing =
            length(box_b.velocity - box_a.velocity) + rate_a * box_a.radius + rate_b * box_b.radius;
        approach.bend = rate_a * rate_a * (box_a.centre_arm + box_a.radius) +
                        rate_b * rate_b * (box_b.centre_arm + box_b.radius);
        approach.fastest = pair_.speed;
        Triangle b[TriangleLeaf::kLanes];
        for (std::uint32_t j = 0; j < leaf_b.count(); ++j)
            b[j] = b_.data().world_slot(leaf_b.first() + j, moment_.world_from_b);
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i) {
            const Triangle a = a_.data().world_slot(leaf_a.first() + i, moment_.world_from_a);
            TrianglePairBlock pairs{};
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j)
                pairs.set(j, a, b[j]);
            // None cross: nothing has met before now.
            double squares[TrianglePairBlock::kLanes];
            distance_sq(pairs, squares);
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j) {
                ++counters_.primitive_tests;
                approach.gap = std::sqrt(squares[j]) - pair_.margin;
                push({std::max(pair.time, moment_.time + free_time(approach)), leaf_a.first() + i,
                      leaf_b.first() + j, true});
            }
        }
    }

    [[nodiscard]] Triangle triangle_a(std::uint32_t slot, double time) const {
        return a_.data().world_slot(slot, pair_.a.trajectory.at(time));
    }
    [[nodiscard]] Triangle triangle_b(std::uint32_t slot, double time) const {
        return b_.data().world_slot(slot, pair_.b.trajectory.at(time));
    }

    /// Measures two triangles: they are the answer, or wait for their next time.
    void advance(const Waiting& pair) {
        ++counters_.primitive_tests;
        const Triangle a = triangle_a(pair.a, pair.time), b = triangle_b(pair.b, pair.time);
        const ClosestPoints closest = triangle_triangle_distance(a, b);
        const double gap = std::sqrt(closest.distance_sq);
        if (gap <= tolerance_ && decide(pair, closest, gap))
            return;
        push({pair.time + free_time(pair_, pair.time, a, b, closest), pair.a, pair.b, true});
    }

    /// Whether two triangles within the tolerance end the search: they will meet, or nobody knows.
    bool decide(const Waiting& pair, const ClosestPoints& closest, double gap) {
        const Vec3 normal = normalized_or_zero(closest.b - closest.a);
        const double closing =
            dot(normal, pair_.a.trajectory.velocity_at(closest.a, pair.time) -
                            pair_.b.trajectory.velocity_at(closest.b, pair.time));
        const bool undecided = gap <= kUndecided * pair_.margin || ++followed_ > kMostFollowed;
        double contact_time = contact_of_triangles(pair, closing > 0 ? gap / closing : 0);
        if (contact_time > kEnd && undecided)
            contact_time = contact_of_models(
                pair.time, pair_.margin / (closing > 0 ? closing : std::max(pair_.speed, kEnd)));
        answered_ = contact_time <= kEnd || undecided;
        if (!answered_)
            return false;
        impact_.hit = true;
        impact_.time = pair.time;
        impact_.contact_time = contact_time;
        impact_.gap = gap;
        impact_.point_a = closest.a, impact_.point_b = closest.b;
        impact_.normal = normal;
        impact_.triangle_a = a_.data().triangle_at(pair.a);
        impact_.triangle_b = b_.data().triangle_at(pair.b);
        impact_.status = contact_time <= kEnd ? Status::exact : Status::bound_only;
        return true;
    }

    /// A time at which the two triangles share a point, now or where they should at their present
    /// speed; infinite if none is found.
    double contact_of_triangles(const Waiting& pair, double expected) {
        for (const double part : {0.0, 1.001, 1.1, 2.0, 8.0}) {
            const double time = std::min(kEnd, pair.time + part * expected);
            ++counters_.primitive_tests;
            if (triangle_triangle_intersect(triangle_a(pair.a, time), triangle_b(pair.b, time)) !=
                TriangleContact::none)
                return time;
            if (expected == 0)
                break;
        }
        return kNever;
    }

    /// The same for the whole models: near two triangles that only touch, others may cross.
    double contact_of_models(double time, double step) {
        for (const double steps : {1.0, 16.0, 256.0, 4096.0}) {
            const double then = std::min(kEnd, time + steps * step);
            const PlacedPair placed(a_, pair_.a.trajectory.at(then), b_,
                                    pair_.b.trajectory.at(then));
            if (!find_contacts(placed, ContactMode::first, counters_).empty())
                return then;
        }
        return kNever;
    }

    const Model& a_;
    const Model& b_;
    const MovingPair& pair_;
    double tolerance_;
    double window_;         ///< length of a window
    double window_end_ = 0; ///< of the present one
    double next_begin_ = 0; ///< no pair that was left out can meet before this time
    bool answered_ = false;
    std::vector<Waiting> waiting_; ///< a heap, the earliest first
    Moment moment_;
    int followed_ = 0;
    Counters counters_;
    Impact impact_;
};

double default_tolerance(const MovingPair& pair, const Tree& a, const Tree& b) {
    return kTolerance * 2 *
           std::max(root_box(a, pair.a.scale).radius, root_box(b, pair.b.scale).radius);
}

/// The models share a point at the start.
Impact impact_at_start(const PlacedPair& placed, const Contact& contact) {
    const ClosestPoints common = triangle_triangle_distance(placed.triangle_a(contact.pair.a),
                                                            placed.triangle_b(contact.pair.b));
    Impact impact;
    impact.hit = true;
    impact.time = impact.contact_time = impact.gap = 0;
    impact.point_a = common.a, impact.point_b = common.b;
    impact.triangle_a = contact.pair.a, impact.triangle_b = contact.pair.b;
    return impact;
}

} // namespace

Impact time_of_impact(const Model& a, const Motion& motion_a, const Model& b,
                      const Motion& motion_b, const ImpactOptions& options) {
    if (options.tolerance && !(*options.tolerance >= 0))
        throw Error(ErrorCode::bad_argument, "tolerance must not be negative");
    const ModelData &data_a = a.data(), &data_b = b.data();
    const MovingPair pair(data_a.tree(), data_a.model_from_tree(), motion_a, data_b.tree(),
                          data_b.model_from_tree(), motion_b);
    if (data_a.tree().empty() || data_b.tree().empty())
        return {};
    const std::uint64_t exact_before = exact_signs();
    Counters at_start;
    const PlacedPair placed(a, pair.a.trajectory.at(0), b, pair.b.trajectory.at(0));
    const std::vector<Contact> contact = find_contacts(placed, ContactMode::first, at_start);
    Impact impact = contact.empty() ? ImpactSearch(a, b, pair,
                                                   options.tolerance.value_or(default_tolerance(
                                                       pair, data_a.tree(), data_b.tree())))
                                          .run()
                                    : impact_at_start(placed, contact.front());
    impact.counters.volume_tests += at_start.volume_tests;
    impact.counters.primitive_tests += at_start.primitive_tests;
    impact.counters.exact_tests = exact_signs() - exact_before;
    return impact;
}

} // namespace abut
