// Lower bounds of the time for which boxes, balls and triangles stay apart: nothing meets earlier.

#include <abut/rigid.h>

#include "rigid/model/model_data.h"
#include "rigid/motion/motion_bounds.h"
#include "rigid/motion/moving_ball.h"
#include "rigid/motion/moving_nodes.h"
#include "rigid/motion/moving_triangles.h"
#include "rigid/motion/node_motion.h"
#include "tests/support/shapes.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// A motion roughly towards the origin.
Motion random_motion(Random& random, double away = 0.8) {
    const Pose pose = random.pose(away);
    const Vec3 centre = pose.translation + random.in_cube(0.5);
    const Vec3 velocity = (random.chance(0.3) ? 0.05 : 1) *
                          (random.in_cube(0.3) - random.uniform(0, 4) * pose.translation);
    const Vec3 spin = random.uniform(0, random.chance(0.3) ? 15 : 2) * random.direction();
    return {pose, centre, velocity, random.chance(0.2) ? Vec3{} : spin};
}

MovingPair moving_pair(const Model& a, const Motion& motion_a, const Model& b,
                       const Motion& motion_b) {
    return {a.data().tree(), a.data().model_from_tree(), motion_a,
            b.data().tree(), b.data().model_from_tree(), motion_b};
}

/// Whether the models meet at a sampled time in [begin, end).
bool meet_within(const Model& a, const Motion& motion_a, const Model& b, const Motion& motion_b,
                 double begin, double end) {
    constexpr int kSamples = 40;
    for (int i = 0; i < kSamples; ++i) {
        // Half of the samples are close to the end, where a bound that is too long shows.
        const double part = i % 2 == 0 ? double(i) / kSamples : 1 - std::pow(0.7, i);
        const double t = begin + part * (end - begin);
        if (collide(a, at(motion_a, t), b, at(motion_b, t)).meet())
            return true;
    }
    return false;
}

struct Tally {
    int proven = 0, never = 0, tight = 0;
    void expect_some(int cases) const {
        std::cout << proven << " proven, " << never << " never, " << tight << " tight\n";
        EXPECT_GT(proven, cases / 5);
        EXPECT_GT(never, cases / 50);
        EXPECT_GT(tight, cases / 200); // some meet soon after the bound
    }
};

/// Checks a claim that two models do not meet from `begin` to `end`.
void check(const Model& a, const Motion& motion_a, const Model& b, const Motion& motion_b,
           double begin, double end, Tally& tally) {
    if (!(end > begin))
        return;
    ++tally.proven;
    tally.never += end > 1 ? 1 : 0;
    ASSERT_FALSE(meet_within(a, motion_a, b, motion_b, begin, std::min(1.0, end)));
    tally.tight += end < 1 && meet_within(a, motion_a, b, motion_b, end,
                                          std::min(1.0, end + 0.5 * (end - begin)))
                       ? 1
                       : 0;
}

/// A moment, and a time span that begins then or later.
struct Span {
    double moment, begin, end;
    explicit Span(Random& random)
        : moment(random.chance(0.3) ? 0 : random.uniform(0, 1)),
          begin(random.chance(0.7) ? moment : random.uniform(moment, 1)),
          end(random.chance(0.5) ? 1 : random.uniform(begin, 1)) {}
};

/// A model of the triangles in some slots of another model's tree.
Model part(const Model& model, std::uint32_t first, std::uint32_t count) {
    Mesh mesh;
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
        const Triangle t = model.data().world_slot(slot, {});
        mesh.positions.insert(mesh.positions.end(), t.begin(), t.end());
        mesh.triangles.push_back(
            {3 * (slot - first), 3 * (slot - first) + 1, 3 * (slot - first) + 2});
    }
    return Model(mesh);
}

/// A flat, round or loose model with so few triangles that all children of the root are leaves.
Model small_model(Random& random) {
    const auto size = [&] { return random.chance(0.2) ? 0 : random.uniform(0.02, 0.6); };
    switch (random.integer(0, 3)) {
    case 0: {
        const Vec3 half{size(), size(), size()};
        return Model(box_mesh(-half, half));
    }
    case 1:
        return Model(sphere_mesh(random.uniform(0.1, 0.8), 5, 3));
    case 2: // a bar
        return Model(box_mesh({-1.5, -0.02, -0.02}, {1.5, 0.02, 0.02}));
    default:
        return Model(soup_mesh(random, random.integer(1, 12), 0.2, 0.6));
    }
}

/// A random node of a model's tree, and a random vertex below it.
struct NodeVertex {
    const Node* node;
    Vec3 vertex; ///< in the model's frame

    NodeVertex(Random& random, const Model& model) {
        const Tree& tree = model.data().tree();
        node = &tree.nodes[random.bits() % tree.nodes.size()];
        const Node* at = node;
        while (true) {
            NodeRef child;
            do
                child = at->child[random.bits() % Node::kWidth];
            while (child.is_none());
            if (child.is_leaf()) {
                const std::uint32_t slot =
                    child.first() + static_cast<std::uint32_t>(random.bits() % child.count());
                vertex = model.data().world_slot(slot, {})[random.bits() % 3];
                return;
            }
            at = &tree.nodes[child.index()];
        }
    }
};

/// Maps the world to a node's frame, frozen at a given time.
class StandingFrame {
public:
    StandingFrame(const Node& node, const Model& model, const Motion& motion, double time)
        : node_(node),
          tree_from_world_(inverse(compose(at(motion, time), model.data().model_from_tree()))) {}

    [[nodiscard]] Vec3 operator()(const Vec3& world) const {
        return node_.frame.point_from_tree(apply(tree_from_world_, world));
    }

private:
    const Node& node_;
    Transform tree_from_world_;
};

/// The vector turned by an angle about an axis of any length.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
    const Vec3 n = normalized_or_zero(axis);
    return v + std::sin(angle) * cross(n, v) + (1 - std::cos(angle)) * cross(n, cross(n, v));
}

TEST(MotionBounds, PathsOfPointsInNodes) {
    Random random(2204);
    constexpr int kCases = 40000;
    int close = 0;
    std::array<int, 3> of_axes{};
    const Model round(sphere_mesh(0.7, 20, 12)),
        bar(box_mesh({-1.5, -0.02, 0.3}, {1.5, 0.02, 0.4})), small(torus_mesh(1e-4, 3e-5, 24, 9)),
        large(soup_mesh(random, 300, 300, 200));
    const std::array<const Model*, 4> models{&round, &bar, &small, &large};
    for (int n = 0; n < kCases; ++n) {
        const Model &a = *models[random.bits() % 4], &b = *models[random.bits() % 4];
        const Motion motion_a = random_motion(random),
                     motion_b = random.chance(0.3) ? Motion::fixed(random.pose(0.8))
                                                   : random_motion(random);
        const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
        const Span span(random);
        const double duration = (span.end - span.moment) * random.uniform(0, 1);
        const Moment moment(pair, span.moment);
        const NodeVertex of_a(random, a), of_b(random, b);
        const StandingFrame in_a(*of_a.node, a, motion_a, span.moment),
            in_b(*of_b.node, b, motion_b, span.moment);
        // The origin of b's node.
        const auto& o = of_b.node->frame.origin;
        const Vec3 origin =
            in_a(apply(compose(at(motion_b, span.moment), b.data().model_from_tree()),
                       Vec3{o[0], o[1], o[2]}));
        FrameMap a_from_b;
        a_from_b.translation = {static_cast<float>(origin.x), static_cast<float>(origin.y),
                                static_cast<float>(origin.z)};
        const NodeMotion m = motion_of(moment.in_a, duration, *of_a.node, *of_b.node, a_from_b,
                                       random.uniform(0, 1));
        const double s = random.chance(0.5) ? 1 : random.uniform(0, 1);
        const double then = span.moment + s * duration;
        const auto to_vec = [](const std::array<float, 3>& v) { return Vec3{v[0], v[1], v[2]}; };
        const Vec3 before_a = in_a(apply(at(motion_a, span.moment), of_a.vertex)),
                   before_b = in_a(apply(at(motion_b, span.moment), of_b.vertex));
        // The displacement relative to axes that may turn with one of the bodies.
        const Vec3 after_a = apply(at(motion_a, then), of_a.vertex),
                   after_b = apply(at(motion_b, then), of_b.vertex);
        const Vec3 turn = m.axes == AxesTurn::none       ? Vec3{}
                          : m.axes == AxesTurn::with_own ? motion_a.angular_velocity
                                                         : motion_b.angular_velocity;
        ++of_axes.at(static_cast<std::size_t>(m.axes));
        const Vec3 between = turned(after_b - after_a, turn, -(then - span.moment) * length(turn));
        const Vec3 rest_of_both = in_a(after_a + between) - in_a(after_a) - (before_b - before_a) -
                                  s * (to_vec(m.velocity) + cross(to_vec(m.spin_other), before_b) -
                                       cross(to_vec(m.spin_own), before_a));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double off = std::abs(component(rest_of_both, static_cast<int>(axis))),
                         bound = s * m.spread[axis];
            ASSERT_LE(off, bound) << "case " << n;
            close += off > 0.6 * bound ? 1 : 0;
        }
        ASSERT_LE(length(rest_of_both), s * m.spread_any) << "case " << n;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Vec3 e{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
            ASSERT_GE(m.turn_own[axis], length(cross(e, to_vec(m.spin_own))));
            ASSERT_GE(m.turn_other[axis], length(cross(e, to_vec(m.spin_other))));
        }
        ASSERT_GE(m.own_from_other, pair.b.scale / pair.a.scale);
    }
    std::cout << close
              << " close to the bound; axes stand still, turn with the own, with the other: "
              << of_axes[0] << ", " << of_axes[1] << ", " << of_axes[2] << '\n';
    EXPECT_GT(close, kCases / 100);
    for (const int count : of_axes)
        EXPECT_GT(count, kCases / 20);
}

/// A leaf child of the root.
struct Child {
    const Node& node;
    std::uint32_t lane;

    Child(Random& random, const Model& model) : node(model.data().tree().nodes[0]) {
        do
            lane = static_cast<std::uint32_t>(random.integer(0, Node::kWidth - 1));
        while (node.child[lane].is_none());
    }
    [[nodiscard]] NodeRef leaf() const { return node.child[lane]; }
    /// The child's box as a model. Bounds of children know no more than this box.
    [[nodiscard]] Model box(const Model& model) const {
        const Aabb box = node.box(lane);
        Mesh mesh = box_mesh({box.lower[0], box.lower[1], box.lower[2]},
                             {box.upper[0], box.upper[1], box.upper[2]});
        for (Vec3& p : mesh.positions)
            p = apply(model.data().model_from_tree(), node.frame.point_to_tree(p));
        return Model(mesh);
    }
};

TEST(MotionBounds, ChildrenOfNodes) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(2200);
        constexpr int kCases = 3000;
        Tally tally;
        for (int n = 0; n < kCases; ++n) {
            const Model a = small_model(random), b = small_model(random);
            const Motion motion_a = random_motion(random, 1.5),
                         motion_b = random_motion(random, 1.5);
            const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
            const Span span(random);
            const Moment moment(pair, span.moment);
            const Child of_a(random, a), of_b(random, b);
            // The child is tested alone or together with the others.
            const auto lanes = [&](const Child& child) {
                return random.chance(0.3) ? 1U << child.lane : 0xffU;
            };
            MeetingChildren found;
            find_meeting({moment, span.begin, span.end}, {of_a.node, lanes(of_a)},
                         {of_b.node, lanes(of_b)}, found);
            const bool may_meet = (found.pairs >> (8 * of_a.lane + of_b.lane) & 1U) != 0;
            const TimeSpan times{moment, span.begin, span.end};
            check(of_a.box(a), motion_a, of_b.box(b), motion_b, span.begin,
                  may_meet ? times.at(found.share[of_a.lane][of_b.lane]) : span.end, tally);
            tally.never += may_meet ? 0 : 1;
            ASSERT_FALSE(HasFailure()) << "case " << n;
        }
        tally.expect_some(kCases);
    });
}

TEST(MotionBounds, TrianglesOfLeaves) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(2202);
        constexpr int kCases = 3000;
        Tally tally;
        for (int n = 0; n < kCases; ++n) {
            const Model a = small_model(random), b = small_model(random);
            const Motion motion_a = random_motion(random, 1.5),
                         motion_b = random_motion(random, 1.5);
            const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
            const Span span(random);
            const Moment moment(pair, span.moment);
            const Child of_a(random, a), of_b(random, b);
            const NodeRef leaf_a = of_a.leaf(), leaf_b = of_b.leaf();
            MeetingTriangles found;
            const TimeSpan times{moment, span.begin, span.end};
            find_meeting(times, of_a.node, a.data().tree().leaf(leaf_a), of_b.node,
                         b.data().tree().leaf(leaf_b), found);
            const auto i = static_cast<std::uint32_t>(random.integer(0, int(leaf_a.count()) - 1)),
                       j = static_cast<std::uint32_t>(random.integer(0, int(leaf_b.count()) - 1));
            const bool may_meet = (found.pairs >> (4 * i + j) & 1U) != 0;
            check(part(a, leaf_a.first() + i, 1), motion_a, part(b, leaf_b.first() + j, 1),
                  motion_b, span.begin, may_meet ? times.at(found.share[i][j]) : span.end, tally);
            tally.never += may_meet ? 0 : 1;
            ASSERT_FALSE(HasFailure()) << "case " << n;
        }
        tally.expect_some(kCases);
    });
}

TEST(MotionBounds, BallsAroundModels) {
    Random random(2203);
    constexpr int kCases = 3000;
    Tally tally;
    for (int n = 0; n < kCases; ++n) {
        const Model a(sphere_mesh(random.uniform(0.2, 1), 8, 5)),
            b(sphere_mesh(random.uniform(0.2, 1), 8, 5));
        const Motion motion_a = random_motion(random, 2), motion_b = random_motion(random, 2);
        const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
        const double begin = Span(random).begin;
        check(a, motion_a, b, motion_b, begin, begin + pair.free_time_of_balls(begin, 1 - begin),
              tally);
        ASSERT_FALSE(HasFailure()) << "case " << n;
    }
    tally.expect_some(kCases);
}

TEST(MotionBounds, BallsAroundChildrenOfNodesAndTriangles) {
    Random random(2204);
    constexpr int kCases = 3000;
    Tally tally;
    for (int n = 0; n < kCases; ++n) {
        const Triangle t = random.triangle(random.chance(0.7) ? random.uniform(0.5, 2) : 1e3);
        const Model a(Mesh{{t[0], t[1], t[2]}, {{0, 1, 2}}}), b = small_model(random);
        const Motion motion_a = random.chance(0.5) ? Motion::fixed({}) : random_motion(random),
                     motion_b = random_motion(random, 2);
        const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
        const double begin = Span(random).begin;
        const Tree& tree = b.data().tree();
        std::uint32_t lane = 0;
        while (lane + 1 < Node::kWidth && !tree.nodes[0].child[lane + 1].is_none() &&
               random.chance(0.6))
            ++lane;
        const NodeRef leaf = tree.nodes[0].child[lane];
        const MovingBall ball = ball_of_child(
            tree, child_name(0, lane), compose(pair.b.trajectory.at(begin), pair.b.model_from_tree),
            pair.b.scale);
        const Model inside = part(b, leaf.first(), leaf.count());
        for (const Vec3& p : inside.mesh().positions)
            ASSERT_LE(length(apply(at(motion_b, begin), p) - ball.centre),
                      ball.radius + pair.margin);
        const std::vector<Triangle> triangles{a.data().world_triangle(0, at(motion_a, begin))};
        const BallGap gap =
            gap_of_ball(ball, pair.b.trajectory, triangles, pair.a.trajectory, begin, pair.margin);
        check(a, motion_a, inside, motion_b, begin, begin + gap.free_time, tally);
        ASSERT_FALSE(HasFailure()) << "case " << n;
    }
    tally.expect_some(kCases);
}

TEST(MotionBounds, Triangles) {
    Random random(2201);
    constexpr int kCases = 3000;
    Tally tally;
    for (int i = 0; i < kCases; ++i) {
        const auto one = [&] {
            Triangle t = random.triangle(random.uniform(0.05, 1));
            if (random.chance(0.1))
                t[2] = t[1];
            return Model(Mesh{{t[0], t[1], t[2]}, {{0, 1, 2}}});
        };
        const Model a = one(), b = one();
        const Motion motion_a = random_motion(random), motion_b = random_motion(random);
        const MovingPair pair = moving_pair(a, motion_a, b, motion_b);
        const double begin = random.chance(0.3) ? 0 : random.uniform(0, 1);
        const Triangle world_a = a.data().world_triangle(0, at(motion_a, begin)),
                       world_b = b.data().world_triangle(0, at(motion_b, begin));
        const ClosestPoints closest = triangle_triangle_distance(world_a, world_b);
        if (closest.distance_sq == 0)
            continue;
        check(a, motion_a, b, motion_b, begin,
              begin + free_time(pair, begin, world_a, world_b, closest, 1 - begin), tally);
        ASSERT_FALSE(HasFailure()) << "case " << i;
    }
    tally.expect_some(kCases);
}

TEST(MotionBounds, BallsInStraightMotionExactly) {
    // Analytic solutions: 3 - 2 s = 1; then passing at a distance of 1, with radii slightly below
    // or above 1.
    EXPECT_NEAR(free_time({3, 0, 0}, {-2, 0, 0}, 0, 1, 10), 1, 1e-11);
    EXPECT_LE(free_time({3, 0, 0}, {-2, 0, 0}, 0, 1, 10), 1);
    EXPECT_EQ(free_time({3, 1, 0}, {-2, 0, 0}, 0, 1 - 1e-14, 10), HUGE_VAL);
    EXPECT_NEAR(free_time({3, 1, 0}, {-2, 0, 0}, 0, 1 + 1e-14, 10), 1.5, 1e-6);
    EXPECT_EQ(free_time({3, 0, 0}, {2, 0, 0}, 0, 1, 10), HUGE_VAL);
    EXPECT_EQ(free_time({0.5, 0, 0}, {2, 0, 0}, 0, 1, 10), 0);
    // At rest with radii that grow by s^2: bisection finds the time, rounded down.
    EXPECT_LE(free_time({3, 0, 0}, {}, 2, 1, 10), std::sqrt(2.0));
    EXPECT_GT(free_time({3, 0, 0}, {}, 2, 1, 10), 0.7);
    EXPECT_EQ(free_time({3, 0, 0}, {}, 2, 1, 1.25), HUGE_VAL);
}

TEST(MotionBounds, ApproachesByHand) {
    // The root of 2 - s - s^2 is s = 1; a speed bound of 4 alone would prove only half of that.
    const double second = free_time({2, 1, 2, 4});
    EXPECT_NEAR(second, 1, 1e-11);
    EXPECT_LE(second, 1);
    EXPECT_NEAR(free_time({2, 1, 100, 2}), 1, 1e-11); // the first-order bound is better
    EXPECT_NEAR(free_time({3, -2, 2, 9}), 3, 1e-11);  // parting: 3 + 2 s - s^2
    EXPECT_EQ(free_time({1, -1, 0, 1}), HUGE_VAL);
    EXPECT_EQ(free_time({1, 1, 1, 0}), HUGE_VAL);
    EXPECT_EQ(free_time({0, -1, 0, 1}), 0);
}

} // namespace
} // namespace abut::test
