// Viewpoints of clashes, compared with rays.
#include <abut/clash_review.h>
#include <abut/clash_viewpoint.h>
#include <abut/error.h>
#include <abut/progress.h>
#include <abut/shape_queries.h>

#include "clash/viewpoint/depth_picture.h"
#include "tests/support/clash/clash_scenes.h"
#include "tests/support/folder.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

namespace abut::test {
namespace {

Scene scene_of(const std::string& file, const std::vector<Mesh>& meshes) {
    Scene scene;
    scene.file = file;
    scene.up = UpAxis::z;
    scene.meshes = meshes;
    for (std::uint32_t i = 0; i < meshes.size(); ++i)
        scene.parts.push_back({file + std::to_string(i), "Part", "Thing", i, {}, {}});
    return scene;
}

bool is_in(const Box3& box, const Vec3& p, double margin = 0) {
    return overlap({p, p}, box, margin);
}

/// Fractions of a 40-row picture that the sides cover, by rays.
std::array<double, 2> seen_by_rays(const ClashViewpoint& view, const std::vector<Scene>& models) {
    Camera camera;
    camera.eye = view.eye;
    camera.forward = view.direction;
    camera.up = view.up;
    camera.field_of_view = view.fov;
    camera.height = 40;
    camera.width = static_cast<std::uint32_t>(std::lround(40 * view.aspect));
    std::vector<std::tuple<Model, Transform, int>> parts;
    for (std::uint32_t m = 0; m < models.size(); ++m)
        for (std::uint32_t i = 0; i < models[m].parts.size(); ++i) {
            const ReportPart part{m, i};
            const bool a = std::ranges::find(view.side_a, part) != view.side_a.end();
            const bool b = std::ranges::find(view.side_b, part) != view.side_b.end();
            parts.emplace_back(Model(models[m].meshes[models[m].parts[i].mesh]),
                               models[m].parts[i].world_from_mesh,
                               a   ? 0
                               : b ? 1
                                   : 2);
        }
    std::array<double, 2> seen{};
    for (std::uint32_t y = 0; y < camera.height; ++y)
        for (std::uint32_t x = 0; x < camera.width; ++x) {
            const Ray ray = ray_through(camera, x + 0.5, y + 0.5);
            double nearest = 1e300;
            int side = 2;
            for (const auto& [model, world, of] : parts)
                for (const RayHit& hit : all_hits(model, world, ray))
                    if (is_in(view.section_box, hit.point) && hit.t < nearest)
                        nearest = hit.t, side = of;
            if (side < 2)
                seen.at(static_cast<std::size_t>(side)) += 1.0 / (camera.width * camera.height);
        }
    return seen;
}

bool same_view(const ClashViewpoint& a, const ClashViewpoint& b) {
    return a.eye == b.eye && a.direction == b.direction && a.up == b.up &&
           a.section_box == b.section_box && a.shown_a == b.shown_a && a.shown_b == b.shown_b;
}

std::vector<std::vector<std::uint32_t>> one_by_one(std::size_t count) {
    std::vector<std::vector<std::uint32_t>> lists;
    for (std::uint32_t i = 0; i < count; ++i)
        lists.push_back({i});
    return lists;
}

TEST(ClashViewpoint, ShowsAsMuchAsRaysFind) {
    Random random(2001);
    int clashes = 0, shown = 0;
    for (int round = 0; round < many(3); ++round) {
        std::vector<Scene> models{some_scene(random, 12, 1), some_scene(random, 12, 1)};
        models[0].file = "a", models[1].file = "b";
        const ClashReport report = find_clashes(models, {});
        const std::size_t some = std::min<std::size_t>(5, report.clashes.size());
        const auto views = clash_viewpoints(report, models, one_by_one(some));
        for (const ClashViewpoint& view : views) {
            const auto seen = seen_by_rays(view, models);
            EXPECT_NEAR(seen[0], view.shown_a, 0.01);
            EXPECT_NEAR(seen[1], view.shown_b, 0.01);
            EXPECT_NEAR(length(view.direction), 1, 1e-12);
            EXPECT_NEAR(dot(view.direction, view.up), 0, 1e-12);
            ++clashes;
            shown += view.shown_a > 0.01 && view.shown_b > 0.01 ? 1 : 0;
        }
    }
    std::cout << shown << " of " << clashes << " show both sides\n";
    EXPECT_GT(clashes, 10);
    EXPECT_GT(shown, clashes * 8 / 10);
}

TEST(ClashViewpoint, LooksPastAWall) {
    // Walls on three sides and above: only from the east both pipes show.
    const std::vector<Mesh> walls{box_mesh({-0.2, -0.2, -0.2}, {-0.152, 0.2, 0.2}),
                                  box_mesh({-0.2, 0.152, -0.2}, {0.2, 0.2, 0.2}),
                                  box_mesh({-0.2, -0.2, -0.2}, {0.2, -0.152, 0.2}),
                                  box_mesh({-0.2, -0.2, 0.152}, {0.2, 0.2, 0.2}),
                                  box_mesh({-0.2, -0.2, -0.2}, {0.2, 0.2, -0.152})};
    const std::vector<Scene> models{
        scene_of("a", {box_mesh({-0.15, -0.1, -0.1}, {0.15, 0.1, 0.1})}),
        scene_of("b", {box_mesh({-0.09, -0.15, -0.09}, {0.09, 0.15, 0.09})}), scene_of("c", walls)};
    const ClashReport report = find_clashes(models, {});
    const auto found = std::ranges::find_if(
        report.clashes, [](const Clash& c) { return c.model[0] == 0 && c.model[1] == 1; });
    ASSERT_NE(found, report.clashes.end());
    const auto index = static_cast<std::uint32_t>(found - report.clashes.begin());
    const ClashViewpoint view = clash_viewpoint(report, models, index, {.near = true});
    EXPECT_LT(view.direction.x, -0.7);
    EXPECT_GT(view.shown_a, 0.01);
    EXPECT_GT(view.shown_b, 0.01);
    EXPECT_EQ(view.side_a, (std::vector<ReportPart>{{0, 0}}));
    EXPECT_EQ(view.side_b, (std::vector<ReportPart>{{1, 0}}));
    ASSERT_EQ(view.near.size(), walls.size());
    EXPECT_EQ(view.near.front(), (NamedPart{"c", "c0"}));
}

TEST(ClashViewpoint, OpensWhatHidesAPart) {
    const std::vector<Scene> models{scene_of("a", {box_mesh({0, 0, 0}, {1, 1, 1})}),
                                    scene_of("b", {box_mesh({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7})})};
    const ClashReport report = find_clashes(models, {});
    ASSERT_EQ(report.clashes.size(), 1U);
    const ClashViewpoint view = clash_viewpoint(report, models, 0);
    EXPECT_GT(view.shown_a, 0.05);
    EXPECT_GT(view.shown_b, 0.02);
    const auto seen = seen_by_rays(view, models);
    EXPECT_NEAR(seen[0], view.shown_a, 0.01);
    EXPECT_NEAR(seen[1], view.shown_b, 0.01);
}

TEST(ClashViewpoint, OfDuplicatesShowsBoth) {
    const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
    const std::vector<Scene> models{scene_of("a", {box}), scene_of("b", {box})};
    const ClashReport report = find_clashes(models, {});
    ASSERT_EQ(report.clashes.size(), 1U);
    const ClashViewpoint view = clash_viewpoint(report, models, 0);
    EXPECT_GT(view.shown_a, 0.05);
    EXPECT_NEAR(view.shown_a, view.shown_b, 0.01);
}

TEST(ClashViewpoint, OfAGroupHasTheSharedPartOnOneSide) {
    const std::vector<Scene> models{
        scene_of("a", {box_mesh({0, 0, 0}, {4, 0.1, 0.1}), box_mesh({9, 0, 0}, {9.1, 1, 1})}),
        scene_of("b", {box_mesh({1, -1, 0}, {1.1, 1, 0.1}), box_mesh({3, -1, 0}, {3.1, 1, 0.1})})};
    const ClashReport report = find_clashes(models, {});
    ASSERT_EQ(report.clashes.size(), 2U);
    const ClashViewpoint view = clash_viewpoints(report, models, {{0, 1}}).front();
    EXPECT_EQ(view.side_a, (std::vector<ReportPart>{{0, 0}}));
    EXPECT_EQ(view.side_b, (std::vector<ReportPart>{{1, 0}, {1, 1}}));
    EXPECT_TRUE(is_in(view.section_box, report.clashes[0].point_a));
    EXPECT_TRUE(is_in(view.section_box, report.clashes[1].point_a));
    const auto seen = seen_by_rays(view, models);
    EXPECT_NEAR(seen[0], view.shown_a, 0.01);
    EXPECT_GT(view.shown_b, 0.001);
    const ClashViewpoint nothing = clash_viewpoints(report, models, {{}}).front();
    EXPECT_TRUE(nothing.side_a.empty());
}

TEST(ClashViewpoint, OfAStoreAndOfAnyNumberOfThreadsIsTheSame) {
    Random random(2002);
    const Folder folder;
    std::vector<std::string> files;
    for (const char* name : {"a.glb", "b.glb"}) {
        files.push_back(folder / name);
        write_glb(some_scene(random, 25, 1.5), files.back());
    }
    const std::vector<Scene> models = read_scenes(files);
    const ClashReport report = find_clashes(models, {});
    ASSERT_GT(report.clashes.size(), 5U);
    const std::string path = folder / "plant.abut";
    import_models(files, path);
    const Store store = open_store(path);
    const StoreClashReport found = find_clashes(store, {});
    ASSERT_EQ(found.report.clashes.size(), report.clashes.size());
    auto lists = one_by_one(report.clashes.size());
    lists.push_back({0, 1, 2, 3});
    const auto all = clash_viewpoints(report, models, lists, {.near = true});
    const auto stored = clash_viewpoints(found, store, lists, {.near = true});
    for (std::size_t i = 0; i < lists.size(); ++i) {
        EXPECT_TRUE(same_view(all[i], stored[i])) << i;
        EXPECT_EQ(all[i].near, stored[i].near);
    }
    set_threads(1);
    const auto alone = clash_viewpoints(report, models, lists);
    set_threads(0);
    for (std::size_t i = 0; i < lists.size(); ++i)
        EXPECT_TRUE(same_view(all[i], alone[i])) << i;
}

TEST(ClashViewpoint, OfAListedClashIsThatOfItsJob) {
    Random random(2003);
    const Folder folder;
    std::vector<std::string> files;
    for (const char* name : {"a.glb", "b.glb"}) {
        files.push_back(folder / name);
        write_glb(some_scene(random, 20, 1.5), files.back());
    }
    const std::string path = folder / "plant.abut";
    import_models(files, path);
    const Store store = open_store(path, {.read_only = false});
    const StoreClashReport found = find_clashes(store, {.clearance = 0.05});
    const auto reviews = review_clashes(store);
    ASSERT_EQ(reviews.size(), 1U);
    ASSERT_EQ(reviews[0].clashes.size(), found.report.clashes.size());
    ASSERT_GT(reviews[0].clashes.size(), 5U);
    std::size_t same = 0;
    for (const ListedClash& listed : reviews[0].clashes) {
        const auto at = std::ranges::find(found.report.clashes, listed.id, &Clash::id);
        ASSERT_NE(at, found.report.clashes.end());
        const auto index = static_cast<std::uint32_t>(at - found.report.clashes.begin());
        const ClashViewpoint of_job = clash_viewpoint(found, store, index, {.near = true});
        const ClashViewpoint view = clash_viewpoint(store, listed, {.near = true});
        same += same_view(view, of_job) ? 1 : 0;
        EXPECT_EQ(view.near, of_job.near);
        const Scene parts = read_parts(store, view.side_a.front().model);
        EXPECT_EQ(parts.parts.at(view.side_a.front().part).id, listed.part[0]);
    }
    EXPECT_EQ(same, reviews[0].clashes.size());
    ListedClash gone = reviews[0].clashes.front();
    gone.part[1] = "gone";
    EXPECT_THROW(clash_viewpoint(store, gone), Error);
    std::atomic<bool> stop{true};
    EXPECT_THROW(clash_viewpoint(store, reviews[0].clashes.front(), {.progress = {{}, &stop}}),
                 Error);
}

TEST(ClashViewpoint, RefusesWhatCannotBe) {
    const std::vector<Scene> models{scene_of("a", {box_mesh({0, 0, 0}, {1, 1, 1})})};
    const ClashReport report = find_clashes(models, {});
    EXPECT_THROW(clash_viewpoint(report, models, 0), Error);
    EXPECT_THROW(clash_viewpoints(report, models, {}, {.fov = 4}), Error);
    EXPECT_THROW(clash_viewpoints(report, models, {}, {.aspect = 0}), Error);
    std::atomic<bool> stop{true};
    EXPECT_THROW(clash_viewpoints(report, models, {}, {.progress = {{}, &stop}}), Error);
}

TEST(DepthPicture, CutsWhatReachesBehindTheEye) {
    Camera camera;
    camera.width = 20, camera.height = 20;
    camera.forward = {0, 1, 0};
    DepthPicture picture(20, 20);
    picture.begin(CameraFrame(camera));
    // A floor below the eye, from far behind to far ahead, covers the lower half.
    picture.draw({Vec3{-1e4, -1e4, -1}, Vec3{1e4, -1e4, -1}, Vec3{0, 1e5, -1}}, 7);
    const auto owners = picture.owners();
    EXPECT_EQ(std::ranges::count(owners.first(200), DepthPicture::kNothing), 200);
    EXPECT_EQ(std::ranges::count(owners.last(180), 7U), 180);
}

} // namespace
} // namespace abut::test
