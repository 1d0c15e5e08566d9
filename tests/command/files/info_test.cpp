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

/// The line of the bounds of a model that is one triangle.
std::string bounds_of(const std::string& a, const std::string& b, const std::string& c) {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("t.obj", "v " + a + "\nv " + b + "\nv " + c + "\nf 1 2 3\n");
    const std::string text = run_abut({"info", file}).out;
    const std::size_t at = text.find("  bounds      ");
    return at == std::string::npos ? text : text.substr(at + 14, text.find('\n', at) - at - 14);
}

TEST(Info, BoundsHaveTheDigitsThatMeanSomething) {
    EXPECT_EQ(bounds_of("-7e-10 0 0", "1.2 0 0.25", "0 3 1e-17"), "(0, 0, 0) to (1.2, 3, 0.25) m");
    // Six digits would not tell the ends apart.
    EXPECT_EQ(bounds_of("1000000.25 0 0", "1000003.5 0 0", "1000001 2 0"),
              "(1000000.25, 0, 0) to (1000003.5, 2, 0) m");
    EXPECT_EQ(bounds_of("0.0001234567 0 0", "0.0002 0 0", "0 0.0003 0"),
              "(0, 0, 0) to (0.0002, 0.0003, 0) m");
    EXPECT_EQ(bounds_of("-123456 0 0", "654321 7 0", "0 20 -30"),
              "(-123456, 0, -30) to (654321, 20, 0) m");
    EXPECT_EQ(bounds_of("0.333333333333333 0 0", "1 0 0", "1 1 0"),
              "(0.333333, 0, 0) to (1, 1, 0) m");
}

TEST(Info, BoundsAreRoundedAsTheFileIs) {
    const TemporaryFolder folder;
    Scene scene;
    Mesh mesh = unit_box();
    for (Vec3& p : mesh.positions)
        p = {p.x + 5e6, p.y - 7e-10, p.z};
    scene.meshes = {mesh};
    scene.parts = {part("box", "", 0, Transform{})};
    const std::string file = folder / "far.glb";
    write_glb(scene, file);
    const std::string text = run_abut({"info", file}).out;
    EXPECT_NE(text.find("  bounds      (5000000, 0, 0) to (5000001, 1, 1) m\n"), std::string::npos)
        << text;
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
