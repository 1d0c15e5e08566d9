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
    options = {};
    options.clearance = -1;
    EXPECT_EQ(abut_find_clashes(&scenes, 1, &options, &report), ABUT_BAD_ARGUMENT);
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
