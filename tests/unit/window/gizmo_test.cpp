/// The handles around a part that is carried: where they are on the screen, and what dragging them
/// means.
#include <abut/renderer.h>

#include "apps/walk/toolbox/gizmo.h"

#include <gtest/gtest.h>
#include <numbers>

namespace abut::viewer {
namespace {

/// Looks at the origin from in front, above and beside.
Camera some_camera() {
    Camera camera;
    camera.eye = {3, -8, 4};
    camera.forward = {-3, 8, -4};
    camera.width = 800, camera.height = 600;
    return camera;
}

ScreenPoint shown_at(const Camera& camera, const Vec3& point) {
    const std::optional<Vec3> seen = on_screen(camera, point);
    EXPECT_TRUE(seen.has_value());
    return {seen->x, seen->y};
}

TEST(Gizmo, IsAsLargeOnTheScreenNearAndFar) {
    const Camera camera = some_camera();
    const Vec3 across = unit(cross(camera.forward, camera.up));
    double first = 0;
    for (const double depth : {0.5, 3.0, 40.0}) {
        const Vec3 middle = camera.eye + depth * unit(camera.forward);
        const Gizmo gizmo = gizmo_at(camera, middle);
        const ScreenPoint a = shown_at(camera, middle);
        const ScreenPoint b = shown_at(camera, middle + gizmo.size * across);
        const double pixels = std::hypot(b.x - a.x, b.y - a.y);
        first = first == 0 ? pixels : first;
        EXPECT_NEAR(pixels, first, 1e-6);
    }
    EXPECT_GT(first, 50);
}

TEST(Gizmo, EachHandleIsFoundAtItsGripAndNoneFarAway) {
    const Camera camera = some_camera();
    const Gizmo gizmo = gizmo_at(camera, {0, 0, 0});
    for (const Handle handle : kHandles) {
        const auto grip = grip_of(camera, gizmo, handle);
        ASSERT_TRUE(grip.has_value()) << to_string(handle);
        EXPECT_EQ(handle_at(camera, gizmo, *grip), handle) << to_string(handle);
    }
    EXPECT_EQ(handle_at(camera, gizmo, {2, 2}), std::nullopt);
}

TEST(Gizmo, HasNoLinesBehindTheEye) {
    const Camera camera = some_camera();
    const Gizmo gizmo = gizmo_at(camera, camera.eye - unit(camera.forward));
    for (const Handle handle : kHandles)
        EXPECT_FALSE(grip_of(camera, gizmo, handle).has_value()) << to_string(handle);
}

TEST(Gizmo, DraggingAnArrowMovesToTheMouse) {
    const Camera camera = some_camera();
    const Gizmo gizmo = gizmo_at(camera, {0, 0, 0});
    for (int along = 0; along < 3; ++along) {
        const Handle handle = kHandles.at(static_cast<std::size_t>(along));
        GizmoDrag drag(camera, gizmo, handle, shown_at(camera, 0.5 * axis(along)));
        EXPECT_NEAR(drag.amount(camera, shown_at(camera, 0.5 * axis(along))), 0, 1e-9);
        EXPECT_NEAR(drag.amount(camera, shown_at(camera, 1.75 * axis(along))), 1.25, 1e-9);
        EXPECT_NEAR(drag.amount(camera, shown_at(camera, -1.0 * axis(along))), -1.5, 1e-9);
    }
}

TEST(Gizmo, DraggingARingTurnsAndCountsWholeTurns) {
    const Camera camera = some_camera();
    const Gizmo gizmo = gizmo_at(camera, {0, 0, 0});
    for (int about = 0; about < 3; ++about) {
        const Vec3 x = axis((about + 1) % 3), y = axis((about + 2) % 3);
        const auto at = [&](double angle) {
            return shown_at(camera, gizmo.size * (std::cos(angle) * x + std::sin(angle) * y));
        };
        GizmoDrag drag(camera, gizmo, kHandles.at(static_cast<std::size_t>(3 + about)), at(0.4));
        double turned = 0;
        for (int i = 1; i <= 20; ++i)
            turned = drag.amount(camera, at(0.4 + 0.5 * i));
        EXPECT_NEAR(turned, 10, 1e-9); // more than one and a half turns
    }
}

TEST(Gizmo, AnArrowThatPointsAtTheEyeKeepsItsAmount) {
    Camera camera = some_camera();
    camera.eye = {0, -5, 0};
    camera.forward = {0, 1, 0};
    const Gizmo gizmo = gizmo_at(camera, {0, 0, 0});
    GizmoDrag drag(camera, gizmo, Handle::move_y, {400, 300});
    EXPECT_EQ(drag.amount(camera, {400, 300}), 0);
    EXPECT_EQ(drag.amount(camera, {401, 300}), 0);
}

} // namespace
} // namespace abut::viewer
