/// `abut scene` of deforming surfaces writes one file per frame.
#include <abut/frame.h>

#include "scenes/deforming/deforming.h"
#include "tests/command/run_command.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(SceneFrames, EqualThoseOfTheLibrary) {
    const TemporaryFolder folder;
    const Outcome outcome = run_abut({"scene", "fracture", "--triangles", "1500", "--seed", "3",
                                      "--frames", "40", "--out", folder / "out", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const auto scene = make_deforming_scene("fracture", {.triangles = 1500, .seed = 3});
    const nlohmann::json result = outcome.json();
    ASSERT_EQ(result["files"].size(), 40U);
    for (const auto& file : result["files"]) {
        const Mesh mesh = read_frame(file);
        EXPECT_EQ(mesh.positions, scene->mesh().positions);
        EXPECT_EQ(mesh.triangles, scene->mesh().triangles);
        if (file != result["files"].back())
            scene->step();
    }
    EXPECT_EQ(result["files"][39], folder / "out/fracture-0039.ply");
    EXPECT_EQ(result["scene"], "fracture");
    EXPECT_EQ(result["seed"], 3);
    EXPECT_EQ(result["frames"], 40);
    EXPECT_EQ(result["vertices"], scene->mesh().positions.size());
    EXPECT_EQ(result["triangles"], scene->mesh().triangles.size());
}

TEST(SceneFrames, AreNamedAfterTheScene) {
    const TemporaryFolder folder;
    const Outcome outcome = run_abut({"scene", "twist", "--triangles", "1000", "--frames", "2",
                                      "--out", folder / "a.ply", "--quiet"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"a-0000.ply", "a-0001.ply"}));
    const Outcome said =
        run_abut({"scene", "twist", "--triangles", "1000", "--frames", "2", "--out", folder / "b"});
    EXPECT_NE(said.out.find("twist-0001.ply"), std::string::npos) << said.out;
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"a-0000.ply", "a-0001.ply", "b",
                                                       "b/twist-0000.ply", "b/twist-0001.ply"}));
}

TEST(SceneFrames, AFileInTheWayIsRefused) {
    const TemporaryFolder folder;
    const std::string file = folder.write("taken", "");
    expect_refused(run_abut({"scene", "twist", "--frames", "2", "--out", file}), {"taken"});
}

} // namespace
} // namespace abut::test
