// Times of impact of bodies that are far larger than what they meet: never late, in few steps. Also
// limits on steps, the stop flag and progress reports.

#include <abut/batch.h>
#include <abut/error.h>
#include <abut/mesh.h>
#include <abut/motion.h>

#include "rigid/model/model_data.h"
#include "rigid/motion/moving_triangles.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <mutex>
#include <numbers>

namespace abut::test {
namespace {

struct LongMotion {
    Model a, b;
    Motion motion_a, motion_b;

    [[nodiscard]] Impact ask(const ImpactOptions& options) const {
        return time_of_impact(a, motion_a, b, motion_b, options);
    }
    [[nodiscard]] double distance_at(double t) const {
        return distance(a, at(motion_a, t), b, at(motion_b, t)).distance;
    }
    [[nodiscard]] bool meets_at(double t) const {
        return collide(a, at(motion_a, t), b, at(motion_b, t)).meet();
    }
};

/// Whether the models meet at a sampled time in [begin, end). Half of the samples are close to the
/// end; local minima of the distance are refined.
bool is_seen_to_meet(const LongMotion& c, double begin, double end) {
    constexpr int kSamples = 60, kSections = 40;
    std::vector<double> times{begin, end - 1e-9 * (end - begin)};
    for (int i = 1; i < kSamples; ++i) {
        const double part = i % 2 == 0 ? double(i) / kSamples : 1 - std::pow(0.75, i / 2 + 1);
        times.push_back(begin + part * (end - begin));
    }
    std::sort(times.begin(), times.end());
    std::vector<double> distances;
    for (const double t : times) {
        distances.push_back(c.distance_at(t));
        if (c.meets_at(t))
            return true;
    }
    for (std::size_t i = 1; i + 1 < times.size(); ++i) {
        if (distances[i] > distances[i - 1] || distances[i] > distances[i + 1])
            continue;
        double low = times[i - 1], high = times[i + 1];
        for (int section = 0; section < kSections; ++section) {
            const double one = low + 0.382 * (high - low), two = low + 0.618 * (high - low);
            if (c.distance_at(one) < c.distance_at(two))
                high = two;
            else
                low = one;
        }
        if (c.meets_at(0.5 * (low + high)))
            return true;
    }
    return false;
}

/// Pairs of one triangle each, with sizes from 1 to 10^digits. Their points near the origin pass
/// each other at speeds of about 1.
class UnlikeTriangles {
public:
    UnlikeTriangles(Random& random, double digits) : random_(random), digits_(digits) {}

    LongMotion make() {
        kind_ = random_.integer(0, 3);
        along_ = random_.direction();
        across_ = perpendicular(along_);
        const Mesh a = triangle(), b = triangle();
        Motion motion_a = random_.chance(0.25) ? Motion::fixed({}) : motion(), motion_b = motion();
        const double gap = std::pow(10, -random_.uniform(0, 6));
        // Some pairs are far from the origin of the world.
        const Vec3 far = random_.chance(0.7)
                             ? Vec3{}
                             : std::pow(10, random_.uniform(3, 7)) * random_.direction();
        for (Motion* motion : {&motion_a, &motion_b})
            motion->start.translation = far, motion->centre = motion->centre + far;
        motion_b.start.translation =
            far + gap * (kind_ == 1 || kind_ == 2 ? cross(along_, across_) : random_.direction());
        return {Model(a), Model(b), motion_a, motion_b};
    }

private:
    double size() { return std::pow(10, random_.uniform(0, digits_)); }

    /// A triangle by kind: any, in almost parallel planes, with almost parallel edges, or close to
    /// the origin.
    Mesh triangle() {
        const auto in_plane = [&] {
            const double angle = random_.uniform(0, 2 * std::numbers::pi);
            return std::cos(angle) * along_ + std::sin(angle) * across_;
        };
        const Vec3 e = kind_ == 1   ? in_plane()
                       : kind_ == 2 ? along_
                                    : random_.direction(),
                   f = kind_ == 1 ? in_plane() : random_.direction();
        const double length = size(), width = random_.chance(0.05)  ? 0
                                              : random_.chance(0.5) ? 1e-3 * size()
                                                                    : size();
        const double back = random_.chance(0.4) ? 0 : random_.uniform(0, 1);
        const Vec3 off = kind_ == 3 ? Vec3{} : 0.5 * random_.direction();
        const Vec3 p = off - random_.uniform(0, 1) * length * e - back * width * f;
        return {{p, p + length * e, p + width * f}, {{0, 1, 2}}};
    }
    Motion motion() {
        const Vec3 centre = (random_.chance(0.5) ? 1.0 : size()) * random_.direction();
        const Vec3 velocity = random_.chance(0.5)
                                  ? Vec3{}
                                  : std::pow(10, random_.uniform(-2, 2)) * random_.direction();
        const Vec3 axis =
            random_.chance(0.3) ? normalized_or_zero(cross(along_, across_)) : random_.direction();
        // At most 16 turns.
        const double rate = std::pow(10, random_.uniform(-1, random_.chance(0.1) ? 2 : 1));
        return {{}, centre, velocity, rate * axis};
    }

    Random& random_;
    double digits_;
    int kind_ = 0;
    Vec3 along_, across_;
};

TEST(LongMotions, TrianglesOfUnlikeSizesStayApart) {
    Random random(3301);
    constexpr int kCases = 3000;
    int proven = 0, beyond = 0, tight = 0;
    for (int i = 0; i < kCases; ++i) {
        const LongMotion c = UnlikeTriangles(random, random.uniform(0, 7)).make();
        const MovingPair pair(c.a.data().tree(), c.a.data().model_from_tree(), c.motion_a,
                              c.b.data().tree(), c.b.data().model_from_tree(), c.motion_b);
        const double begin = random.chance(0.5) ? 0 : random.uniform(0, 1),
                     horizon = (1 - begin) * (random.chance(0.5) ? 1 : random.uniform(0, 1));
        const Triangle a = c.a.data().world_triangle(0, at(c.motion_a, begin)),
                       b = c.b.data().world_triangle(0, at(c.motion_b, begin));
        const ClosestPoints closest = triangle_triangle_distance(a, b);
        if (closest.distance_sq == 0)
            continue;
        const double free = free_time(pair, begin, a, b, closest, horizon);
        if (!(free > 0))
            continue;
        ++proven;
        beyond += free > horizon ? 1 : 0;
        ASSERT_FALSE(is_seen_to_meet(c, begin, begin + std::min(free, horizon))) << "case " << i;
        tight += 2 * free < horizon && is_seen_to_meet(c, begin + free, begin + 2 * free) ? 1 : 0;
    }
    std::cout << proven << " proven, " << beyond << " to the horizon, " << tight << " tight\n";
    EXPECT_GT(proven, kCases / 2);
    EXPECT_GT(beyond, kCases / 20);
    EXPECT_LT(beyond, proven * 9 / 10);
    EXPECT_GT(tight, kCases / 20);
}

TEST(LongMotions, AreNeverLateAndTakeFewSteps) {
    Random random(3302);
    constexpr int kCases = 1500;
    int hits = 0, undecided = 0;
    std::uint64_t most_steps = 0;
    for (int i = 0; i < kCases; ++i) {
        const LongMotion c = UnlikeTriangles(random, random.uniform(0, 7)).make();
        const Impact impact = c.ask({.absolute_error = 1e-6});
        if (impact.time > 0) {
            ASSERT_FALSE(is_seen_to_meet(c, 0, impact.time)) << "case " << i;
        }
        if (impact.meet && impact.status != Status::bound_only) {
            ASSERT_TRUE(c.meets_at(impact.contact_time)) << "case " << i;
        }
        hits += impact.meet ? 1 : 0;
        undecided += impact.status == Status::bound_only ? 1 : 0;
        most_steps = std::max(most_steps, impact.steps);
    }
    std::cout << hits << " hits, " << undecided << " undecided, at most " << most_steps
              << " steps\n";
    EXPECT_GT(hits, kCases / 10);
    EXPECT_LT(hits, kCases * 9 / 10);
    EXPECT_LT(undecided, kCases / 20);
    // Two bodies that turn by 200 rad together take 800 windows of time.
    EXPECT_LT(most_steps, 3000U);
}

Mesh plate(double half, double thickness) {
    return box_mesh({-half, -half, -thickness}, {half, half, thickness});
}
/// A floor of n x n squares in the plane at height z.
Mesh floor_mesh(double half, int n, double z) {
    return grid_mesh(n, n, false, false, [&](double u, double v) {
        return Vec3{half * (2 * u - 1), half * (2 * v - 1), z};
    });
}
/// A needle along x, `width` wide along y.
Mesh needle(double half, double width, double z) {
    return {{{-half, 0, z}, {half, 0, z}, {half, width, z}}, {{0, 1, 2}}};
}
Motion spin(const Vec3& w) {
    return {{}, {}, {}, w};
}

TEST(LongMotions, ALargePlateMeetsASmallBall) {
    const Model ball(sphere_mesh(1, 12, 6)), fine(sphere_mesh(1, 120, 80));
    const Motion beside{{{0.3, 4, 2}, {1, 0, 0, 0}}, {0.3, 4, 2}, {0.1, -1, 0.2}, {1, 2, 3}};
    const Motion still = Motion::fixed({{0.3, 4, 2}, {1, 0, 0, 0}});
    for (const double size : {1e2, 1e3, 1e4, 3e5, 1e6}) {
        const Model large(plate(size, 1e-9 * size));
        for (const auto& [motion_a, motion_b] : {std::pair{spin({0.6, 0, 0}), still},
                                                 {spin({0.6, 0.1, 0.2}), still},
                                                 {spin({0.6, 0.1, 0.2}), beside}}) {
            const LongMotion c{large, ball, motion_a, motion_b};
            const Impact impact = c.ask({.absolute_error = 8e-5});
            EXPECT_TRUE(impact.meet);
            EXPECT_EQ(impact.status, Status::exact);
            EXPECT_LE(impact.gap, 8e-5);
            EXPECT_LE(impact.contact_time - impact.time, 3e-4);
            EXPECT_TRUE(c.meets_at(impact.contact_time));
            EXPECT_FALSE(is_seen_to_meet(c, 0, impact.time));
            EXPECT_LT(impact.steps, 3000U) << size;
            // The same pair in the other order.
            const Impact swapped =
                time_of_impact(ball, motion_b, large, motion_a, {.absolute_error = 8e-5});
            EXPECT_TRUE(swapped.meet);
            EXPECT_LE(swapped.time, impact.contact_time);
            EXPECT_LE(impact.time, swapped.contact_time);
            EXPECT_LT(swapped.steps, 3000U) << size;
        }
        // Boxes of nodes are compared along axes that turn with the plate.
        const Impact impact =
            time_of_impact(large, spin({0.6, 0.1, 0.2}), fine, still, {.absolute_error = 8e-5});
        EXPECT_TRUE(impact.meet);
        // For larger plates single precision is too coarse: balls around small boxes are compared
        // with them.
        EXPECT_LT(impact.steps, size <= 1e3 ? 3000U : 10000U) << size;
    }
}

TEST(LongMotions, NeedlesPassAndPlatesSlideInFewSteps) {
    for (const double size : {1.0, 1e2, 1e4, 1e6}) {
        const Model low(needle(size, 1e-3, 0)), high(needle(size, 1e-3, 1e-3));
        for (const Vec3& w : {Vec3{0, 0, 2}, {0.01, 0, 2}, {1, 1, 2}, {1, 0, 2}, {-1, 0.3, 2}}) {
            const LongMotion c{low, high, spin(w), Motion::fixed({})};
            const Impact impact = c.ask({.absolute_error = 1e-4});
            EXPECT_FALSE(is_seen_to_meet(c, 0, impact.time));
            EXPECT_LT(impact.steps, 300U) << size << ' ' << w.x << ' ' << w.y;
            EXPECT_FALSE(impact.meet && impact.status == Status::bound_only);
        }
        // The gap is just above the smallest tolerance, and below the others.
        for (const double tolerance : {1e-4, 1e-3, 1.0})
            for (const double tilt : {0.0, 1e-5 / size}) {
                const LongMotion c{Model(floor_mesh(size, 3, 0)),
                                   Model(floor_mesh(size, 3, 1.1e-4)),
                                   Motion{{}, {}, {0.1, 0.2, 0}, {tilt, 0, 1}}, spin({0, 0, 3})};
                const Impact impact = c.ask({.absolute_error = tolerance});
                EXPECT_FALSE(impact.meet) << size << ' ' << tolerance << ' ' << tilt;
                EXPECT_EQ(impact.status, Status::exact);
                EXPECT_LT(impact.steps, 60000U) << size << ' ' << tolerance << ' ' << tilt;
            }
    }
}

TEST(LongMotions, NestedCylindersTurnInEachOther) {
    constexpr int kSides = 24;
    const auto cylinder = [](double radius) {
        return Model(grid_mesh(kSides, 1, true, false, [&](double u, double v) {
            const double angle = 2 * std::numbers::pi * u;
            return Vec3{radius * std::cos(angle), radius * std::sin(angle), 4 * v - 2};
        }));
    };
    const Model outer = cylinder(1);
    for (const double gap : {1e-2, 1e-5, 1e-8}) {
        const Model inner = cylinder(std::cos(std::numbers::pi / kSides) - gap);
        for (const double tolerance : {1e-9, 2 * gap}) {
            const Impact impact = time_of_impact(outer, spin({0, 0, -1}), inner,
                                                 Motion{{}, {}, {0, 0, 0.1}, {0, 0, 2}},
                                                 {.absolute_error = tolerance});
            EXPECT_FALSE(impact.meet) << gap << ' ' << tolerance;
            EXPECT_LT(impact.steps, 200000U) << gap << ' ' << tolerance;
        }
        // A slightly larger cylinder cannot turn inside the other.
        const Model tight = cylinder(1 - 1e-3 * gap);
        const Impact impact = time_of_impact(outer, Motion::fixed({}), tight, spin({0, 0, 1}),
                                             {.absolute_error = 1e-10});
        EXPECT_TRUE(impact.meet);
        EXPECT_LT(impact.time, 1);
    }
}

/// Diagonal of the model's bounding box.
double diagonal(const Model& model) {
    const Box3 box = inspect(model.mesh()).bounds;
    return length(box.upper - box.lower);
}

/// A motion that starts outside and meets the other body at about half of its path.
Motion motion_towards(Random& random, const Vec3& at, double distance) {
    const Vec3 from = at + distance * random.direction();
    Pose start = random.pose(0);
    start.translation = from;
    return {start, from, 2 * (at + random.in_cube(0.2) - from), random.in_cube(2)};
}

TEST(LongMotions, TheDefaultToleranceIsAMillionthOfTheLargerDiagonal) {
    Random random(3304);
    constexpr int kCases = 1500;
    int hits = 0, large = 0;
    for (int i = 0; i < kCases; ++i) {
        // With few triangles, the diagonal of the tree's box may exceed that of the bounding box.
        const auto make = [&] {
            return Model(
                soup_mesh(random, random.integer(1, 6), 0.5 * random.uniform(0.1, 1), 0.6));
        };
        const Model a = make(), b = make();
        const Impact impact =
            time_of_impact(a, motion_towards(random, {}, 3), b, Motion::fixed(random.pose(0)));
        if (!impact.meet || impact.status != Status::exact)
            continue;
        ++hits;
        const double share = impact.gap / std::max(diagonal(a), diagonal(b));
        ASSERT_LE(share, 1e-6) << "case " << i;
        large += share > 0.8e-6 ? 1 : 0;
    }
    std::cout << hits << " hits, " << large << " with a gap near the tolerance\n";
    EXPECT_GT(hits, kCases / 10);
    EXPECT_GT(large, hits / 50);
}

TEST(LongMotions, AGapAboveTheToleranceIsNotExact) {
    // At coordinates of 1e7, rounding errors are about as large as the default tolerance.
    Random random(3305);
    constexpr int kCases = 1500;
    std::array<int, 3> of_status{};
    for (int i = 0; i < kCases; ++i) {
        const Vec3 far = std::pow(10, random.uniform(6, 8)) * random.direction();
        const Model a(sphere_mesh(1, 8, 5)), b(box_mesh({-1, -0.5, -0.3}, {1, 0.5, 0.3}));
        const Motion motion_a = motion_towards(random, far, 4);
        Pose pose = random.pose(0);
        pose.translation = far;
        const std::optional<double> tolerance =
            random.chance(0.5) ? std::optional<double>() : std::pow(10, random.uniform(-9, -4));
        const Impact impact =
            time_of_impact(a, motion_a, b, Motion::fixed(pose), {.absolute_error = tolerance});
        if (!impact.meet)
            continue;
        ++of_status.at(static_cast<std::size_t>(impact.status));
        const double allowed = tolerance.value_or(1e-6 * std::min(diagonal(a), diagonal(b)));
        if (impact.status == Status::exact) {
            ASSERT_LE(impact.gap, allowed) << "case " << i;
        }
        if (impact.status == Status::converged) {
            ASSERT_GT(impact.gap, allowed) << "case " << i;
            ASSERT_LE(impact.gap, 1e-12 * length(far)) << "case " << i;
        }
        if (impact.status != Status::bound_only) {
            ASSERT_TRUE(collide(a, at(motion_a, impact.contact_time), b, Transform(pose)).meet());
            ASSERT_LE(impact.time, impact.contact_time);
        }
    }
    std::cout << of_status[0] << " exact, " << of_status[1] << " converged, " << of_status[2]
              << " undecided\n";
    EXPECT_GT(of_status[0], kCases / 10);
    EXPECT_GT(of_status[1], kCases / 10);
    EXPECT_LT(of_status[2], kCases / 20);
}

TEST(LongMotions, ALimitOnStepsLeavesAProvenTime) {
    Random random(3303);
    int limited = 0, misses = 0;
    for (int i = 0; i < 60; ++i) {
        const LongMotion c =
            i % 2 == 0
                ? UnlikeTriangles(random, 4).make()
                : LongMotion{
                      Model(torus_mesh(0.6, 0.2, 10, 5)), Model(soup_mesh(random, 30, 0.6, 0.3)),
                      Motion{{}, {}, random.in_cube(2), random.in_cube(3)},
                      Motion::fixed({random.uniform(1.2, 2) * random.direction(), {1, 0, 0, 0}})};
        const Impact whole = c.ask({.absolute_error = 1e-6});
        EXPECT_FALSE(whole.out_of_steps);
        misses += whole.meet ? 0 : 1;
        double before = 0;
        for (const std::uint64_t share : {0, 1, 2, 4, 8, 12, 15}) {
            const std::uint64_t most = whole.steps * share / 16;
            const Impact impact = c.ask({.absolute_error = 1e-6, .max_steps = most});
            if (!impact.out_of_steps) // no step was left to do
                continue;
            ++limited;
            EXPECT_LT(most, whole.steps);
            EXPECT_EQ(impact.steps, most);
            EXPECT_TRUE(impact.meet);
            EXPECT_EQ(impact.status, Status::bound_only);
            EXPECT_EQ(impact.gap, std::numeric_limits<double>::infinity());
            EXPECT_EQ(impact.contact_time, std::numeric_limits<double>::infinity());
            EXPECT_LE(before, impact.time);
            EXPECT_LE(impact.time, whole.time);
            before = impact.time;
        }
        const Impact enough = c.ask({.absolute_error = 1e-6, .max_steps = whole.steps});
        EXPECT_FALSE(enough.out_of_steps);
        EXPECT_EQ(enough.time, whole.time);
        EXPECT_EQ(enough.steps, whole.steps);
    }
    std::cout << limited << " limited, " << misses << " misses\n";
    EXPECT_GT(limited, 100);
    EXPECT_GT(misses, 5);
}

TEST(LongMotions, StopAndReportProgress) {
    const LongMotion c{Model(torus_mesh(0.6, 0.2, 40, 20)), Model(torus_mesh(0.6, 0.2, 40, 20)),
                       Motion{{{-2, 0, 0}, {1, 0, 0, 0}}, {-2, 0, 0}, {1.5, 0, 0}, {1, 2, 3}},
                       Motion::fixed({})};
    const auto is_interrupted = [](const auto& query) {
        try {
            (void)query();
        } catch (const Error& error) {
            return error.code() == ErrorCode::interrupted;
        }
        return false;
    };
    std::atomic<bool> stop = true;
    const std::vector<MotionPair> motions(20, {c.motion_a, c.motion_b});
    const auto one = [&](const ImpactOptions& options) { return c.ask(options); };
    const auto many = [&](const ImpactOptions& options) {
        return time_of_impact(c.a, c.b, motions, options);
    };
    EXPECT_TRUE(is_interrupted([&] { return one({.progress = {{}, &stop}}); }));
    EXPECT_TRUE(is_interrupted([&] { return many({.progress = {{}, &stop}}); }));
    // A report in the middle of the work sets the stop flag.
    std::mutex reporting;
    std::vector<double> reports;
    const auto stop_at = [&](double fraction) {
        stop = false;
        reports.clear();
        return Progress{[&, fraction](std::string_view, double done) {
                            const std::unique_lock lock(reporting, std::try_to_lock);
                            EXPECT_TRUE(lock.owns_lock()) << "two reports at once";
                            reports.push_back(done);
                            if (done >= fraction)
                                stop = true;
                        },
                        &stop};
    };
    EXPECT_TRUE(is_interrupted([&] { return one({.progress = stop_at(0.2)}); }));
    EXPECT_GT(reports.size(), 1U);
    EXPECT_TRUE(is_interrupted([&] { return many({.progress = stop_at(0.5)}); }));
    EXPECT_GT(reports.size(), 1U);
    EXPECT_TRUE(one({.progress = stop_at(2)}).meet);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    EXPECT_EQ(many({.progress = stop_at(2)}).size(), motions.size());
}

} // namespace
} // namespace abut::test
