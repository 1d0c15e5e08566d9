/// Clashes over time against dense sampling.
#include <abut/assembly.h>
#include <abut/penetration.h>
#include <abut/rigid.h>
#include <abut/shape_queries.h>

#include "assembly/kinematics.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace abut::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 400;

Mesh random_mesh(Random& random) {
    const double size = random.uniform(0.2, 0.7);
    if (random.chance(0.5))
        return torus_mesh(size, 0.3 * size, 12, 8);
    const Vec3 half{size * random.uniform(0.1, 1), size * random.uniform(0.1, 1),
                    size * random.uniform(0.1, 1)};
    return box_mesh(-1 * half, half);
}

JointKeys random_keys(Random& random, double reach) {
    JointKeys keys;
    double time = 0;
    for (int i = random.integer(2, 4); i > 0; --i) {
        keys.times.push_back(time);
        keys.values.push_back(random.uniform(-reach, reach));
        time += random.uniform(0.2, 1);
    }
    return keys;
}

AssemblyJoint random_joint(Random& random) {
    AssemblyJoint joint;
    joint.origin = random.in_cube(1);
    joint.axis = random.direction();
    switch (random.integer(0, 2)) {
    case 0:
        joint.type = AssemblyJointType::revolute;
        joint.keys = random_keys(random, kPi);
        break;
    case 1:
        joint.type = AssemblyJointType::prismatic;
        joint.keys = random_keys(random, 2);
        break;
    default:
        joint.type = AssemblyJointType::free;
        joint.keys = random_keys(random, 1);
        joint.keys.values.clear();
        for (std::size_t i = 0; i < joint.keys.times.size(); ++i)
            joint.keys.poses.push_back(random.pose(1.5));
    }
    return joint;
}

/// A tree of parts, some with a slider-crank or a four-bar linkage on one of them.
Assembly random_assembly(Random& random) {
    Assembly assembly;
    const int count = random.integer(3, 5);
    for (int i = 0; i < count; ++i) {
        AssemblyPart part{std::string("p").append(std::to_string(i)),
                          "",
                          Model(random_mesh(random)),
                          random.pose(1.2),
                          {},
                          {}};
        if (i > 0 && random.chance(0.7))
            part.on = static_cast<std::uint32_t>(random.integer(0, i - 1));
        if (i == 0 || random.chance(0.8))
            part.joint = random_joint(random);
        assembly.parts.push_back(std::move(part));
    }
    if (random.chance(0.6)) {
        // A crank of 0.5 about z and a rod of 1.5. The slider moves along x; the rocker turns about
        // (1.7, -1.4).
        const bool slides = random.chance(0.5);
        const auto add = [&](const char* name, const Vec3& at, std::optional<std::uint32_t> on) {
            AssemblyPart part{name, "", Model(random_mesh(random)), {}, on, {}};
            part.place.m[9] = at.x;
            part.place.m[10] = at.y;
            part.joint.type = AssemblyJointType::revolute;
            assembly.parts.push_back(std::move(part));
            return static_cast<std::uint32_t>(assembly.parts.size() - 1);
        };
        const std::uint32_t base = static_cast<std::uint32_t>(random.integer(0, count - 1));
        const std::uint32_t crank = add("crank", {0.2, 0, 0}, base);
        assembly.parts[crank].joint.keys = random_keys(random, 5);
        const std::uint32_t rod = add("rod", {1, 0, 0}, crank);
        assembly.parts[rod].joint.origin = {0.5, 0, 0};
        const std::uint32_t closer = add("closer", {2, 0, 0}, base);
        if (slides) {
            assembly.parts[closer].joint.type = AssemblyJointType::prismatic;
            assembly.parts[closer].joint.axis = {1, 0, 0};
        } else {
            assembly.parts[closer].joint.origin = {1.7, -1.4, 0};
        }
        assembly.loops.push_back({rod, closer, {2, 0, 0}});
    }
    return assembly;
}

bool is_in(const std::vector<MotionInterval>& intervals, double time, double slack = 0) {
    return std::ranges::any_of(intervals, [&](const MotionInterval& each) {
        return time >= each.start - slack && time <= each.end + slack;
    });
}

struct Tally {
    unsigned pairs = 0, contacts = 0, contact_samples = 0, approaches = 0, depths = 0, loops = 0,
             free_samples = 0, intervals = 0, tight = 0;
};

/// Compares one clash, or none, with samples of the pair.
class PairCheck {
public:
    PairCheck(const Assembly& assembly, const MotionReport& report, std::uint32_t a,
              std::uint32_t b, Tally& tally)
        : assembly_(assembly), report_(report), a_(a), b_(b), tally_(tally) {
        const auto found = std::ranges::find_if(
            report.clashes, [&](const MotionClash& clash) { return clash.a == a && clash.b == b; });
        if (found != report.clashes.end())
            clash_ = *found;
    }

    void run(const std::vector<std::vector<Transform>>& places, const std::vector<double>& times) {
        ++tally_.pairs;
        for (std::size_t i = 0; i < times.size(); ++i)
            sample(times[i], places[i], i % 16 == 0);
        if (clash_.contacts.empty() && clash_.approaches.empty())
            return;
        const std::vector<Transform> then = part_transforms(assembly_, clash_.gap_time);
        EXPECT_NEAR(gap_at(then), clash_.gap, 1e-9);
        EXPECT_LE(clash_.gap_at_least, clash_.gap);
        tally_.approaches += clash_.kind == MotionClashKind::clearance ? 1 : 0;
        tally_.contacts += clash_.kind == MotionClashKind::contact ? 1 : 0;
        if (clash_.kind == MotionClashKind::clearance) {
            EXPECT_LE(clash_.gap, report_.clearance);
            tally_.tight += clash_.gap_at_least >= 0.97 * clash_.gap - report_.tolerance ? 1 : 0;
        }
        for (const MotionInterval& contact : clash_.contacts) {
            ++tally_.intervals;
            EXPECT_LE(contact.start, contact.end);
            if (contact.seen < 1e9) {
                EXPECT_EQ(gap_at(part_transforms(assembly_, contact.seen)), 0);
            }
            // Both ends are tight: the pair is as near as the tolerance there.
            for (const double time : {contact.start, contact.end})
                if (clash_.status == Status::exact && time > report_.start && time < report_.end) {
                    EXPECT_LE(gap_at(part_transforms(assembly_, time)), 1.2 * report_.tolerance);
                }
        }
    }

private:
    double gap_at(const std::vector<Transform>& places) const {
        const Model& a = assembly_.parts[a_].model;
        const Model& b = assembly_.parts[b_].model;
        const double gap = distance(a, places[a_], b, places[b_]).distance;
        const auto inside = [&](std::uint32_t inner, std::uint32_t outer) {
            const Vec3 point =
                apply(places[inner], assembly_.parts[inner].model.mesh().positions[0]);
            return contains(assembly_.parts[outer].model, places[outer], point).side ==
                   Side::inside;
        };
        return inside(a_, b_) || inside(b_, a_) ? 0 : gap;
    }

    void sample(double time, const std::vector<Transform>& places, bool with_depth) {
        const double gap = gap_at(places);
        if (gap == 0) {
            ++tally_.contact_samples;
            EXPECT_TRUE(is_in(clash_.contacts, time)) << "contact missed at " << time;
        } else {
            ++tally_.free_samples;
            EXPECT_GE(gap, clash_.gap_at_least * (1 - 1e-9));
        }
        // Least gaps are found to 1 %.
        if (gap < 0.98 * report_.clearance - report_.tolerance) {
            EXPECT_TRUE(is_in(clash_.approaches, time)) << "approach missed at " << time;
        }
        if (gap == 0 && with_depth) {
            const Depth depth =
                penetration(assembly_.parts[a_].model, places[a_], assembly_.parts[b_].model,
                            places[b_], {.separation = false});
            EXPECT_LE(depth.depth, clash_.depth_at_most * (1 + 1e-9) + 1e-12);
            ++tally_.depths;
        }
    }

    const Assembly& assembly_;
    const MotionReport& report_;
    std::uint32_t a_, b_;
    Tally& tally_;
    MotionClash clash_;
};

bool are_tested(const Assembly& assembly, std::uint32_t a, std::uint32_t b) {
    if (assembly.parts[a].on == b || assembly.parts[b].on == a)
        return false;
    return std::ranges::none_of(assembly.loops, [&](const AssemblyLoop& loop) {
        return std::minmax(loop.coupler, loop.closer) == std::minmax(a, b);
    });
}

TEST(MotionClashes, NoContactThatSamplingFindsIsMissed) {
    Random random(21);
    Tally tally;
    for (int round = 0; round < many(40); ++round) {
        const Assembly assembly = random_assembly(random);
        tally.loops += assembly.loops.empty() ? 0 : 1;
        const double clearance = random.chance(0.7) ? random.uniform(0.02, 0.3) : 0;
        const MotionReport report = find_motion_clashes(assembly, {.clearance = clearance});
        std::vector<double> times;
        std::vector<std::vector<Transform>> places;
        for (int i = 0; i < kSamples; ++i) {
            times.push_back(random.uniform(report.start, report.end));
            places.push_back(part_transforms(assembly, times.back()));
        }
        const AssemblyKinematics kinematics(assembly);
        for (std::uint32_t a = 0; a < assembly.parts.size(); ++a)
            for (std::uint32_t b = a + 1; b < assembly.parts.size(); ++b) {
                if (!are_tested(assembly, a, b) ||
                    kinematics.rigid_group(a) == kinematics.rigid_group(b))
                    continue;
                PairCheck(assembly, report, a, b, tally).run(places, times);
            }
        if (::testing::Test::HasFailure()) {
            std::cout << "round " << round << '\n';
            return;
        }
    }
    std::cout << tally.pairs << " pairs, " << tally.contacts << " contacts, " << tally.intervals
              << " intervals, " << tally.contact_samples << " samples in contact, "
              << tally.approaches << " approaches, " << tally.tight << " tight bounds, "
              << tally.depths << " depths, " << tally.loops << " loops\n";
    EXPECT_GT(tally.pairs, 150U);
    EXPECT_GT(tally.contacts, 40U);
    EXPECT_GT(tally.intervals, 60U);
    EXPECT_GT(tally.contact_samples, 1000U);
    EXPECT_GT(tally.free_samples, 1000U);
    EXPECT_GT(tally.approaches, 5U);
    EXPECT_GT(tally.tight, tally.approaches * 3 / 4);
    EXPECT_GT(tally.depths, 50U);
    EXPECT_GT(tally.loops, 10U);
}

TEST(MotionClashes, TheResultIsTheSameForAnyNumberOfThreads) {
    Random random(22);
    for (int round = 0; round < many(4); ++round) {
        const Assembly assembly = random_assembly(random);
        std::vector<MotionReport> reports;
        for (const int threads : {1, 4}) {
            set_threads(threads);
            reports.push_back(find_motion_clashes(assembly, {.clearance = 0.1}));
        }
        set_threads(0);
        ASSERT_EQ(reports[0].clashes.size(), reports[1].clashes.size());
        EXPECT_EQ(reports[0].steps, reports[1].steps);
        for (std::size_t i = 0; i < reports[0].clashes.size(); ++i) {
            const MotionClash& p = reports[0].clashes[i];
            const MotionClash& q = reports[1].clashes[i];
            EXPECT_EQ(p.a, q.a);
            EXPECT_EQ(p.b, q.b);
            EXPECT_EQ(p.gap, q.gap);
            EXPECT_EQ(p.gap_time, q.gap_time);
            EXPECT_EQ(p.depth, q.depth);
            EXPECT_EQ(p.contacts.size(), q.contacts.size());
            EXPECT_EQ(p.samples.size(), q.samples.size());
        }
    }
}

} // namespace
} // namespace abut::test
