// The picture of levels of detail at an error of one pixel, compared with that of the full geometry.
#include <abut/error.h>
#include <abut/levels.h>
#include <abut/picture.h>
#include <abut/renderer.h>
#include <abut/view.h>

#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>

namespace abut::test {
namespace {

constexpr std::uint32_t kLevelWidth = 320, kLevelHeight = 180;
constexpr int kEyes = 8;
constexpr int kVisible = 16; ///< of 255: pixels that differ by more count

class LevelPictures : public testing::Test {
protected:
    void SetUp() override {
        try {
            const OffscreenContext context;
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

/// A sheet of 16 x 8 metres with waves that are less deep than a pixel, but wider.
Mesh corrugated_sheet() {
    constexpr int kWaves = 40;
    Mesh mesh;
    for (int i = 0; i <= 2 * kWaves; ++i)
        for (const double z : {0.0, 8.0})
            mesh.positions.push_back({0.2 * i, i % 2 == 0 ? 0 : 0.08, z});
    for (std::uint32_t i = 0; i < 2 * kWaves; ++i) {
        const std::uint32_t a = 2 * i;
        mesh.triangles.push_back({a, a + 2, a + 3});
        mesh.triangles.push_back({a, a + 3, a + 1});
    }
    return mesh;
}

/// A hall with corrugated walls, rings on its floor, and rows of posts.
Scene hall() {
    Scene scene;
    scene.file = "hall.glb";
    scene.up = UpAxis::z;
    const auto add = [&](const Mesh& mesh, const Vec3& at) {
        Transform place;
        place.m[9] = at.x, place.m[10] = at.y, place.m[11] = at.z;
        const std::string id = "part " + std::to_string(scene.parts.size());
        scene.meshes.push_back(mesh);
        scene.parts.push_back(
            {id, id, "", static_cast<std::uint32_t>(scene.meshes.size() - 1), place});
    };
    for (int i = 0; i < 4; ++i)
        for (const double y : {-24.0, 24.0})
            add(corrugated_sheet(), {16.0 * i - 32, y, 0});
    for (int i = 0; i < 24; ++i) {
        const int row = i / 8, column = i % 8;
        add(torus_mesh(1.5 + 0.01 * i, 0.4, 40, 20), {5.0 * column - 18, 5.0 * row - 6, 1});
    }
    for (int i = 0; i < 60; ++i)
        add(box_mesh({0, 0, 0}, {0.15, 0.15, 3 + 0.01 * i}), {0.5 * i - 15, 15, 0});
    return scene;
}

/// The share of the pixels that differ visibly.
double share_of_different(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
        bool differs = false;
        for (std::size_t k = 0; k < 3; ++k)
            differs = differs || std::abs(int{a.pixels[i + k]} - int{b.pixels[i + k]}) > kVisible;
        count += differs ? 1 : 0;
    }
    return 3.0 * static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

/// A view whose frames read all that they need, with its renderer.
struct Shown {
    Shown(const Store& store, double pixel_error)
        : view(store, {.pixel_error = pixel_error,
                       .triangle_budget = std::uint64_t{1} << 40,
                       .draw_budget = 1'000'000,
                       .background = false}),
          renderer(view.parts().size(), view.origin()) {}

    Picture picture(const Camera& camera) {
        RenderStyle style;
        style.up = {0, 0, 1};
        style.ambient_occlusion = false;
        return renderer.picture(view.frame(camera), camera, style);
    }
    View view;
    Renderer renderer;
};

TEST_F(LevelPictures, AtOnePixelLookLikeFullDetail) {
    const Folder folder;
    write_glb(hall(), folder / "a.glb");
    (void)import_models({folder / "a.glb"}, folder / "a.abut");
    (void)build_levels(folder / "a.abut");
    const OffscreenContext context;
    const Store store = open_store(folder / "a.abut");
    Shown coarse(store, 1), exact(store, 1e-9);
    std::uint64_t triangles = 0, all = 0;
    for (int i = 0; i < kEyes; ++i) {
        const double yaw = 2 * std::numbers::pi * (i + 0.3) / kEyes;
        Camera camera;
        camera.eye = {60 * std::cos(yaw), 60 * std::sin(yaw), 4.0 + 2 * i};
        camera.forward = {-camera.eye.x, -camera.eye.y, 3 - camera.eye.z};
        camera.up = {0, 0, 1};
        camera.width = kLevelWidth, camera.height = kLevelHeight;
        const double share = share_of_different(coarse.picture(camera), exact.picture(camera));
        EXPECT_LE(share, 0.005) << "eye " << i;
        triangles += coarse.renderer.statistics().triangles;
        all += exact.renderer.statistics().triangles;
    }
    std::cout << triangles << " triangles in place of " << all << "\n";
    EXPECT_LT(triangles, all / 4 * 3) << "the levels are not used";
}

} // namespace
} // namespace abut::test
