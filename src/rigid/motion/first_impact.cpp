#include "rigid/motion/first_impact.h"

#include "core/set_bits.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/model/model_data.h"
#include "rigid/motion/impact_steps.h"
#include "rigid/motion/motion_bounds.h"
#include "rigid/motion/moving_ball.h"
#include "rigid/motion/moving_nodes.h"
#include "rigid/motion/moving_pair.h"
#include "rigid/motion/moving_triangles.h"
#include "rigid/pair/contacts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace abut {

namespace {

constexpr double kEnd = 1; ///< end of the motion
constexpr double kNoTime = std::numeric_limits<double>::infinity();
/// Limits on steps with pairs of triangles within the tolerance: in all, and for each found pair.
/// Beyond them, contact is reported as possible.
constexpr std::uint64_t kMostFollowed = 4096, kMostFollowedOfPair = 64;
/// A gap below this many margins for rounding is not told from contact. At 2, what is left of a
/// larger gap always advances the time.
constexpr double kUndecided = 2;
/// The sum of both bodies' turns within a window, in radians: the bounds hold for one window and
/// are good for such small turns.
constexpr double kMostTurn = 0.25;
/// Shortest window, so that the number of windows is bounded.
constexpr double kLeastWindow = 0x1p-20;
/// A moment is used again as long as the bounds have lost at most this share of a box's radius by
/// its age.
constexpr double kStale = 1.0 / 64;
/// A box of less than this share of another's radius is lost in the rounding of single precision.
constexpr double kBlurred = 0x1p-16;
/// A ball is not postponed, but its contents are opened, if it is nearer than this share of its
/// radius, or free for less than this share of a window.
constexpr double kNear = 0.25, kShortWait = 1.0 / 256;
/// If one box has this many times the radius of the other, only the larger is opened.
constexpr double kUnlike = 3;
constexpr std::uint32_t kAllLanes = (1U << Node::kWidth) - 1;

/// Two boxes by their names, or two triangles by their slots, that certainly do not meet before
/// `time`.
struct WaitingPair {
    double time;
    std::uint32_t a, b;
};

/// A priority queue (a binary heap) by time. Of equal times, the pair deeper in the tree of a comes
/// first, since nodes are numbered after their ancestors.
class WaitingQueue {
public:
    void clear() { heap_.clear(); }
    /// Infinite if the queue is empty.
    [[nodiscard]] double first_time() const { return heap_.empty() ? kNoTime : heap_.front().time; }

    void push(const WaitingPair& pair) {
        heap_.push_back(pair);
        std::push_heap(heap_.begin(), heap_.end(), Later{});
    }
    WaitingPair pop() {
        std::pop_heap(heap_.begin(), heap_.end(), Later{});
        const WaitingPair first = heap_.back();
        heap_.pop_back();
        return first;
    }

private:
    struct Later {
        bool operator()(const WaitingPair& x, const WaitingPair& y) const {
            return x.time > y.time || (x.time == y.time && x.a < y.a);
        }
    };
    std::vector<WaitingPair> heap_;
};

/// Half the diagonal of a box, in its tree's units. In single precision, since it decides only what
/// is opened and when a moment is too old.
double radius_of(const Tree& tree, std::uint32_t name) {
    const auto half_of = [](float x, float y, float z) {
        return 0.5F * std::sqrt(x * x + y * y + z * z);
    };
    if (name == kRootName) {
        const auto &low = tree.bounds.lower, &high = tree.bounds.upper;
        return half_of(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    }
    const Node& node = tree.nodes[node_of(name)];
    const std::size_t i = lane_of(name);
    return half_of(node.upper[0][i] - node.lower[0][i], node.upper[1][i] - node.lower[1][i],
                   node.upper[2][i] - node.lower[2][i]);
}

/// Advances pairs in the order of the times before which they certainly do not meet.
class ImpactSearch {
public:
    /// In          until: later contacts do not matter.
    ImpactSearch(const Model& a, const Model& b, const MovingPair& pair, double until,
                 const ImpactOptions& options)
        : a_(a), b_(b), pair_(pair), tree_a_(pair.a.tree), tree_b_(pair.b.tree),
          end_(std::min(kEnd, until)),
          asked_tolerance_(options.absolute_error.value_or(
              kImpactTolerance * std::min(a.data().diagonal(), b.data().diagonal()))),
          tolerance_(std::max(asked_tolerance_, kUndecided * pair.margin)), steps_(options),
          window_(std::max(kLeastWindow, kMostTurn / (pair.a.trajectory.speed_of_rotation() +
                                                      pair.b.trajectory.speed_of_rotation()))),
          blur_(std::min(end_, window_) * pair.bend + 0x1p-18 * pair.speed) {}

    Impact run() {
        for (double begin = 0; begin <= end_ && !answered_; begin = next_begin_)
            search_from(begin);
        impact_.counters = counters_;
        impact_.steps = steps_.count();
        return impact_;
    }

private:
    /// Searches one window of time. Pairs that can meet only after it are dropped: the next window
    /// finds them again from the roots, in fewer pairs than the small ones that they were split
    /// into here.
    void search_from(double begin) {
        begin += pair_.free_time_of_balls(begin, end_ - begin);
        window_end_ = std::min(end_, begin + window_);
        next_begin_ = window_end_ < end_ ? window_end_ : kNoTime;
        boxes_.clear();
        triangles_.clear();
        if (begin <= window_end_)
            boxes_.push({begin, kRootName, kRootName});
        while (!answered_) {
            const double box_time = boxes_.first_time(), triangle_time = triangles_.first_time(),
                         time = std::min(box_time, triangle_time);
            if (!(time <= window_end_))
                break;
            if (!steps_.take(time)) {
                impact_ = out_of_steps(time);
                answered_ = true;
            } else if (triangle_time <= box_time) {
                advance(triangles_.pop());
            } else {
                open(boxes_.pop());
            }
        }
    }

    /// The span from a pair's time on, with a moment that is recent enough for boxes of this size.
    TimeSpan span_from(double time, double radius) {
        const double passed = time - moment_.time;
        if (moment_.time < 0 || passed * blur_ > kStale * radius)
            moment_ = Moment(pair_, time);
        return {moment_, time, window_end_};
    }

    /// Replaces a pair of boxes by the pairs below it.
    void open(const WaitingPair& pair) {
        const NodeRef a = tree_a_.named(pair.a), b = tree_b_.named(pair.b);
        const double radius_a = pair_.a.scale * radius_of(tree_a_, pair.a),
                     radius_b = pair_.b.scale * radius_of(tree_b_, pair.b);
        if ((b.is_leaf() && radius_a < kBlurred * radius_b &&
             postpone(pair, {pair_.a, pair.a}, {pair_.b, b_, b})) ||
            (a.is_leaf() && radius_b < kBlurred * radius_a &&
             postpone(pair, {pair_.b, pair.b}, {pair_.a, a_, a})))
            return;
        const TimeSpan span = span_from(pair.time, std::min(radius_a, radius_b));
        if (a.is_leaf() && b.is_leaf()) {
            open_leaves(pair, span);
            return;
        }
        const bool open_a = !a.is_leaf() &&
                            (b.is_leaf() || pair.b == kRootName || radius_b < kUnlike * radius_a),
                   open_b = !b.is_leaf() &&
                            (a.is_leaf() || pair.a == kRootName || radius_a < kUnlike * radius_b);
        // A box that is not opened is compared as a child of its node.
        const std::uint32_t index_a = open_a ? a.index() : node_of(pair.a),
                            index_b = open_b ? b.index() : node_of(pair.b);
        const std::uint32_t lanes_a = open_a ? kAllLanes : 1U << lane_of(pair.a),
                            lanes_b = open_b ? kAllLanes : 1U << lane_of(pair.b);
        MeetingChildren found;
        find_meeting(span, {tree_a_.nodes[index_a], lanes_a}, {tree_b_.nodes[index_b], lanes_b},
                     found);
        counters_.volume_tests += std::uint64_t(std::popcount(lanes_a)) * std::popcount(lanes_b);
        for (const std::uint32_t bit : SetBits(found.pairs)) {
            const std::uint32_t i = bit / Node::kWidth, j = bit % Node::kWidth;
            boxes_.push(
                {span.at(found.share[i][j]), child_name(index_a, i), child_name(index_b, j)});
        }
    }

    struct SmallBox {
        const MovingPair::Body& body;
        std::uint32_t name;
    };
    struct LargeLeaf {
        const MovingPair::Body& body;
        const Model& model;
        NodeRef leaf;
    };

    /// Relative to a large leaf, single precision does not locate a small box. In double precision,
    /// the ball around the box may be proven apart from the leaf's triangles for some time. Returns
    /// false if the ball is so near that its contents must be opened.
    bool postpone(const WaitingPair& pair, const SmallBox& small, const LargeLeaf& large) {
        if (small.name == kRootName)
            return false;
        const Transform world_from_small = small.body.trajectory.at(pair.time),
                        world_from_large = large.body.trajectory.at(pair.time);
        const MovingBall ball =
            ball_of_child(small.body.tree, small.name,
                          compose(world_from_small, small.body.model_from_tree), small.body.scale);
        boost::container::static_vector<Triangle, TriangleLeaf::kLanes> triangles;
        for (std::uint32_t i = 0; i < large.leaf.count(); ++i)
            triangles.push_back(
                large.model.data().world_slot(large.leaf.first() + i, world_from_large));
        const BallGap gap =
            gap_of_ball(ball, small.body.trajectory, {triangles.data(), triangles.size()},
                        large.body.trajectory, pair.time, pair_.margin, pair_.radius);
        // Negated, so that a value that is not a number returns false.
        if (!(gap.distance >= kNear * ball.radius &&
              gap.free_time >= kShortWait * std::min(end_, window_)))
            return false;
        const double next = pair.time + gap.free_time;
        if (next <= window_end_)
            boxes_.push({next, pair.a, pair.b});
        return true;
    }

    void open_leaves(const WaitingPair& pair, const TimeSpan& span) {
        const NodeRef leaf_a = tree_a_.named(pair.a), leaf_b = tree_b_.named(pair.b);
        MeetingTriangles found;
        find_meeting(span, tree_a_.nodes[node_of(pair.a)], tree_a_.leaf(leaf_a),
                     tree_b_.nodes[node_of(pair.b)], tree_b_.leaf(leaf_b), found);
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i)
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j) {
                ++counters_.primitive_tests;
                if ((found.pairs >> (TriangleLeaf::kLanes * i + j) & 1U) == 0)
                    continue;
                most_followed_ += kMostFollowedOfPair;
                triangles_.push(
                    {span.at(found.share[i][j]), leaf_a.first() + i, leaf_b.first() + j});
            }
    }

    [[nodiscard]] Triangle triangle_a(std::uint32_t slot, double time) const {
        return a_.data().world_slot(slot, pair_.a.trajectory.at(time));
    }
    [[nodiscard]] Triangle triangle_b(std::uint32_t slot, double time) const {
        return b_.data().world_slot(slot, pair_.b.trajectory.at(time));
    }

    /// Measures two triangles. They end the search, or wait for their next time.
    void advance(const WaitingPair& pair) {
        ++counters_.primitive_tests;
        const Triangle a = triangle_a(pair.a, pair.time), b = triangle_b(pair.b, pair.time);
        const ClosestPoints closest = triangle_triangle_distance(a, b);
        const double gap = std::sqrt(closest.distance_sq) - pair_.radius;
        if (gap <= tolerance_ && decide(pair, closest, gap))
            return;
        const double next =
            pair.time + free_time(pair_, pair.time, a, b, closest, window_end_ - pair.time);
        if (next <= window_end_)
            triangles_.push({next, pair.a, pair.b});
    }

    /// Returns whether two triangles within the tolerance end the search: they will meet, or it
    /// cannot be decided.
    bool decide(const WaitingPair& pair, const ClosestPoints& closest, double gap) {
        const Vec3 normal = normalized_or_zero(closest.b - closest.a);
        const double closing =
            dot(normal, pair_.a.trajectory.velocity_at(closest.a, pair.time) -
                            pair_.b.trajectory.velocity_at(closest.b, pair.time));
        const bool undecided = gap <= kUndecided * pair_.margin || ++followed_ > most_followed_;
        double contact_time = contact_of_triangles(pair, closing > 0 ? gap / closing : 0);
        if (contact_time > kEnd && undecided)
            contact_time = contact_of_models(
                pair.time, pair_.margin / (closing > 0 ? closing : std::max(pair_.speed, kEnd)));
        answered_ = contact_time <= kEnd || undecided;
        if (!answered_)
            return false;
        impact_.meet = true;
        impact_.time = pair.time;
        impact_.contact_time = contact_time;
        impact_.gap = std::max(gap, 0.0);
        impact_.point_a = closest.a, impact_.point_b = closest.b;
        impact_.normal = normal;
        impact_.triangle_a = a_.data().triangle_at(pair.a);
        impact_.triangle_b = b_.data().triangle_at(pair.b);
        impact_.status = contact_time > kEnd       ? Status::bound_only
                         : gap <= asked_tolerance_ ? Status::exact
                                                   : Status::converged;
        return true;
    }

    [[nodiscard]] bool meet(const Triangle& a, const Triangle& b) const {
        if (pair_.radius > 0)
            return std::sqrt(triangle_triangle_distance(a, b).distance_sq) <= pair_.radius;
        return triangle_triangle_intersect(a, b) != TriangleContact::none;
    }

    /// A time at which the two triangles share a point: now, or near the time that their present
    /// speed predicts. Infinite if none is found.
    double contact_of_triangles(const WaitingPair& pair, double expected) {
        for (const double part : {0.0, 1.001, 1.1, 2.0, 8.0}) {
            const double time = std::min(kEnd, pair.time + part * expected);
            ++counters_.primitive_tests;
            if (meet(triangle_a(pair.a, time), triangle_b(pair.b, time)))
                return time;
            if (expected == 0)
                break;
        }
        return kNoTime;
    }

    /// A time at which the whole models share a point: near two triangles that only touch, others
    /// may cross.
    double contact_of_models(double time, double step) {
        if (pair_.radius > 0)
            return kNoTime;
        for (const double steps : {1.0, 16.0, 256.0, 4096.0}) {
            const double then = std::min(kEnd, time + steps * step);
            const PlacedPair placed(a_, pair_.a.trajectory.at(then), b_,
                                    pair_.b.trajectory.at(then));
            if (!find_contacts(placed, ContactMode::first, counters_).empty())
                return then;
        }
        return kNoTime;
    }

    const Model& a_;
    const Model& b_;
    const MovingPair& pair_;
    const Tree &tree_a_, &tree_b_;
    double end_; ///< of the time that is searched
    double asked_tolerance_, tolerance_;
    ImpactSteps steps_;
    double window_; ///< length of a window
    /// Speed at which the bounds of a moment become worse: by rotation within a window, and by
    /// rounding in single precision.
    double blur_;
    double window_end_ = 0;
    double next_begin_ = 0; ///< no dropped pair can meet before this time
    bool answered_ = false;
    WaitingQueue boxes_, triangles_;
    Moment moment_;
    std::uint64_t followed_ = 0, most_followed_ = kMostFollowed;
    Counters counters_;
    Impact impact_;
};

/// The answer for models that share a point at the start.
Impact impact_at_start(const PlacedPair& placed, const Contact& contact) {
    const ClosestPoints common = triangle_triangle_distance(placed.triangle_a(contact.pair.a),
                                                            placed.triangle_b(contact.pair.b));
    Impact impact;
    impact.meet = true;
    impact.time = impact.contact_time = impact.gap = 0;
    impact.point_a = common.a, impact.point_b = common.b;
    impact.triangle_a = contact.pair.a, impact.triangle_b = contact.pair.b;
    return impact;
}

/// In          the starts have a uniform scale.
Impact impact_of_uniform(const MovingModel& a, const MovingModel& b, double radius, double until,
                         const ImpactOptions& options) {
    const ModelData &data_a = a.model.data(), &data_b = b.model.data();
    const MovingPair pair(data_a.tree(), data_a.model_from_tree(), a.trajectory, data_b.tree(),
                          data_b.model_from_tree(), b.trajectory, radius);
    if (data_a.tree().empty() || data_b.tree().empty())
        return {};
    const std::uint64_t exact_before = exact_signs();
    Counters at_start;
    Impact impact;
    std::vector<Contact> contact;
    // With a radius, the search itself finds at time 0 what is near enough.
    std::optional<PlacedPair> placed;
    if (radius == 0) {
        placed.emplace(a.model, pair.a.trajectory.at(0), b.model, pair.b.trajectory.at(0));
        contact = find_contacts(*placed, ContactMode::first, at_start);
    }
    impact = contact.empty() ? ImpactSearch(a.model, b.model, pair, until, options).run()
                             : impact_at_start(*placed, contact.front());
    impact.counters.volume_tests += at_start.volume_tests;
    impact.counters.primitive_tests += at_start.primitive_tests;
    impact.counters.exact_tests = exact_signs() - exact_before;
    return impact;
}

/// The model with the positions of its start, which its motion then moves.
MovingModel at_its_start(const MovingModel& m) {
    const Trajectory& t = m.trajectory;
    return {baked(m.model, t.start()),
            Trajectory({}, t.centre(0), t.velocity(), t.angular_velocity())};
}

} // namespace

Impact first_impact(const MovingModel& a, const MovingModel& b, double radius, double until,
                    const ImpactOptions& options) {
    const bool uniform_a = uniform_scale(a.trajectory.start()) > 0,
               uniform_b = uniform_scale(b.trajectory.start()) > 0;
    return impact_of_uniform(uniform_a ? a : at_its_start(a), uniform_b ? b : at_its_start(b),
                             radius, until, options);
}

} // namespace abut
