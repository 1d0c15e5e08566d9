#include <abut/error.h>
#include <abut/motion.h>

#include "geometry/triangle_block.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/contacts.h"
#include "rigid/motion_bounds.h"
#include "rigid/moving_boxes.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>

namespace abut {

namespace {

constexpr double kEnd = 1; ///< of the time that is looked at
/// Default tolerance, of the larger model's diagonal.
constexpr double kTolerance = 1e-6;
/// How often pairs of triangles within the tolerance are followed, in all, before contact is
/// reported as possible.
constexpr int kMostFollowed = 4096;
/// Below this many times the margin for rounding, nothing is told from contact: twice, so that what
/// is left of larger gaps always moves the time on.
constexpr double kUndecided = 2;
/// A moment is used again while no point has moved farther than this share of a box's radius.
constexpr double kStale = 0.125;

/// Two boxes, or two triangles, that certainly do not meet before `time`.
struct Waiting {
    double time = 0;
    std::uint32_t a = 0, b = 0;
    bool triangles = false; ///< a and b are slots of triangles; else name boxes
    bool operator<(const Waiting& other) const { return time > other.time; }
};

/// A child is named by 8 * node + lane, the root by kRoot.
constexpr std::uint32_t kRoot = 0xffffffffU;

NodeRef ref_of(const Tree& tree, std::uint32_t name) {
    return name == kRoot ? NodeRef::node(0)
                         : tree.nodes[name / Node::kWidth].child[name % Node::kWidth];
}
TreeBox box_of(const Tree& tree, std::uint32_t name) {
    return name == kRoot ? root_box(tree)
                         : child_box(tree.nodes[name / Node::kWidth], name % Node::kWidth);
}

/// Advances all pairs in the order of the times before which they cannot meet.
class ImpactSearch {
public:
    ImpactSearch(const ModelData& a, const ModelData& b, const MovingPair& pair, double tolerance)
        : a_(a), b_(b), pair_(pair), tolerance_(std::max(tolerance, kUndecided * pair.margin)) {}

    Impact run() {
        push({0, kRoot, kRoot, false});
        while (!waiting_.empty()) {
            std::pop_heap(waiting_.begin(), waiting_.end());
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            if (!next.triangles)
                open(next);
            else if (advance(next))
                break;
        }
        impact_.counters = counters_;
        return impact_;
    }

private:
    void push(const Waiting& pair) {
        if (pair.time <= kEnd) {
            waiting_.push_back(pair);
            std::push_heap(waiting_.begin(), waiting_.end());
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
        const NodeRef ref_a = ref_of(a_.tree(), pair.a), ref_b = ref_of(b_.tree(), pair.b);
        const TreeBox tree_box_a = box_of(a_.tree(), pair.a),
                      tree_box_b = box_of(b_.tree(), pair.b);
        const double radius_a = length(tree_box_a.half), radius_b = length(tree_box_b.half);
        const Moment& now = moment_for(pair.time, std::min(radius_a, radius_b));
        const MovingBox box_a = box_of_a(pair_, now, tree_box_a),
                        box_b = box_of_b(pair_, now, tree_box_b);
        if (ref_a.is_leaf() && ref_b.is_leaf()) {
            open_leaves(pair, ref_a, ref_b, box_a, box_b);
            return;
        }
        const bool open_a = !ref_a.is_leaf() && (ref_b.is_leaf() || radius_a > radius_b);
        const std::uint32_t index = (open_a ? ref_a : ref_b).index();
        const Node& node = (open_a ? a_ : b_).tree().nodes[index];
        for (std::uint32_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i) {
            ++counters_.volume_tests;
            const TreeBox child = child_box(node, i);
            const double free =
                open_a ? free_time(pair_, now, box_of_a(pair_, now, child), box_b, kEnd - now.time)
                       : free_time(pair_, now, box_a, box_of_b(pair_, now, child), kEnd - now.time);
            const std::uint32_t name = index * Node::kWidth + i;
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
        TriangleBlock block_b{};
        for (std::uint32_t j = 0; j < TriangleBlock::kLanes; ++j)
            block_b.set(j, b_.world_triangle(leaf_b.first() + std::min(j, leaf_b.count() - 1),
                                             moment_.world_from_b));
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i) {
            const Triangle triangle = a_.world_triangle(leaf_a.first() + i, moment_.world_from_a);
            const std::uint32_t meeting = may_intersect(triangle, block_b);
            TrianglePairBlock pairs{};
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j)
                pairs.set(j, triangle, block_b, j);
            double squares[TrianglePairBlock::kLanes];
            distance_sq(pairs, squares);
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j) {
                ++counters_.primitive_tests;
                approach.gap = (meeting >> j & 1U) != 0 ? 0 : std::sqrt(squares[j]) - pair_.margin;
                push({std::max(pair.time, moment_.time + free_time(approach)), leaf_a.first() + i,
                      leaf_b.first() + j, true});
            }
        }
    }

    [[nodiscard]] Triangle triangle_a(std::uint32_t slot, double time) const {
        return a_.world_triangle(slot, pair_.a.trajectory.at(time));
    }
    [[nodiscard]] Triangle triangle_b(std::uint32_t slot, double time) const {
        return b_.world_triangle(slot, pair_.b.trajectory.at(time));
    }

    /// Measures two triangles and lets them wait for their next time. True if they are the answer.
    bool advance(const Waiting& pair) {
        ++counters_.primitive_tests;
        const Triangle a = triangle_a(pair.a, pair.time), b = triangle_b(pair.b, pair.time);
        const ClosestPoints closest = triangle_triangle_distance(a, b);
        const double gap = std::sqrt(closest.distance_sq);
        const Vec3 normal = normalized_or_zero(closest.b - closest.a);
        if (gap <= tolerance_) {
            impact_.hit = true;
            impact_.time = pair.time;
            impact_.gap = gap;
            impact_.point_a = closest.a, impact_.point_b = closest.b;
            impact_.normal = normal;
            impact_.triangle_a = a_.triangle_at(pair.a),
            impact_.triangle_b = b_.triangle_at(pair.b);
            impact_.contact_time = contact_after(pair, closest, normal);
            if (impact_.contact_time <= kEnd)
                return true;
            impact_.status = Status::bound_only;
            if (gap <= kUndecided * pair_.margin || ++followed_ > kMostFollowed)
                return true;
            impact_ = {};
        }
        push({pair.time + free_time_along(normal, closest.a, a, b, pair.time), pair.a, pair.b,
              true});
        return false;
    }

    /// For how long two triangles stay apart along the unit vector n, vertex by vertex.
    [[nodiscard]] double free_time_along(const Vec3& n, const Vec3& origin, const Triangle& a,
                                         const Triangle& b, double time) const {
        struct Vertex {
            double height, speed;
        };
        const auto vertices = [&](const Trajectory& trajectory, const Triangle& t, double& bend) {
            const double turn =
                length(cross(n, trajectory.angular_velocity())) * trajectory.speed_of_rotation();
            std::array<Vertex, 3> result{};
            for (std::size_t i = 0; i < 3; ++i) {
                result[i] = {dot(n, t[i] - origin), dot(n, trajectory.velocity_at(t[i], time))};
                bend = std::max(bend, turn * trajectory.axis_distance(t[i], time));
            }
            return result;
        };
        double bend_a = 0, bend_b = 0;
        const auto of_a = vertices(pair_.a.trajectory, a, bend_a),
                   of_b = vertices(pair_.b.trajectory, b, bend_b);
        double least = kEnd;
        for (const Vertex& p : of_a)
            for (const Vertex& q : of_b)
                least =
                    std::min(least, free_time({q.height - p.height - pair_.margin,
                                               p.speed - q.speed, bend_a + bend_b, pair_.speed}));
        return least;
    }

    /// A time at which two triangles that are almost in contact share a point; infinite if none is
    /// found where they should meet at their present speed.
    double contact_after(const Waiting& pair, const ClosestPoints& closest, const Vec3& normal) {
        const double closing =
            dot(normal, pair_.a.trajectory.velocity_at(closest.a, pair.time) -
                            pair_.b.trajectory.velocity_at(closest.b, pair.time));
        const double expected = closing > 0 ? std::sqrt(closest.distance_sq) / closing : 0;
        for (const double part : {0.0, 1.001, 1.1, 2.0, 8.0}) {
            const double time = std::min(kEnd, pair.time + part * expected);
            ++counters_.primitive_tests;
            if (triangle_triangle_intersect(triangle_a(pair.a, time), triangle_b(pair.b, time)) !=
                TriangleContact::none)
                return time;
            if (expected == 0)
                break;
        }
        return std::numeric_limits<double>::infinity();
    }

    const ModelData& a_;
    const ModelData& b_;
    const MovingPair& pair_;
    double tolerance_;
    boost::container::small_vector<Waiting, 512> waiting_; ///< a heap, the earliest first
    Moment moment_;
    int followed_ = 0;
    Counters counters_;
    Impact impact_;
};

double default_tolerance(const ModelData& a, const ModelData& b) {
    const auto diagonal = [](const Tree& tree) {
        return tree.empty() ? 0 : 2 * length(root_box(tree).half);
    };
    return kTolerance * std::max(diagonal(a.tree()), diagonal(b.tree()));
}

/// The models share a point at the start.
Impact impact_at_start(const PlacedPair& placed, const Contact& contact) {
    const auto triangle = [](const Mesh& mesh, std::uint32_t index, const Transform& world) {
        const auto& t = mesh.triangles[index];
        return Triangle{apply(world, mesh.positions[t[0]]), apply(world, mesh.positions[t[1]]),
                        apply(world, mesh.positions[t[2]])};
    };
    const ClosestPoints common = triangle_triangle_distance(
        triangle(placed.a().mesh(), contact.pair.a, placed.world_from_a()),
        triangle(placed.b().mesh(), contact.pair.b, placed.world_from_b()));
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
    Impact impact =
        contact.empty()
            ? ImpactSearch(data_a, data_b, pair,
                           options.tolerance.value_or(default_tolerance(data_a, data_b)))
                  .run()
            : impact_at_start(placed, contact.front());
    impact.counters.volume_tests += at_start.volume_tests;
    impact.counters.primitive_tests += at_start.primitive_tests;
    impact.counters.exact_tests = exact_signs() - exact_before;
    return impact;
}

} // namespace abut
