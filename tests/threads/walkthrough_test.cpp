// A walk through a store while its levels are drawn: the threads that load and those that ask, without
// OpenGL. For the thread sanitizer (tools/check_threads); without it, the test checks little.
#include <abut/carry.h>
#include <abut/levels.h>
#include <abut/scene.h>
#include <abut/view.h>
#include <abut/walk.h>

#include "math/vector.h"
#include "scenes/plant/plant.h"
#include "tests/support/folder.h"

#include <cmath>
#include <gtest/gtest.h>
#include <thread>

namespace abut::test {
namespace {

constexpr int kFrames = 120;

struct Room {
    Room() {
        PlantOptions options;
        options.triangles = 60'000;
        options.clashes = 5;
        options.distinct = true;
        write_glb(make_plant(options).scene, folder / "a.glb");
        (void)import_models({folder / "a.glb"}, folder / "a.abut");
        (void)build_levels(folder / "a.abut");
    }
    Folder folder;
};

Vec3 way(const Box3& box, int frame) {
    const double t = 0.1 + 0.8 * frame / kFrames;
    return {box.lower.x + t * (box.upper.x - box.lower.x), box.lower.y + 2,
            box.lower.z + (0.5 + 0.3 * std::sin(9 * t)) * (box.upper.z - box.lower.z)};
}

TEST(Threads, LevelsAreBuiltWithSeveral) {
    const Room room;
    EXPECT_TRUE(has_levels(open_store(room.folder / "a.abut")));
}

TEST(Threads, FramesAndQueriesAtOnce) {
    const Room room;
    const Store store = open_store(room.folder / "a.abut");
    ViewOptions small;
    small.memory = small.gpu_memory = std::uint64_t{4} << 20;
    small.triangle_budget = 20'000;
    View view(store, small);
    const Box3 box = view.bounds();
    std::uint64_t drawn = 0, near = 0;
    std::thread looking([&] {
        for (int i = 0; i < kFrames; ++i) {
            Camera camera;
            camera.eye = way(box, i);
            camera.forward = {std::cos(0.05 * i), 0, std::sin(0.05 * i)};
            camera.up = {0, 1, 0};
            drawn += view.frame(camera, {1, 0, 0}).draws.size();
            if (i % 30 == 29)
                view.wait();
        }
    });
    std::thread asking([&] {
        Walk walk(store, {.memory = std::uint64_t{4} << 20});
        const Probe head(Sphere{{0, 0, 0}, 0.3});
        for (int i = 0; i < kFrames; ++i) {
            walk.move_to(way(box, i), {1, 0, 0});
            const Pose pose{way(box, i)};
            near += walk.within(head, pose, 2, {.missing = MissingParts::skip}).parts.size();
            (void)walk.distance(head, pose, {.missing = MissingParts::skip});
            if (i % 20 == 19)
                walk.wait();
        }
    });
    std::thread carrying([&] {
        Walk walk(store, {.memory = std::uint64_t{8} << 20});
        Carry carry(walk, WalkPart{view.parts()[view.parts().size() / 2]});
        CarryOptions options;
        options.depth_steps = 500;
        for (int i = 0; i < 15; ++i) {
            Pose pose = carry.state().pose;
            pose.translation = pose.translation + Vec3{0.2, 0, 0.1};
            options.mode = i % 2 == 0 ? CarryMode::slide : CarryMode::through;
            (void)carry.move_to(pose, options);
        }
    });
    looking.join();
    asking.join();
    carrying.join();
    EXPECT_GT(drawn, 0U);
    EXPECT_GT(near, 0U);
}

} // namespace
} // namespace abut::test
