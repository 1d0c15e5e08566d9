/// Ctrl-C in each stage: status 130, nothing on standard output, no file on disk.
#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <csignal>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Thousands of overlapping balls: far more work than a test can wait for.
Scene endless_work() {
    Scene scene;
    scene.meshes = {ball(40)};
    for (int i = 0; i < 3000; ++i)
        scene.parts.push_back(part("ball" + std::to_string(i), "Ball", 0,
                                   placed(0.0002 * i, 0.0007 * (i % 37), 0.0003 * (i % 11))));
    return scene;
}

void expect_interrupted(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("abut: interrupted\n"), std::string::npos) << outcome.err;
}

TEST(Interrupt, AClashJobLeavesNothing) {
    const TemporaryFolder folder;
    const std::string file = folder / "balls.glb";
    write_glb(endless_work(), file);
    for (const char* stage : {"import", "narrow"})
        for (const int signal : {SIGINT, SIGTERM}) {
            SCOPED_TRACE(std::string(stage) + ", signal " + std::to_string(signal));
            expect_interrupted(run_abut_and_signal(
                {"clash", file, "--clearance", "1", "--out", folder / "out", "--progress"}, stage,
                signal));
            EXPECT_EQ(folder.list(), std::vector<std::string>{"balls.glb"});
        }
}

TEST(Interrupt, AnUnfinishedSceneLeavesNothing) {
    const TemporaryFolder folder;
    expect_interrupted(run_abut_and_signal(
        {"scene", "plant", "--triangles", "20000000", "--out", folder / "plant.glb", "--progress"},
        "scene", SIGINT));
    for (const int signal : {SIGINT, SIGTERM})
        expect_interrupted(run_abut_and_signal({"scene", "twist", "--triangles", "5000", "--frames",
                                                "10000", "--out", folder / "frames", "--progress"},
                                               "frames", signal));
    EXPECT_EQ(folder.list(), std::vector<std::string>{});
}

} // namespace
} // namespace abut::test
