// Models with hierarchies of every kind of volume give the answers of box hierarchies and of all
// pairs of triangles.

#include <abut/penetration.h>
#include <abut/rigid.h>

#include "rigid/model/model_data.h"
#include "scenes/bodies.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

constexpr std::array kVolumes{Volume::aabb,   Volume::sphere, Volume::kdop14, Volume::kdop18,
                              Volume::kdop26, Volume::obb,    Volume::pss,    Volume::lss,
                              Volume::rss,    Volume::ssv};

/// Whether the hierarchy stores boxes only.
bool boxes_only(Volume volume) {
    return volume == Volume::automatic || volume == Volume::aabb;
}

/// Meshes of some hundred triangles, about 1 across.
Mesh volume_mesh(Random& random, int kind) {
    switch (kind % 4) {
    case 0:
        return scenes::boulder(300, 7);
    case 1:
        return scenes::knot(400);
    case 2:
        return soup_mesh(random, 200, 0.5, 0.1);
    default:
        return with_degenerates(
            random, joined(scenes::boulder(100, 3), soup_mesh(random, 60, 0.5, 0.1)), 40);
    }
}

/// A rigid placement; every third is also stretched, sheared and perhaps mirrored.
Transform any_placement(Random& random, int round, const Vec3& at) {
    Transform t = random.pose(0);
    if (round % 3 == 2)
        t = compose(t, Transform({random.chance(0.5) ? -1.2 : 1.2, random.uniform(-0.5, 0.5), 0,
                                  random.uniform(-0.5, 0.5), random.uniform(0.5, 1.5), 0, 0,
                                  random.uniform(-0.5, 0.5), random.uniform(0.5, 1.5), 0, 0, 0}));
    t.m[9] = at.x, t.m[10] = at.y, t.m[11] = at.z;
    return t;
}

/// The true answers, from all pairs.
struct PairTruth {
    std::vector<TrianglePair> pairs;
    double distance = 0;

    PairTruth(const Mesh& a, const Transform& world_a, const Mesh& b, const Transform& world_b) {
        const auto placed_a = placed_triangles(a, world_a), placed_b = placed_triangles(b, world_b);
        pairs = brute_pairs(placed_a, placed_b);
        distance = pairs.empty() ? brute_distance(placed_a, placed_b) : 0;
    }
};

constexpr double kVolumeRounding = 64 * 0x1p-53;

void expect_truth(const PairTruth& truth, const Model& a, const Transform& world_a, const Model& b,
                  const Transform& world_b) {
    EXPECT_EQ(collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs, truth.pairs);
    const Contacts first = collide(a, world_a, b, world_b);
    EXPECT_EQ(first.pairs.size(), truth.pairs.empty() ? 0U : 1U);
    for (const TrianglePair& pair : first.pairs)
        EXPECT_TRUE(std::binary_search(truth.pairs.begin(), truth.pairs.end(), pair));

    const double d = truth.distance;
    const Gap gap = distance(a, world_a, b, world_b);
    EXPECT_NEAR(gap.distance, d, kVolumeRounding);
    EXPECT_EQ(gap.distance == 0, !truth.pairs.empty());
    EXPECT_EQ(gap.status, Status::exact);
    const auto near = [&](double tolerance) { return within(a, world_a, b, world_b, tolerance); };
    EXPECT_EQ(near(0), !truth.pairs.empty());
    EXPECT_TRUE(near(d + kVolumeRounding));
    EXPECT_TRUE(near(2 * d + 1));
    EXPECT_TRUE(near(HUGE_VAL));
    if (d > 1e-9) {
        EXPECT_FALSE(near(d - kVolumeRounding));
        EXPECT_FALSE(near(d / 3));
        EXPECT_NEAR(distance(a, world_a, b, world_b, {.upper_bound = 1.5 * d}).distance, d,
                    kVolumeRounding);
        const Gap cut = distance(a, world_a, b, world_b, {.upper_bound = d / 2});
        EXPECT_EQ(cut.distance, d / 2);
        EXPECT_EQ(cut.status, Status::bound_only);
    }
}

class RigidVolumes : public testing::TestWithParam<Volume> {};

TEST_P(RigidVolumes, EqualBruteForce) {
    const Volume volume = GetParam();
    Random random(4100);
    int meet = 0, rounds = 0;
    std::uint64_t tests = 0, of_boxes = 0;
    for (int kind_a = 0; kind_a < 4; ++kind_a)
        for (int kind_b = 0; kind_b < 4; ++kind_b) {
            const Mesh mesh_a = volume_mesh(random, kind_a), mesh_b = volume_mesh(random, kind_b);
            const Model a(mesh_a, {volume}), b(mesh_b, {volume}), boxes_a(mesh_a), boxes_b(mesh_b);
            ASSERT_EQ(a.data().volumes() == nullptr, boxes_only(volume));
            for (int i = 0; i < 6; ++i, ++rounds) {
                const Vec3 at = random.in_cube(3);
                const Transform world_a = any_placement(random, i, at),
                                world_b = any_placement(
                                    random, i, at + random.uniform(0.3, 1.6) * random.direction());
                const PairTruth truth(mesh_a, world_a, mesh_b, world_b);
                expect_truth(truth, a, world_a, b, world_b);
                expect_truth(truth, boxes_a, world_a, boxes_b, world_b);
                ASSERT_FALSE(HasFailure()) << "kinds " << kind_a << ' ' << kind_b << ", " << i;
                meet += truth.pairs.empty() ? 0 : 1;
                tests += distance(a, world_a, b, world_b).counters.volume_tests;
                of_boxes += distance(boxes_a, world_a, boxes_b, world_b).counters.volume_tests;
            }
        }
    EXPECT_GT(meet, rounds / 4);
    EXPECT_LT(meet, rounds * 3 / 4);
    if (!boxes_only(volume)) {
        EXPECT_NE(tests, of_boxes); // other volumes were really used
    }
    std::cout << meet << " of " << rounds << " meet; " << tests << " volume tests, of boxes "
              << of_boxes << '\n';
}
INSTANTIATE_TEST_SUITE_P(Volumes, RigidVolumes, testing::ValuesIn(kVolumes));

TEST(RigidVolumes, KindsThatModelsHaveInCommon) {
    const auto is_swept = [](Volume v) {
        return v == Volume::sphere || v == Volume::pss || v == Volume::lss || v == Volume::rss ||
               v == Volume::ssv;
    };
    for (const Volume a : abut::kVolumes)
        for (const Volume b : abut::kVolumes) {
            const Volume expected = a == b                       ? a
                                    : is_swept(a) && is_swept(b) ? Volume::ssv
                                                                 : Volume::automatic;
            EXPECT_EQ(common_volume(a, b), expected) << to_string(a) << ' ' << to_string(b);
        }
}

TEST(RigidVolumes, ModelsOfDifferentKindsTellWhatWasTested) {
    Random random(4101);
    const Mesh mesh_a = volume_mesh(random, 1), mesh_b = volume_mesh(random, 3);
    const Model boxes_a(mesh_a), boxes_b(mesh_b);
    int meet = 0, rounds = 0, swept = 0, different = 0;
    for (std::size_t i = 0; i < kVolumes.size(); ++i)
        for (std::size_t j = 0; j < kVolumes.size(); ++j) {
            if (i == j)
                continue;
            const Model a(mesh_a, {kVolumes[i]}), b(mesh_b, {kVolumes[j]});
            const Transform world_a = any_placement(random, rounds, {}),
                            world_b = any_placement(random, rounds,
                                                    random.uniform(0.3, 1.6) * random.direction());
            const PairTruth truth(mesh_a, world_a, mesh_b, world_b);
            expect_truth(truth, a, world_a, b, world_b);
            ASSERT_FALSE(HasFailure()) << i << ' ' << j;
            const Volume common = common_volume(kVolumes[i], kVolumes[j]);
            const Counters counters = distance(a, world_a, b, world_b).counters,
                           of_boxes = distance(boxes_a, world_a, boxes_b, world_b).counters;
            ASSERT_EQ(counters.volume, common);
            ASSERT_EQ(of_boxes.volume, Volume::automatic);
            const Contacts contacts = collide(a, world_a, b, world_b, {.mode = ContactMode::all});
            if (contacts.counters.volume_tests > 0) {
                ASSERT_EQ(contacts.counters.volume, common);
            }
            // The tree of a model with `aabb` differs from the automatic one, and so do its
            // counters.
            if (common == Volume::ssv) {
                ++swept;
                different += counters.volume_tests != of_boxes.volume_tests ? 1 : 0;
            } else if (kVolumes[i] != Volume::aabb && kVolumes[j] != Volume::aabb) {
                ASSERT_EQ(counters.volume_tests, of_boxes.volume_tests);
            }
            meet += truth.pairs.empty() ? 0 : 1;
            ++rounds;
        }
    EXPECT_GT(meet, rounds / 5);
    EXPECT_LT(meet, rounds * 4 / 5);
    EXPECT_EQ(swept, 20);
    EXPECT_GT(different, 18); // swept spheres were really used
}

TEST(RigidVolumes, OneTriangleAndDegenerateModels) {
    Random random(4102);
    const Mesh point{{{0.1, 0.2, 0.3}}, {{0, 0, 0}}},
        segment{{{-0.5, 0, 0}, {0.5, 0.1, 0}}, {{0, 1, 0}}},
        triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
        points = with_degenerates(random, Mesh{{{0, 0, 0}, {0.3, 0.1, 0.2}}, {}}, 30);
    const std::array meshes{point, segment, triangle, points, box_mesh({0, 0, 0}, {1, 1, 1})};
    int meet = 0, rounds = 0;
    for (const Volume volume : kVolumes)
        for (const Mesh& mesh_a : meshes)
            for (const Mesh& mesh_b : meshes) {
                const Model a(mesh_a, {volume}), b(mesh_b, {volume});
                for (int i = 0; i < 3; ++i, ++rounds) {
                    const Transform world_a = any_placement(random, i, {}),
                                    world_b = i == 1 ? world_a
                                                     : any_placement(random, i, random.in_cube(1));
                    const PairTruth truth(mesh_a, world_a, mesh_b, world_b);
                    expect_truth(truth, a, world_a, b, world_b);
                    ASSERT_FALSE(HasFailure())
                        << "volume " << int(volume) << ", " << i << ": " << mesh_a.triangles.size()
                        << " to " << mesh_b.triangles.size() << ", " << truth.pairs.size()
                        << " meet, distance " << truth.distance;
                    meet += truth.pairs.empty() ? 0 : 1;
                }
            }
    EXPECT_GT(meet, rounds / 6);
    EXPECT_LT(meet, rounds * 5 / 6);
}

TEST(RigidVolumes, FlattenedModelsKeepTheirKind) {
    Random random(4103);
    const Mesh mesh = scenes::boulder(200, 5);
    const Transform flat = scaling(1, 1, 0);
    int meet = 0;
    for (const Volume volume : kVolumes) {
        const Model a(mesh, {volume}), b(mesh, {volume});
        for (int i = 0; i < 4; ++i) {
            const Transform world = any_placement(random, 0, {0.5, 0, i % 2 == 0 ? 0.2 : 1.5});
            const PairTruth truth(mesh, flat, mesh, world);
            expect_truth(truth, a, flat, b, world);
            meet += truth.pairs.empty() ? 0 : 1;
        }
        ASSERT_FALSE(HasFailure()) << "volume " << int(volume);
    }
    EXPECT_GE(meet, int(kVolumes.size()));
    EXPECT_LE(meet, 3 * int(kVolumes.size()));
}

/// A singular transform of rank 2, 1 or 0, along an axis or not.
Transform singular_transform(Random& random, double reach) {
    Transform flat = scaling(1, 1, 0);
    const double kind = random.uniform(0, 1);
    if (kind < 0.15)
        flat = scaling(0, 1, 0);
    else if (kind < 0.2)
        flat = scaling(0, 0, 0);
    Transform t =
        compose(random.pose(0), random.chance(0.5) ? compose(flat, random.pose(0)) : flat);
    const Vec3 at = random.in_cube(reach);
    t.m[9] = at.x, t.m[10] = at.y, t.m[11] = at.z;
    return t;
}

TEST(RigidVolumes, FlattenedModelsEqualModelsOfBoxes) {
    Random random(5309);
    int deep = 0, apart = 0;
    for (int round = 0; round < many(20); ++round) {
        const Mesh mesh_a = round % 2 == 0 ? scenes::boulder(200, 7) : scenes::knot(200),
                   mesh_b = round % 3 == 0 ? scenes::boulder(100, 5)
                                           : box_mesh({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3});
        const bool both = random.chance(0.2);
        const double reach = round % 3 == 1 ? 1.5 : 0.3;
        Transform world_a = random.pose(0.3), world_b = singular_transform(random, reach);
        if (both)
            world_a = singular_transform(random, reach);
        else if (random.chance(0.5))
            std::swap(world_a, world_b);
        const Model boxes_a(mesh_a), boxes_b(mesh_b);
        const Depth depth = penetration(boxes_a, world_a, boxes_b, world_b, {.separation = false});
        const Gap plain = distance(boxes_a, world_a, boxes_b, world_b);
        const Contacts contacts =
            collide(boxes_a, world_a, boxes_b, world_b, {.mode = ContactMode::all});
        (depth.depth > 0 ? deep : apart) += 1;
        for (const Volume volume : kVolumes) {
            SCOPED_TRACE(testing::Message() << "round " << round << " volume " << int(volume));
            const Model a(mesh_a, {volume}), b(mesh_b, {volume});
            const auto signed_distance =
                distance(a, world_a, b, world_b, {.signed_distance = true});
            ASSERT_EQ(collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs,
                      contacts.pairs);
            ASSERT_NEAR(distance(a, world_a, b, world_b).distance, plain.distance, 1e-14);
            const Depth found = penetration(a, world_a, b, world_b, {.separation = false});
            ASSERT_EQ(found.interpenetrate, depth.interpenetrate);
            ASSERT_LE(found.depth, depth.depth_at_most * (1 + 1e-12));
            ASSERT_LE(depth.depth, found.depth_at_most * (1 + 1e-12));
            if (depth.depth > 0) { // the same depth, up to each search's accuracy
                ASSERT_LE(-signed_distance.distance, depth.depth_at_most * (1 + 1e-12));
                ASSERT_LE(depth.depth, -signed_distance.at_least * (1 + 1e-12));
                ASSERT_NEAR(-signed_distance.distance, depth.depth, 0.1 * depth.depth);
            } else if (plain.distance > 0) {
                ASSERT_NEAR(signed_distance.distance, plain.distance, 1e-14);
            }
            ASSERT_EQ(within(a, world_a, b, world_b, plain.distance * 0.99), plain.distance == 0);
            ASSERT_TRUE(within(a, world_a, b, world_b, plain.distance * 1.01));
        }
    }
    std::cout << deep << " deep, " << apart << " not\n";
    EXPECT_GT(deep, many(20) / 8);
    EXPECT_GT(apart, many(20) / 8);
}

TEST(RigidVolumes, EmptyModelsMeetNothing) {
    for (const Volume volume : kVolumes) {
        const Model empty(Mesh{}, {volume}), loose(Mesh{{{0, 0, 0}}, {}}, {volume}),
            box(box_mesh({0, 0, 0}, {1, 1, 1}), {volume});
        EXPECT_EQ(empty.data().volumes(), nullptr);
        for (const Model& none : {empty, loose})
            for (const Model& other : {empty, box}) {
                EXPECT_FALSE(collide(none, {}, other, {}).meet());
                EXPECT_FALSE(collide(other, {}, none, {}, {.mode = ContactMode::all}).meet());
                const Gap gap = distance(none, {}, other, {});
                EXPECT_EQ(gap.distance, HUGE_VAL);
                EXPECT_EQ(gap.status, Status::bound_only);
                EXPECT_EQ(distance(other, {}, none, {}, {.upper_bound = 2}).distance, 2);
                EXPECT_FALSE(within(none, {}, other, {}, HUGE_VAL));
            }
    }
}

/// The extra memory is the size of one volume in each of a node's eight lanes, in floats.
TEST(RigidVolumes, BytesAreTheSumOfBoxesAndVolumes) {
    const Mesh mesh = scenes::boulder(500, 2);
    const Model boxes(mesh);
    const std::size_t lanes = boxes.data().tree().nodes.size() * Node::kWidth * sizeof(float);
    const std::vector<std::pair<Volume, std::size_t>> floats{
        {Volume::automatic, 0}, {Volume::sphere, 4}, {Volume::kdop14, 14}, {Volume::kdop18, 18},
        {Volume::kdop26, 26},   {Volume::obb, 15},   {Volume::pss, 4},     {Volume::lss, 8},
        {Volume::rss, 12},      {Volume::ssv, 12}};
    EXPECT_GT(lanes, 0U);
    for (const auto& [volume, count] : floats)
        EXPECT_EQ(Model(mesh, {volume}).bytes(), boxes.bytes() + count * lanes) << int(volume);
}

} // namespace
} // namespace abut::test
