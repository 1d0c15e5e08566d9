// Times of impact against subdivision of time; batches against single queries.

#include <abut/batch.h>
#include <abut/error.h>
#include <abut/motion.h>

#include "tests/support/infinity.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

constexpr int kKinds = 7;

Mesh make_moving_mesh(Random& random, int kind) {
    switch (kind) {
    case 0:
        return box_mesh({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3});
    case 1:
        return sphere_mesh(0.6, 8, 5);
    case 2: // an exactly flat plate
        return grid_mesh(3, 3, false, false, [](double u, double v) {
            return Vec3{0, 1.5 * u - 0.75, 1.5 * v - 0.75};
        });
    case 3: { // needles: some are 1e6 times longer than wide, and two have no width
        Mesh m;
        for (std::uint32_t i = 0; i < 8; ++i) {
            const Vec3 p = random.in_cube(0.6), q = p + 1.2 * random.direction();
            m.positions.insert(m.positions.end(),
                               {p, q, q + (i < 6 ? 1e-6 : 0) * random.direction()});
            m.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        return m;
    }
    case 4:
        return torus_mesh(0.6, 0.2, 10, 5);
    case 5:
        return soup_mesh(random, 30, 0.6, 0.3);
    default:
        return with_degenerates(random, sphere_mesh(0.5, 6, 4), 8);
    }
}

/// A motion that starts outside. It meets the other body about as often as it passes.
Motion make_motion(Random& random) {
    const Vec3 from = random.uniform(1.5, 3) * random.direction();
    const Vec3 to = random.in_cube(2.7) - random.uniform(0, 1) * from;
    Pose start = random.pose(0), end = random.pose(0);
    start.translation = from, end.translation = to;
    switch (random.integer(0, 5)) {
    case 0:
        return Motion::screw(start, end);
    case 1: { // so fast that sampling would miss a plate
        Motion motion = Motion::between(start, {to, start.rotation});
        motion.velocity = std::pow(10, random.uniform(1, 6)) * motion.velocity;
        return motion;
    }
    case 2: // several turns
        return {start, from, to - from, random.uniform(5, 40) * random.direction()};
    case 3: // straight
        return Motion::between(start, {to, start.rotation});
    default:
        return Motion::between(start, end, random.in_cube(0.5));
    }
}

Motion make_other_motion(Random& random) {
    const Pose pose = random.pose(0.2);
    if (random.chance(0.4))
        return Motion::fixed(pose);
    return {pose, random.in_cube(0.5), random.in_cube(0.4),
            random.uniform(0, 2) * random.direction()};
}

struct MotionCase {
    Model a, b;
    Motion motion_a, motion_b;

    [[nodiscard]] Transform world_a(double t) const { return at(motion_a, t); }
    [[nodiscard]] Transform world_b(double t) const { return at(motion_b, t); }
    [[nodiscard]] double distance_at(double t) const {
        return distance(a, world_a(t), b, world_b(t)).distance;
    }
};

MotionCase make_case(Random& random, int i) {
    const Mesh a = make_moving_mesh(random, i % kKinds),
               b = make_moving_mesh(random, i / kKinds % kKinds);
    const Motion motion_a = make_motion(random);
    return {Model(a), Model(b), motion_a, make_other_motion(random)};
}

/// Upper bound on the speed of the body's points.
double speed_of(const Model& model, const Motion& motion) {
    const Transform start(motion.start);
    double arm = 0;
    for (const Vec3& p : model.mesh().positions)
        arm = std::max(arm, length(apply(start, p) - motion.centre));
    return length(motion.velocity) + length(motion.angular_velocity) * arm;
}

/// Time of the first contact, by bisection: a half is free if the distance at its middle exceeds
/// the distance that the bodies can cover in it.
struct FirstContact {
    double not_before = 1;      ///< proven free up to here
    double contact = kInfinity; ///< a contact was found here
};

class Subdivision {
public:
    explicit Subdivision(const MotionCase& c)
        : case_(c), speed_(speed_of(c.a, c.motion_a) + speed_of(c.b, c.motion_b)) {}

    FirstContact run() {
        for (const double end : {0.0, 1.0})
            if (case_.distance_at(end) == 0)
                found_.contact = std::min(found_.contact, end);
        search(0, 1);
        found_.not_before = std::min(found_.not_before, found_.contact);
        return found_;
    }

private:
    void search(double begin, double end) {
        if (begin >= found_.contact || begin >= found_.not_before)
            return;
        const double middle = 0.5 * (begin + end), gap = case_.distance_at(middle);
        if (gap == 0)
            found_.contact = std::min(found_.contact, middle);
        if (gap > 0.5 * (end - begin) * speed_ * (1 + 1e-9) + 1e-12)
            return;
        if ((end - begin) * speed_ < 1e-6) {
            found_.not_before = std::min(found_.not_before, begin);
            return;
        }
        search(begin, middle);
        search(middle, end);
    }

    const MotionCase& case_;
    double speed_;
    FirstContact found_;
};

/// Checks one motion. Returns whether the models meet.
bool check(const MotionCase& c, int& undecided) {
    const double tolerance = 1e-5;
    const Impact impact =
        time_of_impact(c.a, c.motion_a, c.b, c.motion_b, {.absolute_error = tolerance});
    const FirstContact truth = Subdivision(c).run();
    // The reported time is not late, and no contact is missed.
    EXPECT_LE(impact.time, truth.contact);
    EXPECT_EQ(impact.meet || truth.contact <= 1, impact.meet);
    EXPECT_EQ(impact.time == 0, truth.contact == 0);
    if (impact.meet) {
        // At that time another pair of triangles may be nearer.
        EXPECT_LE(c.distance_at(impact.time), impact.gap + 0x1p-48);
        EXPECT_LE(impact.gap, tolerance);
        if (impact.time > 0) {
            EXPECT_NEAR(length(impact.point_b - impact.point_a), impact.gap,
                        1e-13 * speed_of(c.a, c.motion_a));
        }
    }
    if (impact.status == Status::bound_only) {
        ++undecided;
        EXPECT_TRUE(impact.meet);
        EXPECT_EQ(impact.contact_time, kInfinity);
    } else if (impact.meet) {
        EXPECT_GE(impact.contact_time, truth.not_before);
        EXPECT_LE(impact.contact_time, 1);
        EXPECT_TRUE(
            collide(c.a, c.world_a(impact.contact_time), c.b, c.world_b(impact.contact_time))
                .meet());
    }
    // In the other order, the answer is the same as far as it is proven.
    const Impact swapped =
        time_of_impact(c.b, c.motion_b, c.a, c.motion_a, {.absolute_error = tolerance});
    if (impact.status == Status::exact && swapped.status == Status::exact) {
        EXPECT_EQ(swapped.meet, impact.meet);
        EXPECT_LE(swapped.time, impact.meet ? impact.contact_time : 1);
        EXPECT_LE(impact.time, swapped.meet ? swapped.contact_time : 1);
    }
    return impact.meet;
}

TEST(TimeOfImpact, IsNeverLateAndMissesNothing) {
    Random random(2100);
    constexpr int kCases = 1000;
    int hits = 0, undecided = 0;
    for (int i = 0; i < kCases; ++i) {
        hits += check(make_case(random, i), undecided) ? 1 : 0;
        ASSERT_FALSE(HasFailure()) << "case " << i;
    }
    std::cout << hits << " hits, " << undecided << " undecided\n";
    EXPECT_GT(hits, kCases * 3 / 10);
    EXPECT_LT(hits, kCases * 7 / 10);
    EXPECT_LT(undecided, kCases / 50);
}

std::vector<Placement> make_placements(Random& random, int count) {
    std::vector<Placement> placements;
    for (int i = 0; i < count; ++i) {
        Transform world_b = random.pose(0);
        const Vec3 off = random.uniform(0.2, 2) * random.direction();
        world_b.m[9] = off.x, world_b.m[10] = off.y, world_b.m[11] = off.z;
        placements.push_back({random.pose(0.2), world_b});
    }
    return placements;
}

void expect_same(const Counters& one, const Counters& other) {
    EXPECT_EQ(one.volume_tests, other.volume_tests);
    EXPECT_EQ(one.primitive_tests, other.primitive_tests);
    EXPECT_EQ(one.exact_tests, other.exact_tests);
}

TEST(Batch, EqualsSingleQueries) {
    Random random(2101);
    const Model a(torus_mesh(1, 0.35, 12, 7)), b(sphere_mesh(0.5, 9, 6));
    const std::vector<Placement> placements = make_placements(random, 300);
    const auto contacts = collide(a, b, placements, {.mode = ContactMode::all});
    const auto gaps = distance(a, b, placements, {.upper_bound = 0.5});
    const auto near = within(a, b, placements, 0.1);
    ASSERT_EQ(contacts.size(), placements.size());
    ASSERT_EQ(gaps.size(), placements.size());
    ASSERT_EQ(near.size(), placements.size());
    int meet = 0;
    for (std::size_t i = 0; i < placements.size(); ++i) {
        const auto& [world_a, world_b] = placements[i];
        const Contacts contact = collide(a, world_a, b, world_b, {.mode = ContactMode::all});
        ASSERT_EQ(contacts[i].pairs, contact.pairs);
        expect_same(contacts[i].counters, contact.counters);
        const Gap gap = distance(a, world_a, b, world_b, {.upper_bound = 0.5});
        ASSERT_EQ(gaps[i].distance, gap.distance);
        ASSERT_EQ(gaps[i].point_a, gap.point_a);
        ASSERT_EQ(gaps[i].triangle_b, gap.triangle_b);
        ASSERT_EQ(gaps[i].status, gap.status);
        expect_same(gaps[i].counters, gap.counters);
        ASSERT_EQ(near[i], within(a, world_a, b, world_b, 0.1));
        meet += contact.meet() ? 1 : 0;
    }
    EXPECT_GT(meet, 90);
    EXPECT_LT(meet, 210);
    EXPECT_TRUE(collide(a, b, std::span<const Placement>{}).empty());
}

TEST(Batch, TimesOfImpactEqualSingleQueries) {
    Random random(2102);
    const Model a(make_moving_mesh(random, 4)), b(make_moving_mesh(random, 5));
    std::vector<MotionPair> motions;
    for (int i = 0; i < 200; ++i) {
        const Motion motion_a = make_motion(random);
        motions.push_back({motion_a, make_other_motion(random)});
    }
    const auto impacts = time_of_impact(a, b, motions);
    ASSERT_EQ(impacts.size(), motions.size());
    int hits = 0;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const Impact impact = time_of_impact(a, motions[i].a, b, motions[i].b);
        ASSERT_EQ(impacts[i].meet, impact.meet);
        ASSERT_EQ(impacts[i].time, impact.time);
        ASSERT_EQ(impacts[i].contact_time, impact.contact_time);
        ASSERT_EQ(impacts[i].point_a, impact.point_a);
        ASSERT_EQ(impacts[i].triangle_b, impact.triangle_b);
        expect_same(impacts[i].counters, impact.counters);
        hits += impact.meet ? 1 : 0;
    }
    EXPECT_GT(hits, 40);
    EXPECT_LT(hits, 160);
}

TEST(Batch, ReportsTheFirstError) {
    Random random(2103);
    const Model box(box_mesh({0, 0, 0}, {1, 1, 1}));
    std::vector<Placement> placements = make_placements(random, 200);
    for (const std::size_t bad : {190U, 60U, 33U, 34U})
        placements[bad].world_from_b.m[static_cast<std::size_t>(random.integer(0, 11))] =
            std::numeric_limits<double>::quiet_NaN();
    const auto expect_first = [](const auto& query) {
        try {
            (void)query();
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
            EXPECT_EQ(std::string(error.what()).rfind("placement 33: ", 0), 0U) << error.what();
        }
    };
    for (int round = 0; round < 20; ++round) {
        expect_first([&] { return collide(box, box, placements); });
        expect_first([&] { return distance(box, box, placements); });
        expect_first([&] { return within(box, box, placements, 1); });
    }
    std::vector<MotionPair> motions(200);
    motions[33].a.velocity.x = motions[150].b.centre.y = kInfinity;
    expect_first([&] { return time_of_impact(box, box, motions); });
}

} // namespace
} // namespace abut::test
