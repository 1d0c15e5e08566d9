// A renderer that moves leaves out what its last picture hid. Its pictures are those of a renderer
// without a last picture.
#include <abut/error.h>
#include <abut/levels.h>
#include <abut/renderer.h>
#include <abut/scene.h>
#include <abut/view.h>

#include "render/triangle_runs.h"
#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr int kRingRows = 6, kRingColumns = 12, kRingPictures = 12;

/// Rows of rings, each behind a wall with a gap. No two rings are equal, so none is an instance.
Scene rings_behind_walls() {
    Scene scene;
    scene.file = "rings.glb";
    scene.up = UpAxis::y; // GLB keeps the axes as they are
    const auto add = [&](const Mesh& mesh, const Vec3& at) {
        Transform place;
        place.m[9] = at.x, place.m[10] = at.y, place.m[11] = at.z;
        const std::string id = "part " + std::to_string(scene.parts.size());
        scene.meshes.push_back(mesh);
        scene.parts.push_back(
            {id, id, "", static_cast<std::uint32_t>(scene.meshes.size() - 1), place});
    };
    for (int row = 0; row < kRingRows; ++row) {
        const double y = 6.0 * row;
        add(box_mesh({-40, 0, 0}, {-1, 0.2, 5}), {3.0 * row - 8, y, 0});
        add(box_mesh({1, 0, 0}, {40, 0.2, 5}), {3.0 * row - 8, y, 0});
        for (int column = 0; column < kRingColumns; ++column)
            add(torus_mesh(0.8 + 0.01 * column + 0.001 * row, 0.3, 40, 20),
                {3.0 * column - 16.5, y + 3, 1.5 + 0.1 * row});
    }
    return scene;
}

struct ShownRings {
    explicit ShownRings(const Store& store)
        : view(store, {.pixel_error = 1e-6, .triangle_budget = 1 << 24, .background = false}),
          renderer(view.parts().size(), view.origin()) {
        view.set_occlusion(false);
    }
    Picture picture(const Camera& camera) {
        RenderStyle style;
        style.up = {0, 0, 1};
        style.ambient_occlusion = false;
        style.leave_out_backs = true;
        return renderer.picture(view.frame(camera), camera, style);
    }
    View view;
    Renderer renderer;
};

/// The eye goes along the first wall, passes its gap and turns.
Camera camera_of(int picture) {
    Camera camera;
    camera.eye = {1.5 * picture - 18, -4 + 0.3 * picture, 1.6};
    const double turn = 0.1 * picture - 0.5;
    camera.forward = {std::sin(turn), std::cos(turn), 0.02 * picture - 0.1};
    camera.up = {0, 0, 1};
    camera.width = 320, camera.height = 200;
    return camera;
}

TEST(HiddenTriangles, AreLeftOutWithoutAChangeOfThePicture) {
    try {
        const OffscreenContext context;
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    const Folder folder;
    write_glb(rings_behind_walls(), folder / "a.glb");
    (void)import_models({folder / "a.glb"}, folder / "a.abut");
    (void)build_levels(folder / "a.abut");
    const OffscreenContext context;
    const Store store = open_store(folder / "a.abut");
    ShownRings moving(store);
    std::uint64_t drawn = 0, left_out = 0, all = 0;
    for (int i = 0; i < kRingPictures; ++i) {
        ShownRings first(store);
        const Picture wanted = first.picture(camera_of(i));
        EXPECT_EQ(moving.picture(camera_of(i)), wanted) << "picture " << i;
        const RenderStatistics of_first = first.renderer.statistics();
        const RenderStatistics now = moving.renderer.statistics();
        EXPECT_EQ(now.triangles + now.hidden_triangles,
                  of_first.triangles + of_first.hidden_triangles);
        if (i > 0)
            drawn += now.triangles, left_out += now.hidden_triangles, all += of_first.triangles;
    }
    EXPECT_GT(left_out, drawn / 2);
    EXPECT_LT(drawn, all / 2) << "what the last picture hid is drawn";
}

TEST(HiddenTriangles, RunsHoldEachTriangleOfAChunkOnce) {
    ViewChunk chunk;
    chunk.lower = {1, 2, 3}, chunk.step = {0.5F, 0.25F, 0.125F};
    for (std::uint16_t i = 0; i < 300; ++i)
        chunk.vertices.push_back({{i, static_cast<std::uint16_t>(2 * i), 7}, {}, 0});
    for (std::uint16_t i = 0; i + 2 < 300; ++i)
        for (std::uint16_t k = 0; k < 3; ++k)
            chunk.indices.push_back(static_cast<std::uint16_t>(i + k));
    chunk.closed_triangles = 100;
    const std::vector<TriangleRun> runs = triangle_runs(chunk);
    std::uint32_t next = 0;
    for (const TriangleRun& run : runs) {
        EXPECT_EQ(run.first, next);
        EXPECT_GT(run.end, run.first);
        EXPECT_EQ(run.first < 300, run.end <= 300) << "a run of closed surfaces and others";
        const std::uint32_t first_triangle = run.first / 3, end_triangle = run.end / 3;
        const auto first = static_cast<float>(first_triangle);
        const auto last = static_cast<float>(end_triangle + 1);
        EXPECT_EQ(run.lower, (std::array<float, 3>{1 + 0.5F * first, 2 + 0.5F * first, 3.875F}));
        EXPECT_EQ(run.upper, (std::array<float, 3>{1 + 0.5F * last, 2 + 0.5F * last, 3.875F}));
        next = run.end;
    }
    EXPECT_EQ(next, chunk.indices.size());
    EXPECT_TRUE(triangle_runs({}).empty());
}

} // namespace
} // namespace abut::test
