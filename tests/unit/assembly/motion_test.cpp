#include <abut/assembly.h>
#include <abut/error.h>
#include <abut/rigid.h>

#include "assembly/time_search.h"
#include "math/vector.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace abut::test {
namespace {

constexpr double kPi = std::numbers::pi;

AssemblyPart part(const std::string& name, const Vec3& lower, const Vec3& upper,
                  AssemblyJoint joint = {}, std::optional<std::uint32_t> on = {}) {
    return {name, "", Model(box_mesh(lower, upper)), {}, on, std::move(joint)};
}

AssemblyJoint slide(const Vec3& axis, std::vector<double> times, std::vector<double> values) {
    return {
        AssemblyJointType::prismatic, {}, axis, {}, {std::move(times), std::move(values), {}}, {}};
}

AssemblyJoint turn(const Vec3& origin, std::vector<double> times, std::vector<double> values) {
    return {AssemblyJointType::revolute,
            origin,
            {0, 0, 1},
            {},
            {std::move(times), std::move(values), {}},
            {}};
}

Vec3 moved(const Assembly& assembly, double time, std::uint32_t part, const Vec3& point) {
    return apply(part_transforms(assembly, time)[part], point);
}

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-9)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// A crank of radius 1, a rod of length 3 and a slider along x. All turn about z.
Assembly slider_crank(std::vector<double> times, std::vector<double> values) {
    const Vec3 small{0.1, 0.1, 0.1};
    Assembly assembly;
    assembly.parts = {
        part("crank", -1 * small, small, turn({}, std::move(times), std::move(values))),
        part("rod", Vec3{1, 0, 0} - small, Vec3{1, 0, 0} + small, turn({1, 0, 0}, {}, {}), 0),
        part("piston", Vec3{4, 0, 0} - small, Vec3{4, 0, 0} + small, slide({1, 0, 0}, {}, {}))};
    assembly.loops = {{1, 2, {4, 0, 0}}};
    return assembly;
}

TEST(AssemblyMotion, ASliderCrankIsSolvedExactly) {
    const Assembly assembly = slider_crank({0, 1}, {0, 4 * kPi});
    for (const double time : {0.0, 0.1, 0.25, 0.37, 0.5, 0.83}) {
        const double angle = 4 * kPi * time;
        const double x = std::cos(angle) + std::sqrt(9 - std::sin(angle) * std::sin(angle));
        expect_near(moved(assembly, time, 2, {4, 0, 0}), {x, 0, 0});
        expect_near(moved(assembly, time, 1, {4, 0, 0}), {x, 0, 0});
        expect_near(moved(assembly, time, 1, {1, 0, 0}), {std::cos(angle), std::sin(angle), 0});
    }
}

TEST(AssemblyMotion, AFourBarLinkageKeepsItsLengths) {
    Assembly assembly = slider_crank({0, 1}, {0, 4 * kPi});
    // The rocker turns about (3.5, -2.5), so that crank 1, rod 3, rocker 2.55 and base 4.3 go round.
    assembly.parts[2].joint = turn({3.5, -2.5, 0}, {}, {});
    for (const double sign : {1.0, -1.0}) {
        assembly.parts[2].joint.axis = {0, 0, sign};
        double largest = 0;
        for (int i = 0; i <= 40; ++i) {
            const double time = i / 40.0;
            const Vec3 pin = moved(assembly, time, 2, {4, 0, 0});
            expect_near(moved(assembly, time, 1, {4, 0, 0}), pin);
            EXPECT_NEAR(length(pin - Vec3{3.5, -2.5, 0}), std::sqrt(6.5), 1e-9);
            largest = std::max(largest, length(pin - Vec3{4, 0, 0}));
        }
        EXPECT_GT(largest, 1.5);
    }
}

TEST(AssemblyMotion, FollowersAndFreeJoints) {
    Assembly assembly;
    assembly.parts = {part("wheel", {}, {1, 1, 1}, turn({}, {0, 2}, {0, kPi})),
                      part("pinion", {}, {1, 1, 1}, turn({5, 0, 0}, {}, {})),
                      part("hand", {}, {1, 1, 1})};
    assembly.parts[1].joint.follow = JointFollow{0, -2, 0.5 * kPi};
    assembly.parts[2].joint.type = AssemblyJointType::free;
    const double half = std::sqrt(0.5);
    assembly.parts[2].joint.keys = {{0, 2}, {}, {{}, {{4, 0, 0}, {half, 0, 0, half}}}};
    // At time 1 the wheel has turned by 90 degrees, the pinion by -180 + 90.
    expect_near(moved(assembly, 1, 0, {1, 0, 0}), {0, 1, 0});
    expect_near(moved(assembly, 1, 1, {6, 0, 0}), {5, -1, 0});
    expect_near(moved(assembly, 1, 2, {1, 0, 0}), Vec3{2, 0, 0} + half * Vec3{1, 1, 0});
    expect_near(moved(assembly, 7, 2, {1, 0, 0}), {4, 1, 0});
    EXPECT_EQ(time_range(assembly), std::pair(0.0, 2.0));
}

TEST(MotionClashes, ABoxThatPassesThroughAnother) {
    // The box moves by 10 a second. It reaches the other one after a gap of 2, and leaves it after
    // 2 + 1 + 1 = 4. The depth is largest halfway, where the boxes coincide in x.
    Assembly assembly;
    assembly.parts = {
        part("still", {3, 0, 0}, {4, 1, 1}),
        part("moving", {0, 0.2, 0.3}, {1, 0.8, 0.7}, slide({1, 0, 0}, {0, 1}, {0, 10}))};
    const MotionReport report = find_motion_clashes(assembly, {.clearance = 0.5});
    ASSERT_EQ(report.clashes.size(), 1U);
    const MotionClash& clash = report.clashes[0];
    EXPECT_EQ(clash.kind, MotionClashKind::contact);
    EXPECT_EQ(clash.status, Status::exact);
    ASSERT_EQ(clash.contacts.size(), 1U);
    EXPECT_LE(clash.contacts[0].start, 0.2);
    EXPECT_NEAR(clash.contacts[0].start, 0.2, 2e-6);
    EXPECT_GE(clash.contacts[0].end, 0.4 - 1e-12);
    EXPECT_NEAR(clash.contacts[0].end, 0.4, 2e-6);
    ASSERT_EQ(clash.approaches.size(), 1U);
    EXPECT_NEAR(clash.approaches[0].start, 0.15, 2e-6);
    EXPECT_NEAR(clash.approaches[0].end, 0.45, 2e-6);
    EXPECT_EQ(clash.gap, 0);
    EXPECT_GT(clash.depth, 0.15);
    EXPECT_LE(clash.depth, clash.depth_at_most);
    EXPECT_LT(clash.depth_at_most, 1);
    EXPECT_EQ(report.pairs, 1U);
    EXPECT_EQ(report.near, 1U);
}

TEST(MotionClashes, AThinPlateIsNotPassedUnseen) {
    // The bullet needs a microsecond for the plate, and the keys are a second apart.
    Assembly assembly;
    assembly.parts = {
        part("plate", {500, -1, -1}, {500.0001, 1, 1}),
        part("bullet", {0, 0, 0}, {0.0001, 0.01, 0.01}, slide({1, 0, 0}, {0, 1}, {0, 1000}))};
    const MotionReport report = find_motion_clashes(assembly);
    ASSERT_EQ(report.clashes.size(), 1U);
    EXPECT_NEAR(report.clashes[0].contacts.at(0).start, 0.5, 1e-6);
    EXPECT_LT(report.clashes[0].contacts.at(0).seen, 0.500001);
    assembly.parts[0] = part("plate", {500, 0.0201, -1}, {500.0001, 1, 1});
    EXPECT_TRUE(find_motion_clashes(assembly).clashes.empty());
    const MotionReport near = find_motion_clashes(assembly, {.clearance = 0.02});
    ASSERT_EQ(near.clashes.size(), 1U);
    EXPECT_NEAR(near.clashes[0].gap, 0.0101, 1e-9);
    EXPECT_LE(near.clashes[0].gap_at_least, 0.0101);
    EXPECT_GT(near.clashes[0].gap_at_least, 0.0099);
}

TEST(MotionClashes, APartInsideASolidMeetsIt) {
    Assembly assembly;
    assembly.parts = {part("room", {-10, -10, -10}, {10, 10, 10}),
                      part("ball", {}, {1, 1, 1}, slide({1, 0, 0}, {0, 1}, {0, 2}))};
    const MotionReport report = find_motion_clashes(assembly);
    ASSERT_EQ(report.clashes.size(), 1U);
    EXPECT_EQ(report.clashes[0].contacts.at(0).start, 0);
    EXPECT_EQ(report.clashes[0].contacts.at(0).end, 1);
}

TEST(MotionClashes, PairsThatAreLeftOut) {
    Assembly assembly = slider_crank({0, 1}, {0, 4 * kPi});
    assembly.parts.push_back(part("wall", {-9, -9, -0.1}, {9, 9, 0.1}));
    assembly.parts.push_back(part("pipe", {-9, -9, -0.1}, {9, 9, 0.1}, {}, 3));
    assembly.ignored = {{3, 0}};
    const MotionReport report = find_motion_clashes(assembly);
    EXPECT_EQ(report.pairs, 10U);
    EXPECT_EQ(report.still, 1U);  // wall and pipe
    EXPECT_EQ(report.joined, 2U); // crank and rod, rod and piston
    EXPECT_EQ(report.ignored, 1U);
    EXPECT_EQ(report.clashes.size(), 5U); // crank, rod and piston with wall and pipe, less one
    EXPECT_EQ(find_motion_clashes(assembly, {.joined = true}).joined, 0U);
}

TEST(MotionClashes, SlidingOverASmallGapIsCountedButNotMissed) {
    // The gap is half the tolerance all the time, so contact is reported, and not seen.
    Assembly assembly;
    assembly.parts = {part("table", {-9, -9, -1}, {9, 9, 0}),
                      part("block", {0, 0, 5e-6}, {1, 1, 1}, slide({1, 0, 0}, {0, 1}, {0, 2}))};
    const MotionReport report = find_motion_clashes(assembly);
    ASSERT_EQ(report.clashes.size(), 1U);
    EXPECT_EQ(report.clashes[0].status, Status::bound_only);
    EXPECT_EQ(report.clashes[0].contacts.size(), 1U);
    EXPECT_NEAR(report.clashes[0].gap, 5e-6, 1e-9);
    // Beyond the tolerance, many small steps prove that it is free, or the steps run out.
    assembly.parts[1] = part("block", {0, 0, 5e-4}, {1, 1, 1}, slide({1, 0, 0}, {0, 1}, {0, 2}));
    EXPECT_TRUE(find_motion_clashes(assembly).clashes.empty());
    const MotionReport coarse = find_motion_clashes(assembly, {.max_steps = 50});
    ASSERT_EQ(coarse.clashes.size(), 1U);
    EXPECT_EQ(coarse.clashes[0].status, Status::bound_only);
}

void expect_bad(const Assembly& assembly, const std::string& words) {
    try {
        (void)find_motion_clashes(assembly);
        FAIL() << words;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(MotionClashes, BadAssemblies) {
    const Assembly good = slider_crank({0, 1}, {0, 4 * kPi});
    Assembly bad = good;
    bad.parts[0].on = 1;
    expect_bad(bad, "cycle");
    bad = good;
    bad.parts[0].on = 9;
    expect_bad(bad, "out of range");
    bad = good;
    bad.parts[0].joint.axis = {};
    expect_bad(bad, "'crank': its axis has length 0");
    bad = good;
    bad.parts[0].joint.keys.times = {1, 0};
    expect_bad(bad, "do not ascend");
    bad = good;
    bad.parts[0].joint.keys.values = {0, std::nan("")};
    expect_bad(bad, "not finite");
    bad = good;
    bad.parts[0].joint.limits = {0, 1};
    expect_bad(bad, "beyond its limits");
    bad = good;
    bad.parts[0].joint.keys = {};
    expect_bad(bad, "nothing moves");
    bad = good;
    bad.loops[0].pin = {4, 0.5, 0}; // the rod is shorter than its way at the side
    bad.parts[1].joint.origin = {1, 0, 0};
    bad.parts[0].joint.origin = {-5, 0, 0};
    expect_bad(bad, "cannot close");
    bad = good;
    bad.parts[2].joint.axis = {0, 0, 1};
    expect_bad(bad, "not normal");
    bad = good;
    bad.parts[2].joint.axis = {0, 1, 0};
    expect_bad(bad, "dead point");
}

TEST(MotionClashes, ACrankThatLeavesThePlaneOfItsLoop) {
    Assembly assembly = slider_crank({0, 1}, {0, 4 * kPi});
    assembly.parts.push_back(
        part("base", {8, 8, 8}, {9, 9, 9}, slide({0, 0, 1}, {0, 1}, {0, 0.5})));
    assembly.parts[0].on = 3;
    expect_bad(assembly, "leaves its plane");
    assembly.parts[2].on = 3; // the slider goes along
    EXPECT_EQ(find_motion_clashes(assembly).start, 0);
}

TEST(MotionClashes, AJointWithoutKeysStaysWithinItsLimits) {
    Assembly assembly = slider_crank({0, 1}, {0, 4 * kPi});
    assembly.parts.push_back(part("lid", {8, 8, 8}, {9, 9, 9}, turn({}, {}, {})));
    assembly.parts[3].joint.limits = {1, 2};
    expect_bad(assembly, "'lid': the value 0");
}

TEST(MotionClashes, ARoundingThatFarOriginsCauseIsNotHidden) {
    Assembly assembly;
    assembly.parts = {part("still", {3, 0, 0}, {4, 1, 1}),
                      part("arm", {0, 0, 0}, {1, 1, 1}, turn({0, 1e6, 0}, {0, 1}, {0, 1e-5}))};
    expect_bad(assembly, "the tolerance is below the rounding");
}

TEST(MotionClashes, ATinyStepBecomesCoarse) {
    Assembly assembly;
    assembly.parts = {part("table", {-9, -9, -1}, {9, 9, 0}),
                      part("block", {0, 0, -0.1}, {1, 1, 1}, slide({1, 0, 0}, {0, 1}, {0, 2}))};
    const MotionReport report = find_motion_clashes(assembly, {.step = 1e-300, .max_steps = 100});
    ASSERT_EQ(report.clashes.size(), 1U);
    EXPECT_EQ(report.clashes[0].contacts.size(), 1U);
    EXPECT_LT(report.steps, 10'000U);
}

TEST(TimeSearch, FindsTheLeastValueWithItsBound) {
    // |sin| has rate 1 and a zero at pi, where all values nearby are small.
    const auto measure = [](double time) {
        const double value = std::abs(std::sin(time));
        return TimeValue{time, value, value};
    };
    TimeSearch search(measure, [](double from, double to) { return to - from; });
    search.add(measure(1), measure(5));
    search.run(1e-6, 0, 1000);
    EXPECT_NEAR(search.best().time, kPi, 1e-5);
    EXPECT_LE(search.best().value - search.at_least(), 1e-6);
    EXPECT_LE(search.at_least(), 0);
}

} // namespace
} // namespace abut::test
