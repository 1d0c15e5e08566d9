// Cameras worked by hand, and checked against projections by the definition.
#include <abut/camera.h>
#include <abut/error.h>

#include "math/vector.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/level_trees.h"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace abut::test {
namespace {

/// Clip coordinates of a point.
std::array<double, 4> clip(const std::array<float, 16>& m, const Vec3& p) {
    std::array<double, 4> result{};
    for (std::size_t row = 0; row < 4; ++row)
        result.at(row) = double{m.at(row)} * p.x + double{m.at(4 + row)} * p.y +
                         double{m.at(8 + row)} * p.z + double{m.at(12 + row)};
    return result;
}

/// Looks along x from (10, 0, 0), z up, with a vertical angle of 90 degrees.
Camera along_x() {
    Camera camera;
    camera.eye = {10, 0, 0}, camera.forward = {5, 0, 0}, camera.up = {1, 0, 3};
    camera.field_of_view = std::numbers::pi / 2;
    camera.width = 200, camera.height = 100;
    camera.near = 1, camera.far = 9;
    return camera;
}

TEST(Camera, ProjectsByHand) {
    const auto m = clip_from_world(along_x());
    // At depth 2 the picture is 4 high and 8 wide; right is -y.
    const auto corner = clip(m, {12, -4, 2});
    EXPECT_NEAR(corner[3], 2, 1e-6);
    EXPECT_NEAR(corner[0] / corner[3], 1, 1e-6);
    EXPECT_NEAR(corner[1] / corner[3], 1, 1e-6);
    const auto near = clip(m, {11, 0, 0}), far = clip(m, {19, 0, 0});
    EXPECT_NEAR(near[2] / near[3], -1, 1e-6);
    EXPECT_NEAR(far[2] / far[3], 1, 1e-6);
}

TEST(Camera, RaysByHand) {
    const Camera camera = along_x();
    const Ray middle = ray_through(camera, 100, 50), corner = ray_through(camera, 0, 0);
    EXPECT_EQ(middle.origin, camera.eye);
    EXPECT_NEAR(length(middle.direction - Vec3{1, 0, 0}), 0, 1e-15);
    EXPECT_NEAR(length(corner.direction - (1 / std::sqrt(6)) * Vec3{1, 2, 1}), 0, 1e-15);
    EXPECT_NEAR(length_of_pixel(camera), 0.02, 1e-15);
}

TEST(Camera, RayHitsThePixelThatItIsThrough) {
    Random random(101);
    for (int i = 0; i < many(2000); ++i) {
        const Camera camera = random_camera(random, random.in_cube(1e5), 50);
        const Vec3 origin = camera.eye + random.in_cube(20);
        const double x = random.uniform(0, camera.width), y = random.uniform(0, camera.height);
        const Ray ray = ray_through(camera, x, y);
        ASSERT_NEAR(length(ray.direction), 1, 1e-14);
        const Vec3 point = ray.origin + random.uniform(1, 100) * ray.direction - origin;
        const auto at = clip(clip_from_world(camera, origin), point);
        ASSERT_GT(at[3], 0);
        ASSERT_NEAR((at[0] / at[3] + 1) / 2 * camera.width, x, 2e-3 * camera.width);
        ASSERT_NEAR((1 - at[1] / at[3]) / 2 * camera.height, y, 2e-3 * camera.height);
    }
}

TEST(Camera, SeesTheWholeBox) {
    Random random(102);
    for (int i = 0; i < many(1000); ++i) {
        Box3 box;
        const Vec3 middle = random.in_cube(100);
        const double size = std::pow(10, random.uniform(-3, 3));
        const int points = random.chance(0.1) ? 1 : 3;
        for (int k = 0; k < points; ++k)
            extend(box, middle + random.in_cube(size));
        const Camera lens = random_camera(random, {}, 1);
        const Vec3 towards = random.direction();
        const Vec3 up = random.chance(0.2) ? -towards : random.direction();
        const Camera camera = look_at_box(box, towards, up, lens);
        EXPECT_NEAR(length(camera.forward - towards), 0, 1e-12);
        const auto m = clip_from_world(camera, camera.eye);
        double widest = 0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3 p{(corner & 1U) != 0 ? box.upper.x : box.lower.x,
                         (corner & 2U) != 0 ? box.upper.y : box.lower.y,
                         (corner & 4U) != 0 ? box.upper.z : box.lower.z};
            const auto at = clip(m, p - camera.eye);
            for (std::size_t axis = 0; axis < 3; ++axis)
                ASSERT_LE(std::abs(at.at(axis)), at[3] * (1 + 1e-6));
            widest = std::max({widest, std::abs(at[0] / at[3]), std::abs(at[1] / at[3])});
        }
        // It is not farther away than needed, unless the near distance demands it.
        if (points > 1 && size > 100 * lens.near) {
            EXPECT_GT(widest, 0.5);
        }
    }
}

TEST(Camera, RefusesWhatIsNoCamera) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::array<std::function<void(Camera&)>, 16> faults{
        [](Camera& c) { c.eye.x = kNan; },
        [](Camera& c) { c.eye.x = 1e19; },
        [](Camera& c) { c.forward = {}; },
        [](Camera& c) { c.forward.y = kNan; },
        [](Camera& c) { c.up = {}; },
        [](Camera& c) { c.up = -2 * c.forward; },
        [](Camera& c) { c.field_of_view = 0; },
        [](Camera& c) { c.field_of_view = std::numbers::pi; },
        [](Camera& c) { c.field_of_view = kNan; },
        [](Camera& c) { c.width = 0; },
        [](Camera& c) { c.height = 0; },
        [](Camera& c) { c.near = 0; },
        [](Camera& c) { c.near = c.far; },
        [](Camera& c) { c.far = kNan; },
        [](Camera& c) { c.near = kNan; },
        [](Camera& c) { c.far = HUGE_VAL; },
    };
    for (const auto& fault : faults) {
        Camera camera;
        fault(camera);
        EXPECT_THROW(clip_from_world(camera), Error);
        EXPECT_THROW(ray_through(camera, 0, 0), Error);
    }
    Camera camera;
    EXPECT_NO_THROW(clip_from_world(camera));
    EXPECT_THROW(ray_through(camera, kNan, 0), Error);
    EXPECT_THROW(look_at_box({}, {1, 0, 0}, {0, 0, 1}), Error);
    camera.forward = {0, 1e200, 0}, camera.up = {0, 0, 1e-200};
    EXPECT_NO_THROW(clip_from_world(camera));
}

} // namespace
} // namespace abut::test
