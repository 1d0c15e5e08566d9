// Tours worked by hand, and damaged files.
#include <abut/error.h>
#include <abut/tour.h>

#include "math/vector.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/store/level_trees.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

Tour three_points() {
    return {{{0, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, "start"},
             {2, {0, 4, 0}, {0, 1, 0}, {0, 0, 1}, ""},
             {4, {4, 8, 0}, {1, 0, 0}, {0, 0, 1}, "end"}}};
}

double angle_of(const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

TEST(Tour, PassesThroughItsPoints) {
    const Tour tour = three_points();
    EXPECT_EQ(duration(tour), 4);
    for (const TourPoint& point : tour.points) {
        const Camera camera = camera_at(tour, point.seconds);
        EXPECT_NEAR(length(camera.eye - point.eye), 0, 1e-12);
        EXPECT_NEAR(length(camera.forward - point.forward), 0, 1e-12);
        EXPECT_NEAR(length(camera.up - point.up), 0, 1e-12);
    }
    EXPECT_EQ(camera_at(tour, -5).eye, tour.points[0].eye);
    EXPECT_EQ(camera_at(tour, 50).eye, tour.points[2].eye);
}

TEST(Tour, TurnsEvenlyAndMovesSmoothly) {
    const Tour tour = three_points();
    // A quarter turn within two seconds.
    const Vec3 third = camera_at(tour, 2 + 2.0 / 3).forward;
    EXPECT_NEAR(angle_of({0, 1, 0}, third), std::acos(-1.0) / 6, 1e-12);
    EXPECT_NEAR(angle_of(third, {1, 0, 0}), std::acos(-1.0) / 3, 1e-12);
    // The velocity at the middle point is that between its neighbours: (1, 2, 0).
    constexpr double kStep = 1e-6;
    const Vec3 before = camera_at(tour, 2 - kStep).eye, at = camera_at(tour, 2).eye,
               after = camera_at(tour, 2 + kStep).eye;
    EXPECT_NEAR(length((1 / kStep) * (at - before) - Vec3{1, 2, 0}), 0, 1e-4);
    EXPECT_NEAR(length((1 / kStep) * (after - at) - Vec3{1, 2, 0}), 0, 1e-4);
}

TEST(Tour, ACutJumps) {
    Tour tour = three_points();
    tour.points.insert(tour.points.begin() + 2, {2, {100, 0, 0}, {0, 0, 1}, {0, 1, 0}, ""});
    EXPECT_NEAR(length(camera_at(tour, 2 - 1e-9).eye - Vec3{0, 4, 0}), 0, 1e-6);
    EXPECT_EQ(camera_at(tour, 2).eye, (Vec3{100, 0, 0}));
    // Both sides are straight: the cut does not bend them.
    EXPECT_NEAR(length(camera_at(tour, 1).eye - Vec3{0, 2, 0}), 0, 1e-12);
    EXPECT_NEAR(length(camera_at(tour, 3).eye - Vec3{52, 4, 0}), 0, 1e-12);
}

TEST(Tour, InterpolatesAnyDirections) {
    Random random(111);
    for (int i = 0; i < 1000; ++i) {
        Tour tour;
        for (int k = 0; k < 2; ++k) {
            const Camera c = random_camera(random, {}, 10);
            tour.points.push_back({double(k), c.eye, c.forward, c.up, ""});
        }
        if (random.chance(0.2)) // half a turn, which has no shortest way
            tour.points[1].forward = -tour.points[0].forward, tour.points[1].up = tour.points[0].up;
        const Camera a = camera_at(tour, 0.3), b = camera_at(tour, 0.6);
        for (const Camera& c : {a, b}) {
            ASSERT_NEAR(length(c.forward), 1, 1e-12);
            ASSERT_NEAR(length(c.up), 1, 1e-12);
            ASSERT_NEAR(dot(c.forward, c.up), 0, 1e-12);
        }
        // The ends have the given directions.
        ASSERT_NEAR(angle_of(camera_at(tour, 1e-12).forward, tour.points[0].forward), 0, 1e-6);
        ASSERT_NEAR(angle_of(camera_at(tour, 1 - 1e-12).forward, tour.points[1].forward), 0, 1e-6);
        ASSERT_LE(std::abs(dot(camera_at(tour, 0).up, tour.points[0].forward)),
                  length(tour.points[0].forward) * length(tour.points[0].up));
    }
}

TEST(Tour, RecordsAtMostThirtyPointsASecond) {
    Tour tour;
    Camera camera;
    for (int i = 0; i <= 240; ++i) {
        camera.eye.x = i;
        record(tour, i / 240.0, camera, i == 7 ? "here" : "");
    }
    EXPECT_GE(tour.points.size(), 28U);
    EXPECT_LE(tour.points.size(), 32U);
    EXPECT_EQ(tour.points[1].name, "here");
    EXPECT_THROW(record(tour, 0.5, camera), Error);
    camera.forward = {};
    EXPECT_THROW(record(tour, 5, camera), Error);
}

TEST(Tour, IsWrittenAndRead) {
    const Folder folder;
    Random random(112);
    Tour tour;
    for (int i = 0; i < 50; ++i) {
        const Camera c = random_camera(random, random.in_cube(1e6), 10);
        tour.points.push_back({0.1 * i, c.eye, c.forward, c.up, i % 3 == 0 ? "Büro \"1\"" : ""});
    }
    write_tour(tour, folder / "a.json");
    EXPECT_EQ(read_tour(folder / "a.json"), tour);
    write_tour({}, folder / "b.json");
    EXPECT_EQ(read_tour(folder / "b.json"), Tour{});
    EXPECT_THROW(camera_at({}, 0), Error);
    tour.points[3].seconds = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(write_tour(tour, folder / "c.json"), Error);
    tour.points[3] = tour.points[2];
    tour.points[3].name = "\xff";
    EXPECT_THROW(write_tour(tour, folder / "c.json"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "c.json"));
}

TEST(Tour, RefusesBadFiles) {
    const Folder folder;
    const std::string good = R"({"seconds":0,"eye":[0,0,0],"forward":[0,1,0],"up":[0,0,1]})";
    const auto tour_of = [](const std::string& points) {
        return R"({"abut_tour":1,"points":[)" + points + "]}";
    };
    const auto error_of = [&](const std::string& text) {
        std::ofstream(folder / "t.json") << text;
        try {
            (void)read_tour(folder / "t.json");
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(folder / "t.json")) << error.what();
            EXPECT_EQ(error.what(), std::string(error.what()).substr(0, 300));
            return std::pair(error.code(), std::string(error.what()));
        }
        return std::pair(ErrorCode::interrupted, std::string("no error"));
    };
    EXPECT_EQ(error_of(tour_of(good)).second, "no error");
    const std::vector<std::string> bad{
        "",
        "[",
        "null",
        "[]",
        "{}",
        R"({"abut_tour":1})",
        R"({"abut_tour":1,"points":{}})",
        tour_of("1"),
        tour_of("{}"),
        tour_of(R"({"seconds":"0","eye":[0,0,0],"forward":[0,1,0],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0],"forward":[0,1,0],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0,null],"forward":[0,1,0],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0,1e19],"forward":[0,1,0],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0,1e999],"forward":[0,1,0],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0,0],"forward":[0,0,0],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0,0],"forward":[0,0,1],"up":[0,0,1]})"),
        tour_of(R"({"seconds":0,"eye":[0,0,0],"forward":[0,1,0],"up":[0,0,1],"name":5})"),
        tour_of(R"({"seconds":1,"eye":[0,0,0],"forward":[0,1,0],"up":[0,0,1]},)" + good)};
    for (const std::string& text : bad)
        EXPECT_EQ(error_of(text).first, ErrorCode::malformed) << text;
    EXPECT_EQ(error_of(R"({"abut_tour":2,"points":[]})").first, ErrorCode::unsupported);
    EXPECT_NE(error_of(tour_of(good + ",7")).second.find("points[1]"), std::string::npos);
    EXPECT_THROW(read_tour(folder / "none.json"), Error);
    EXPECT_THROW(read_tour(folder / "."), Error);
}

} // namespace
} // namespace abut::test
