#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(Info, CountsAClosedBox) {
    const TemporaryFolder folder;
    const Outcome outcome = run_abut({"info", folder.write("box.obj", box_obj()), "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto file = outcome.json()["files"][0];
    EXPECT_EQ(file["parts"], 1);
    EXPECT_EQ(file["meshes"], 1);
    EXPECT_EQ(file["triangles"], 12);
    EXPECT_EQ(file["stored_triangles"], 12);
    EXPECT_EQ(file["closed_parts"], 1);
    EXPECT_EQ(file["boundary_edges"], 0);
    EXPECT_EQ(file["nonmanifold_edges"], 0);
    EXPECT_EQ(file["flipped_edges"], 0);
    EXPECT_EQ(file["degenerate_triangles"], 0);
    EXPECT_EQ(file["duplicate_triangles"], 0);
    EXPECT_EQ(file["bounds"]["lower"], nlohmann::json({0.0, 0.0, 0.0}));
    EXPECT_EQ(file["bounds"]["upper"], nlohmann::json({1.0, 1.0, 1.0}));
}

TEST(Info, CountsDefects) {
    const TemporaryFolder folder;
    // A square of two triangles, one of them stored twice, and one triangle of zero area.
    const std::string soup =
        folder.write("soup.off", "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n"
                                 "3 0 1 2\n3 0 2 3\n3 0 2 3\n3 0 1 4\n");
    const Outcome outcome = run_abut({"info", soup, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto file = outcome.json()["files"][0];
    EXPECT_EQ(file["triangles"], 4);
    EXPECT_EQ(file["closed_parts"], 0);
    EXPECT_EQ(file["degenerate_triangles"], 1);
    EXPECT_EQ(file["duplicate_triangles"], 1);
    EXPECT_GT(file["boundary_edges"], 0);
    EXPECT_EQ(file["nonmanifold_edges"], 1); // the diagonal: used by three triangles
}

TEST(Info, CountsConvexPieces) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj());
    const Outcome outcome = run_abut({"info", box, "--pieces", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto row = outcome.json()["files"][0]["convex_pieces"][0];
    EXPECT_EQ(row["pieces"], 1);
    EXPECT_EQ(row["largest"], 12);
    const std::string open = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n");
    const auto none = run_abut({"info", open, "--pieces", "--json"});
    ASSERT_EQ(none.status, 0) << none.err;
    EXPECT_TRUE(none.json()["files"][0]["convex_pieces"][0]["pieces"].is_null());
    // A query of solids is refused, naming the file.
    const Outcome refused = run_abut({"distance", box, open, "--pieces"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find(open), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("is open"), std::string::npos) << refused.err;
}

TEST(Info, CountsInstancesAndStoredTriangles) {
    const TemporaryFolder folder;
    Scene scene;
    scene.meshes = {unit_box()};
    for (int i = 0; i < 3; ++i)
        scene.parts.push_back(part("box" + std::to_string(i), "Box", 0, placed(2 * i, 0, 0)));
    scene.parts[1].colour = Colour{1, 2, 255};
    scene.parts[2].colour = Colour{1, 2, 255, 128};
    write_glb(scene, folder / "boxes.glb");
    const Outcome outcome = run_abut({"info", folder / "boxes.glb", "--json", "--parts"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto file = outcome.json()["files"][0];
    EXPECT_EQ(file["parts"], 3);
    EXPECT_EQ(file["meshes"], 1);
    EXPECT_EQ(file["triangles"], 36);
    EXPECT_EQ(file["stored_triangles"], 12);
    EXPECT_EQ(file["closed_parts"], 3);
    EXPECT_EQ(file["bounds"]["upper"], nlohmann::json({5.0, 1.0, 1.0}));
    ASSERT_EQ(file["part_list"].size(), 3U);
    EXPECT_EQ(file["part_list"][2]["name"], "box2");
    EXPECT_EQ(file["part_list"][2]["type"], "Box");
    EXPECT_EQ(file["part_list"][0]["colour"], nullptr);
    EXPECT_EQ(file["part_list"][1]["colour"], "#0102ff");
    EXPECT_EQ(file["part_list"][2]["colour"], "#0102ff80");
    EXPECT_EQ(file["part_list"][2]["bounds"]["lower"], nlohmann::json({4.0, 0.0, 0.0}));
}

TEST(Info, TakesAUnit) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_abut({"info", folder.write("box.obj", box_obj()), "--json", "--unit", "0.5"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["files"][0]["bounds"]["upper"], nlohmann::json({0.5, 0.5, 0.5}));
}

TEST(Info, SaysSoIfStandardOutputIsFull) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj());
    const std::string command =
        std::string(ABUT_COMMAND) + " info '" + box + "' >/dev/full 2>'" + (folder / "err") + "'";
    const int status = std::system(command.c_str()); // NOLINT: the shell redirects
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_NE(read_file(folder / "err").find("standard output"), std::string::npos);
}

} // namespace
} // namespace abut::test
