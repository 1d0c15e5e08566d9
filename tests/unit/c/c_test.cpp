#include <abut/c.h>

#include "tests/support/folder.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr std::array<double, 12> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr std::array<std::uint32_t, 12> kFaces{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};

/// A tetrahedron of the corner of the axes.
struct CInterface : testing::Test {
    abut_model* model = nullptr;

    void SetUp() override {
        ASSERT_EQ(abut_model_from_arrays(kCorners.data(), 4, kFaces.data(), 4, &model), ABUT_OK);
    }
    void TearDown() override { abut_model_free(model); }

    static abut_transform moved(double x) {
        const abut_pose pose{{x, 0, 0}, {1, 0, 0, 0}};
        abut_transform transform;
        EXPECT_EQ(abut_transform_of(&pose, &transform), ABUT_OK);
        return transform;
    }
};

TEST_F(CInterface, Versions) {
    EXPECT_EQ(abut_c_version(), ABUT_C_VERSION);
    EXPECT_NE(std::strlen(abut_version()), 0U);
}

TEST_F(CInterface, ModelsHaveWhatTheyWereMadeOf) {
    EXPECT_EQ(abut_model_vertex_count(model), 4U);
    EXPECT_EQ(abut_model_triangle_count(model), 4U);
    std::array<float, 12> floats{};
    std::copy(kCorners.begin(), kCorners.end(), floats.begin());
    abut_model* other = nullptr;
    ASSERT_EQ(abut_model_from_floats(floats.data(), 4, kFaces.data(), 4, &other), ABUT_OK);
    EXPECT_EQ(abut_model_triangle_count(other), 4U);
    abut_model_free(other);
    abut_model_free(nullptr);
}

TEST_F(CInterface, TwoModels) {
    const abut_transform apart = moved(3), across = moved(0.25);
    abut_gap gap;
    ASSERT_EQ(abut_distance(model, nullptr, model, &apart, 0, &gap), ABUT_OK);
    EXPECT_EQ(gap.distance, 2);
    EXPECT_EQ(gap.point_a.x, 1);
    EXPECT_EQ(gap.point_b.x, 3);
    int answer = -1;
    ASSERT_EQ(abut_within(model, nullptr, model, &apart, 2, &answer), ABUT_OK);
    EXPECT_EQ(answer, 1);
    ASSERT_EQ(abut_within(model, nullptr, model, &apart, 1.99, &answer), ABUT_OK);
    EXPECT_EQ(answer, 0);
    ASSERT_EQ(abut_collide(model, nullptr, model, &apart, &answer), ABUT_OK);
    EXPECT_EQ(answer, 0);
    ASSERT_EQ(abut_collide(model, nullptr, model, &across, &answer), ABUT_OK);
    EXPECT_EQ(answer, 1);
    abut_depth depth;
    ASSERT_EQ(abut_penetration(model, nullptr, model, &across, &depth), ABUT_OK);
    EXPECT_EQ(depth.interpenetrate, 1);
    EXPECT_GT(depth.depth, 0);
    EXPECT_GE(depth.depth_at_most, depth.depth);
}

TEST_F(CInterface, ContactsFillWhatTheCallerHas) {
    const abut_transform across = moved(0.25);
    std::size_t count = 0;
    ASSERT_EQ(abut_contacts(model, nullptr, model, &across, nullptr, 0, &count), ABUT_OK);
    ASSERT_GT(count, 1U);
    std::array<abut_triangle_pair, 17> pairs{};
    pairs[1] = {99, 99};
    std::size_t again = 0;
    ASSERT_EQ(abut_contacts(model, nullptr, model, &across, pairs.data(), 1, &again), ABUT_OK);
    EXPECT_EQ(again, count);
    EXPECT_LT(pairs[0].a, 4U);
    EXPECT_EQ(pairs[1].a, 99U);
}

TEST_F(CInterface, TimeOfImpact) {
    const abut_pose origin{{0, 0, 0}, {1, 0, 0, 0}}, start{{5, 0, 0}, {1, 0, 0, 0}};
    abut_motion still;
    abut_motion moving;
    ASSERT_EQ(abut_motion_fixed(&origin, &still), ABUT_OK);
    ASSERT_EQ(abut_motion_between(&start, &origin, nullptr, &moving), ABUT_OK);
    abut_impact impact;
    ASSERT_EQ(abut_time_of_impact(model, &still, model, &moving, -1, &impact), ABUT_OK);
    EXPECT_EQ(impact.meet, 1);
    EXPECT_NEAR(impact.time, 0.8, 1e-5); // from x = 5 to x = 1
    EXPECT_EQ(abut_time_of_impact(model, &still, model, &moving, std::nan(""), &impact),
              ABUT_BAD_ARGUMENT);
}

TEST_F(CInterface, OneModel) {
    const std::array<abut_vec3, 3> points{{{0.1, 0.1, 0.1}, {-2, 0, 0}, {0, 0, 0}}};
    std::array<abut_nearest_point, 3> nearest{};
    ASSERT_EQ(abut_nearest(model, nullptr, points.data(), 3, ABUT_SIGNED, nearest.data()), ABUT_OK);
    EXPECT_DOUBLE_EQ(nearest[0].distance, -0.1);
    EXPECT_EQ(nearest[1].distance, 2);
    EXPECT_EQ(nearest[2].distance, 0);
    std::array<abut_side, 3> sides{};
    ASSERT_EQ(abut_contains(model, nullptr, points.data(), 3, sides.data()), ABUT_OK);
    EXPECT_EQ(sides[0], ABUT_INSIDE);
    EXPECT_EQ(sides[1], ABUT_OUTSIDE);
    EXPECT_EQ(sides[2], ABUT_ON_SURFACE);
    const std::array<abut_ray, 2> rays{
        {{{-1, 0.2, 0.2}, {1, 0, 0}, 0, 10}, {{-1, 5, 5}, {1, 0, 0}, 0, 10}}};
    std::array<abut_ray_hit, 2> hits{};
    ASSERT_EQ(abut_first_hit(model, nullptr, rays.data(), 2, hits.data()), ABUT_OK);
    EXPECT_EQ(hits[0].meet, 1);
    EXPECT_EQ(hits[0].t, 1);
    EXPECT_EQ(hits[1].meet, 0);
}

TEST_F(CInterface, FaultsAreCodesWithMessages) {
    abut_model* none = nullptr;
    EXPECT_EQ(abut_model_from_file("missing.stl", &none), ABUT_FILE_NOT_FOUND);
    EXPECT_EQ(none, nullptr);
    EXPECT_NE(std::string(abut_error_message()).find("missing.stl"), std::string::npos);
    std::string elsewhere = "unset";
    std::thread([&] { elsewhere = abut_error_message(); }).join();
    EXPECT_EQ(elsewhere, "");
    const std::array<std::uint32_t, 3> wrong{0, 1, 7};
    EXPECT_EQ(abut_model_from_arrays(kCorners.data(), 4, wrong.data(), 1, &none), ABUT_BAD_MESH);
    int answer = 0;
    EXPECT_EQ(abut_collide(nullptr, nullptr, model, nullptr, &answer), ABUT_BAD_ARGUMENT);
    EXPECT_STREQ(abut_error_message(), "a is NULL");
    EXPECT_EQ(abut_collide(model, nullptr, model, nullptr, nullptr), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_nearest(model, nullptr, nullptr, 1, 0, nullptr), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_nearest(model, nullptr, nullptr, 0, 0, nullptr), ABUT_OK);
    EXPECT_EQ(abut_model_from_file(nullptr, &none), ABUT_BAD_ARGUMENT);
    constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max() / 3 + 2; // 3 * kHuge: 3
    EXPECT_EQ(abut_model_from_arrays(kCorners.data(), kHuge, kFaces.data(), 1, &none),
              ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_model_from_arrays(kCorners.data(), 4, kFaces.data(), kHuge, &none),
              ABUT_BAD_ARGUMENT);
    EXPECT_EQ(none, nullptr);
    const abut_pose flat{{0, 0, 0}, {0, 0, 0, 0}};
    abut_transform transform;
    EXPECT_EQ(abut_transform_of(&flat, &transform), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_transform_of(nullptr, &transform), ABUT_BAD_ARGUMENT);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInfinite = std::numeric_limits<double>::infinity();

/// Transforms with one value that is not finite, each in another place.
std::vector<abut_transform> transforms_that_are_not_finite() {
    std::vector<abut_transform> all;
    for (std::size_t i = 0; i < 12; ++i)
        for (const double bad : {kNan, kInfinite, -kInfinite}) {
            abut_transform transform{{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
            transform.m[i] = bad;
            all.push_back(transform);
        }
    return all;
}

TEST_F(CInterface, TransformsThatAreNotFiniteAreRefusedByEveryFunction) {
    abut_scene* scene = nullptr;
    std::uint32_t mesh = 0;
    ASSERT_EQ(abut_scene_new("plant", &scene), ABUT_OK);
    ASSERT_EQ(abut_scene_add_mesh(scene, kCorners.data(), 4, kFaces.data(), 4, &mesh), ABUT_OK);
    for (const abut_transform& bad : transforms_that_are_not_finite()) {
        int answer = -1;
        std::size_t count = 99;
        abut_gap gap{};
        abut_depth depth{};
        for (const bool first : {true, false}) {
            const abut_transform *const a = first ? &bad : nullptr, *const b =
                                                                        first ? nullptr : &bad;
            EXPECT_EQ(abut_collide(model, a, model, b, &answer), ABUT_BAD_ARGUMENT);
            EXPECT_NE(std::strstr(abut_error_message(), first ? "world_from_a" : "world_from_b"),
                      nullptr);
            EXPECT_EQ(abut_contacts(model, a, model, b, nullptr, 0, &count), ABUT_BAD_ARGUMENT);
            EXPECT_EQ(abut_distance(model, a, model, b, 0, &gap), ABUT_BAD_ARGUMENT);
            EXPECT_EQ(abut_within(model, a, model, b, 1, &answer), ABUT_BAD_ARGUMENT);
            EXPECT_EQ(abut_penetration(model, a, model, b, &depth), ABUT_BAD_ARGUMENT);
        }
        // The arguments are checked even if there is nothing to ask about.
        EXPECT_EQ(abut_nearest(model, &bad, nullptr, 0, 0, nullptr), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_first_hit(model, &bad, nullptr, 0, nullptr), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_contains(model, &bad, nullptr, 0, nullptr), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_scene_add_part(scene, "tank", nullptr, mesh, &bad), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(answer, -1);
        EXPECT_EQ(count, 99U);
    }
    EXPECT_EQ(abut_scene_part_count(scene), 0U);
    EXPECT_EQ(abut_scene_add_part(scene, "tank", nullptr, mesh, nullptr), ABUT_OK); // still free
    abut_scene_free(scene);
}

TEST_F(CInterface, UnknownFlagsAreRefused) {
    abut_gap gap{};
    abut_nearest_point nearest{};
    const abut_vec3 point{2, 0, 0};
    for (const int flags : {0, int{ABUT_SIGNED}}) {
        EXPECT_EQ(abut_distance(model, nullptr, model, nullptr, flags, &gap), ABUT_OK);
        EXPECT_EQ(abut_nearest(model, nullptr, &point, 1, flags, &nearest), ABUT_OK);
    }
    for (const int flags : {2, 3, 98, 99, -1, std::numeric_limits<int>::min()}) {
        EXPECT_EQ(abut_distance(model, nullptr, model, nullptr, flags, &gap), ABUT_BAD_ARGUMENT);
        EXPECT_NE(std::strstr(abut_error_message(), std::to_string(flags).c_str()), nullptr);
        EXPECT_EQ(abut_nearest(model, nullptr, &point, 1, flags, &nearest), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_nearest(model, nullptr, nullptr, 0, flags, nullptr), ABUT_BAD_ARGUMENT);
    }
}

TEST_F(CInterface, NumbersOutsideTheirDomainAreRefused) {
    int answer = -1;
    for (const double bad : {kNan, -1.0, -kInfinite})
        EXPECT_EQ(abut_within(model, nullptr, model, nullptr, bad, &answer), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(answer, -1);
    for (const double bad : {kNan, kInfinite}) {
        const abut_vec3 point{bad, 0, 0};
        abut_nearest_point nearest{};
        abut_side side = ABUT_OUTSIDE;
        EXPECT_EQ(abut_nearest(model, nullptr, &point, 1, 0, &nearest), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_contains(model, nullptr, &point, 1, &side), ABUT_BAD_ARGUMENT);
        abut_model* made = nullptr;
        std::array<double, 12> corners = kCorners;
        corners[7] = bad;
        EXPECT_EQ(abut_model_from_arrays(corners.data(), 4, kFaces.data(), 4, &made),
                  ABUT_BAD_MESH);
        std::array<float, 12> floats{};
        floats[7] = float(bad);
        EXPECT_EQ(abut_model_from_floats(floats.data(), 4, kFaces.data(), 4, &made), ABUT_BAD_MESH);
        EXPECT_EQ(made, nullptr);
    }
    const abut_ray good{{-1, 0.2, 0.2}, {1, 0, 0}, 0, kInfinite};
    abut_ray_hit hit{};
    EXPECT_EQ(abut_first_hit(model, nullptr, &good, 1, &hit), ABUT_OK);
    std::array<abut_ray, 6> rays{good, good, good, good, good, good};
    rays[0].origin.y = kNan, rays[1].origin.z = kInfinite, rays[2].direction.x = kNan;
    rays[3].direction = {0, 0, 0}, rays[4].t_min = kNan, rays[5].t_max = kNan;
    for (const abut_ray& bad : rays)
        EXPECT_EQ(abut_first_hit(model, nullptr, &bad, 1, &hit), ABUT_BAD_ARGUMENT);
}

TEST_F(CInterface, MotionsThatAreNoneAreRefused) {
    const abut_pose good{{0, 0, 0}, {1, 0, 0, 0}};
    std::array<abut_pose, 4> poses{good, good, good, good};
    poses[0].translation.x = kNan, poses[1].translation.z = kInfinite;
    poses[2].rotation[0] = kNan, poses[3].rotation[0] = 0;
    abut_motion still;
    ASSERT_EQ(abut_motion_fixed(&good, &still), ABUT_OK);
    abut_motion motion{};
    for (const abut_pose& bad : poses) {
        abut_transform transform;
        EXPECT_EQ(abut_transform_of(&bad, &transform), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_motion_fixed(&bad, &motion), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_motion_between(&bad, &good, nullptr, &motion), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_motion_between(&good, &bad, nullptr, &motion), ABUT_BAD_ARGUMENT);
    }
    const abut_vec3 nowhere{0, kNan, 0};
    EXPECT_EQ(abut_motion_between(&good, &good, &nowhere, &motion), ABUT_BAD_ARGUMENT);
    abut_impact impact{};
    std::array<abut_motion, 4> motions{still, still, still, still};
    motions[0].start.rotation[0] = 0, motions[1].centre.x = kNan;
    motions[2].velocity.y = kInfinite, motions[3].angular_velocity.z = kNan;
    for (const abut_motion& bad : motions) {
        EXPECT_EQ(abut_time_of_impact(model, &bad, model, &still, -1, &impact), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_time_of_impact(model, &still, model, &bad, -1, &impact), ABUT_BAD_ARGUMENT);
    }
}

TEST_F(CInterface, ArraysThatNoMemoryHoldsAreRefused) {
    const abut_vec3 point{};
    const abut_ray ray{{}, {1, 0, 0}, 0, 1};
    const double number = 0;
    const std::uint32_t index = 0;
    for (const std::size_t huge :
         {std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max() / 2,
          std::numeric_limits<std::size_t>::max() / 8}) {
        abut_nearest_point nearest{};
        abut_ray_hit hit{};
        abut_side side = ABUT_OUTSIDE;
        abut_model* made = nullptr;
        EXPECT_EQ(abut_nearest(model, nullptr, &point, huge, 0, &nearest), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_first_hit(model, nullptr, &ray, huge, &hit), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_contains(model, nullptr, &point, huge, &side), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_model_from_arrays(&number, huge, &index, 0, &made), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(abut_model_from_arrays(&number, 0, &index, huge, &made), ABUT_BAD_ARGUMENT);
        EXPECT_EQ(made, nullptr);
    }
}

TEST_F(CInterface, PointersThatAreNullAreRefusedByEveryFunction) {
    const abut_pose pose{{0, 0, 0}, {1, 0, 0, 0}};
    abut_transform transform;
    abut_motion motion;
    ASSERT_EQ(abut_motion_fixed(&pose, &motion), ABUT_OK);
    abut_model* made = nullptr;
    abut_scene* scene = nullptr;
    abut_report* report = nullptr;
    std::uint32_t mesh = 0;
    int answer = 0;
    std::size_t count = 0;
    abut_gap gap;
    abut_depth depth;
    abut_impact impact;
    abut_triangle_pair pair;
    const abut_vec3 point{};
    abut_nearest_point nearest;
    const abut_ray ray{{}, {1, 0, 0}, 0, 1};
    abut_ray_hit hit;
    abut_side side = ABUT_OUTSIDE;
    ASSERT_EQ(abut_scene_new("plant", &scene), ABUT_OK);
    const abut_scene* const no_scene = nullptr;
    const char* const no_path = nullptr;
    const double* const corners = kCorners.data();
    const std::uint32_t* const faces = kFaces.data();
    const abut_model* const no_model = nullptr;
    const std::array statuses{abut_transform_of(nullptr, &transform),
                              abut_transform_of(&pose, nullptr),
                              abut_model_from_arrays(nullptr, 4, faces, 4, &made),
                              abut_model_from_arrays(corners, 4, nullptr, 4, &made),
                              abut_model_from_arrays(corners, 4, faces, 4, nullptr),
                              abut_model_from_floats(nullptr, 4, faces, 4, &made),
                              abut_model_from_file(nullptr, &made),
                              abut_model_from_file("x.obj", nullptr),
                              abut_collide(no_model, nullptr, model, nullptr, &answer),
                              abut_collide(model, nullptr, no_model, nullptr, &answer),
                              abut_collide(model, nullptr, model, nullptr, nullptr),
                              abut_contacts(no_model, nullptr, model, nullptr, &pair, 1, &count),
                              abut_contacts(model, nullptr, no_model, nullptr, &pair, 1, &count),
                              abut_contacts(model, nullptr, model, nullptr, nullptr, 1, &count),
                              abut_contacts(model, nullptr, model, nullptr, &pair, 1, nullptr),
                              abut_distance(no_model, nullptr, model, nullptr, 0, &gap),
                              abut_distance(model, nullptr, no_model, nullptr, 0, &gap),
                              abut_distance(model, nullptr, model, nullptr, 0, nullptr),
                              abut_within(no_model, nullptr, model, nullptr, 1, &answer),
                              abut_within(model, nullptr, no_model, nullptr, 1, &answer),
                              abut_within(model, nullptr, model, nullptr, 1, nullptr),
                              abut_penetration(no_model, nullptr, model, nullptr, &depth),
                              abut_penetration(model, nullptr, no_model, nullptr, &depth),
                              abut_penetration(model, nullptr, model, nullptr, nullptr),
                              abut_motion_between(nullptr, &pose, &point, &motion),
                              abut_motion_between(&pose, nullptr, &point, &motion),
                              abut_motion_between(&pose, &pose, &point, nullptr),
                              abut_motion_fixed(nullptr, &motion),
                              abut_motion_fixed(&pose, nullptr),
                              abut_time_of_impact(no_model, &motion, model, &motion, -1, &impact),
                              abut_time_of_impact(model, nullptr, model, &motion, -1, &impact),
                              abut_time_of_impact(model, &motion, no_model, &motion, -1, &impact),
                              abut_time_of_impact(model, &motion, model, nullptr, -1, &impact),
                              abut_time_of_impact(model, &motion, model, &motion, -1, nullptr),
                              abut_nearest(no_model, nullptr, &point, 1, 0, &nearest),
                              abut_nearest(model, nullptr, nullptr, 1, 0, &nearest),
                              abut_nearest(model, nullptr, &point, 1, 0, nullptr),
                              abut_first_hit(no_model, nullptr, &ray, 1, &hit),
                              abut_first_hit(model, nullptr, nullptr, 1, &hit),
                              abut_first_hit(model, nullptr, &ray, 1, nullptr),
                              abut_contains(no_model, nullptr, &point, 1, &side),
                              abut_contains(model, nullptr, nullptr, 1, &side),
                              abut_contains(model, nullptr, &point, 1, nullptr),
                              abut_scene_from_file(nullptr, &scene),
                              abut_scene_from_file("x.obj", nullptr),
                              abut_scene_new(nullptr, &scene),
                              abut_scene_new("plant", nullptr),
                              abut_scene_add_mesh(nullptr, corners, 4, faces, 4, &mesh),
                              abut_scene_add_mesh(scene, nullptr, 4, faces, 4, &mesh),
                              abut_scene_add_mesh(scene, corners, 4, nullptr, 4, &mesh),
                              abut_scene_add_mesh(scene, corners, 4, faces, 4, nullptr),
                              abut_scene_add_part(nullptr, "tank", nullptr, 0, nullptr),
                              abut_scene_add_part(scene, nullptr, nullptr, 0, nullptr),
                              abut_find_clashes(nullptr, 1, nullptr, &report),
                              abut_find_clashes(&no_scene, 1, nullptr, &report),
                              abut_find_clashes(nullptr, 0, nullptr, nullptr),
                              abut_find_clashes_in_store(nullptr, nullptr, 0, &report),
                              abut_find_clashes_in_store("x.abut", nullptr, 0, nullptr),
                              abut_import(nullptr, 1, "x.abut"),
                              abut_import(&no_path, 1, "x.abut"),
                              abut_import(nullptr, 0, nullptr),
                              abut_report_write(nullptr, "x.json"),
                              abut_report_write(report, nullptr)};
    for (std::size_t i = 0; i < statuses.size(); ++i)
        EXPECT_EQ(statuses[i], ABUT_BAD_ARGUMENT) << "call " << i;
    EXPECT_EQ(made, nullptr);
    EXPECT_EQ(report, nullptr);
    EXPECT_EQ(abut_model_vertex_count(nullptr), 0U);
    EXPECT_EQ(abut_model_triangle_count(nullptr), 0U);
    EXPECT_EQ(abut_scene_part_count(nullptr), 0U);
    EXPECT_STREQ(abut_report_json(nullptr), "");
    EXPECT_EQ(abut_report_clash_count(nullptr), 0U);
    abut_scene_free(scene), abut_scene_free(nullptr), abut_report_free(nullptr);
}

TEST_F(CInterface, NamesThatAreTakenAreRefused) {
    const abut::test::Folder folder;
    const std::string file = folder / "one.obj";
    std::ofstream(file) << "o tank\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    abut_scene* scene = nullptr;
    ASSERT_EQ(abut_scene_from_file(file.c_str(), &scene), ABUT_OK);
    ASSERT_EQ(abut_scene_part_count(scene), 1U);
    // The name of a part of the file, and of one that was added.
    EXPECT_EQ(abut_scene_add_part(scene, "tank", nullptr, 0, nullptr), ABUT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(abut_error_message(), "'tank'"), nullptr);
    EXPECT_EQ(abut_scene_add_part(scene, "pipe", nullptr, 0, nullptr), ABUT_OK);
    EXPECT_EQ(abut_scene_add_part(scene, "pipe", "IfcPipeSegment", 0, nullptr), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_scene_add_part(scene, "Pipe", nullptr, 0, nullptr), ABUT_OK);
    EXPECT_EQ(abut_scene_part_count(scene), 3U);

    abut_scene *site = nullptr, *other = nullptr;
    ASSERT_EQ(abut_scene_new("site", &site), ABUT_OK);
    ASSERT_EQ(abut_scene_new("site", &other), ABUT_OK);
    abut_report* report = nullptr;
    const std::array<const abut_scene*, 2> twice{scene, scene}, same_name{site, other},
        different{scene, site};
    EXPECT_EQ(abut_find_clashes(twice.data(), 2, nullptr, &report), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_find_clashes(same_name.data(), 2, nullptr, &report), ABUT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(abut_error_message(), "site"), nullptr);
    EXPECT_EQ(report, nullptr);
    EXPECT_EQ(abut_find_clashes(different.data(), 2, nullptr, &report), ABUT_OK);
    abut_report_free(report), abut_scene_free(site), abut_scene_free(other);
    abut_scene_free(scene);

    const std::array<const char*, 2> paths{file.c_str(), file.c_str()};
    const std::string store = folder / "one.abut";
    EXPECT_EQ(abut_import(paths.data(), 2, store.c_str()), ABUT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(abut_error_message(), "twice"), nullptr);
}

/// Two tetrahedra that penetrate each other, as a scene.
abut_scene* crossing_parts() {
    abut_scene* scene = nullptr;
    std::uint32_t mesh = 7;
    EXPECT_EQ(abut_scene_new("plant", &scene), ABUT_OK);
    EXPECT_EQ(abut_scene_add_mesh(scene, kCorners.data(), 4, kFaces.data(), 4, &mesh), ABUT_OK);
    EXPECT_EQ(mesh, 0U);
    const abut_transform across = CInterface::moved(0.25);
    EXPECT_EQ(abut_scene_add_part(scene, "tank", nullptr, 0, nullptr), ABUT_OK);
    EXPECT_EQ(abut_scene_add_part(scene, "pipe", "IfcPipeSegment", 0, &across), ABUT_OK);
    EXPECT_EQ(abut_scene_add_part(scene, "none", nullptr, 1, nullptr), ABUT_BAD_ARGUMENT);
    EXPECT_EQ(abut_scene_part_count(scene), 2U);
    return scene;
}

int stop_at_once(void* calls, const char* /*stage*/, double /*fraction*/) {
    ++*static_cast<int*>(calls);
    return 1;
}

/// Counts the calls, and stops at the one whose number is `at`.
struct StopAt {
    int at = 0, calls = 0;
};

int stop_at(void* user, const char* /*stage*/, double /*fraction*/) {
    StopAt& stop = *static_cast<StopAt*>(user);
    return ++stop.calls == stop.at ? 1 : 0;
}

TEST_F(CInterface, EveryCallOfProgressCanStop) {
    abut_scene* scene = crossing_parts();
    const abut_scene* const scenes = scene;
    StopAt stop;
    abut_clash_options options{};
    options.progress = stop_at;
    options.user = &stop;
    abut_report* report = nullptr;
    ASSERT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_OK);
    abut_report_free(report);
    const int calls = stop.calls;
    ASSERT_GT(calls, 1);
    for (const int at : {1, calls}) {
        stop = {at, 0};
        report = nullptr;
        EXPECT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_INTERRUPTED) << at;
        EXPECT_EQ(report, nullptr);
    }
    abut_scene_free(scene);
}

TEST_F(CInterface, Clashes) {
    const abut::test::Folder folder;
    abut_scene* scene = crossing_parts();
    const abut_scene* const scenes = scene;
    abut_report* report = nullptr;
    ASSERT_EQ(abut_find_clashes(&scenes, 1, nullptr, &report), ABUT_OK);
    EXPECT_EQ(abut_report_clash_count(report), 1U);
    const std::string json = abut_report_json(report);
    EXPECT_NE(json.find("\"IfcPipeSegment\""), std::string::npos);
    for (const char* const name : {"report.json", "report.csv", "report.html"}) {
        const std::string path = folder / name;
        ASSERT_EQ(abut_report_write(report, path.c_str()), ABUT_OK) << abut_error_message();
        EXPECT_TRUE(std::ifstream(path).good());
    }
    EXPECT_EQ(abut_report_write(report, "report.xls"), ABUT_BAD_ARGUMENT);
    abut_report_free(report);

    int calls = 0;
    abut_clash_options options{};
    options.progress = stop_at_once;
    options.user = &calls;
    report = nullptr;
    EXPECT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_INTERRUPTED);
    EXPECT_GT(calls, 0);
    EXPECT_EQ(report, nullptr);
    for (const double bad : {-1.0, kNan, kInfinite}) {
        options = {};
        options.clearance = bad;
        EXPECT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_BAD_ARGUMENT);
        options = {};
        options.touch_tolerance = 2 * bad; // -1 is ABUT_TOUCH_OF_FILES
        EXPECT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_BAD_ARGUMENT);
    }
    options = {};
    options.rules = "missing.toml";
    EXPECT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_FILE_NOT_FOUND);
    EXPECT_EQ(report, nullptr);
    abut_scene_free(scene);
}

TEST_F(CInterface, Stores) {
    const abut::test::Folder folder;
    const std::string file = folder / "two.obj", store = folder / "two.abut";
    std::ofstream(file)
        << "o tank\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
           "o pipe\nv .2 0 0\nv 1.2 0 0\nv .2 1 0\nv .2 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";
    const char* const path = file.c_str();
    ASSERT_EQ(abut_import(&path, 1, store.c_str()), ABUT_OK) << abut_error_message();
    abut_report* report = nullptr;
    ASSERT_EQ(abut_find_clashes_in_store(store.c_str(), nullptr, 0, &report), ABUT_OK)
        << abut_error_message();
    EXPECT_NE(std::string(abut_report_json(report)).find("out_of_core"), std::string::npos);
    abut_report_free(report);
    EXPECT_EQ(abut_find_clashes_in_store("missing.abut", nullptr, 0, &report), ABUT_FILE_NOT_FOUND);
}

} // namespace
