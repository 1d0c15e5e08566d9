/// Bad input gives one line that names the file and the fault, status 2, and no output.
#include "tests/command/box_test.h"

#include <cstring>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

class BadInputTest : public BoxTest {
protected:
    /// Expects every subcommand that reads to refuse the file by name and to write nothing.
    void expect_all_refuse(const std::string& file) {
        SCOPED_TRACE(file);
        const auto before = folder_.list();
        const std::string name = std::filesystem::path(file).filename().string();
        expect_refused(run_abut({"info", file}), {name});
        expect_refused(run_abut({"distance", box_, file, "--json"}), {name});
        expect_refused(run_abut({"clash", box_, file, "--json", "--out", folder_ / "out"}), {name});
        EXPECT_EQ(folder_.list(), before);
    }
};

/// A text PLY file with these vertices and faces.
std::string ply(const std::string& vertices, int vertex_count, const std::string& faces,
                int face_count) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" +
           vertices + faces;
}

/// A binary STL of `count` triangles that holds only `stored` of them.
std::string stl(std::uint32_t count, std::uint32_t stored) {
    std::string text(80, ' ');
    text.append(reinterpret_cast<const char*>(&count), 4); // NOLINT: bytes of a file
    for (std::uint32_t i = 0; i < stored; ++i) {
        const float corners[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(i)};
        text.append(reinterpret_cast<const char*>(corners), sizeof corners); // NOLINT
        text.append(2, '\0');
    }
    return text;
}

TEST_F(BadInputTest, MissingFilesAndFolders) {
    expect_all_refuse(folder_ / "missing.glb");
    expect_all_refuse(folder_ / "no/such/folder/model.obj");
    std::filesystem::create_directory(folder_ / "folder.obj");
    expect_all_refuse(folder_ / "folder.obj");
    expect_all_refuse(folder_.write("model.xyz", "what is this"));
}

TEST_F(BadInputTest, EmptyFilesAndNoise) {
    for (const char* extension : {"glb", "gltf", "obj", "ply", "stl", "off", "fbx", "dae"}) {
        expect_all_refuse(folder_.write(std::string("empty.") + extension, ""));
        expect_all_refuse(folder_.write(std::string("noise.") + extension,
                                        std::string("\x01\xff\x7fnoise\0{[<", 12)));
    }
}

TEST_F(BadInputTest, TruncatedFilesOfEachFormat) {
    write_glb(one_of_each_kind(), folder_ / "whole.glb");
    const std::string glb = read_file(folder_ / "whole.glb");
    for (const std::size_t size : {std::size_t(8), std::size_t(30), glb.size() / 2, glb.size() - 1})
        expect_all_refuse(
            folder_.write("truncated" + std::to_string(size) + ".glb", glb.substr(0, size)));
    expect_all_refuse(
        folder_.write("truncated.gltf", R"({"asset": {"version": "2.0"}, "meshes": [)"));
    const std::string obj = box_obj();
    expect_all_refuse(folder_.write("truncated.obj", obj.substr(0, obj.size() - 5)));
    expect_all_refuse(folder_.write("truncated.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    expect_all_refuse(
        folder_.write("truncated.ply", ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 2\n", 2)));
    expect_all_refuse(folder_.write("truncated.stl", stl(3, 2)));
    expect_all_refuse(
        folder_.write("truncated.fbx", std::string("Kaydara FBX Binary  \0\x1a\0", 23)));
    expect_all_refuse(folder_.write(
        "truncated.dae", "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><library_geometries>"));
}

TEST_F(BadInputTest, AWholeStlAndPlyAreAccepted) {
    // Whole files like the truncated ones are accepted: those were refused only because they were
    // short.
    EXPECT_EQ(run_abut({"info", folder_.write("whole.stl", stl(2, 2))}).status, 0);
    EXPECT_EQ(run_abut({"info", folder_.write("whole.ply",
                                              ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 2\n", 1))})
                  .status,
              0);
}

TEST_F(BadInputTest, AnIndexOutOfRange) {
    expect_all_refuse(folder_.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"));
    expect_all_refuse(folder_.write("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"));
    expect_all_refuse(folder_.write("index.ply", ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 7\n", 1)));
    expect_all_refuse(
        folder_.write("negative.ply", ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 -1\n", 1)));
}

TEST_F(BadInputTest, CoordinatesThatAreNotFinite) {
    for (const std::string value : {"nan", "inf", "-inf"}) {
        expect_all_refuse(
            folder_.write(value + ".obj", "v 0 0 0\nv 1 0 " + value + "\nv 0 1 0\nf 1 2 3\n"));
        expect_all_refuse(folder_.write(value + ".off",
                                        "OFF\n3 1 0\n0 0 0\n1 0 " + value + "\n0 1 0\n3 0 1 2\n"));
    }
    std::string binary = stl(1, 1);
    const float infinite = std::numeric_limits<float>::infinity();
    std::memcpy(binary.data() + 84 + 12, &infinite, sizeof infinite);
    expect_all_refuse(folder_.write("infinite.stl", binary));
}

TEST_F(BadInputTest, MeshesWithoutATriangleOfAnyArea) {
    expect_all_refuse(folder_.write("empty_mesh.off", "OFF\n0 0 0\n"));
    expect_all_refuse(folder_.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
    expect_all_refuse(folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"));
}

TEST_F(BadInputTest, RulesThatCannotBeUsed) {
    const auto expect_rules_refused = [&](const std::string& name, const std::string& content,
                                          const std::string& word) {
        SCOPED_TRACE(content);
        const std::string rules = folder_.write(name, content);
        const auto before = folder_.list();
        expect_refused(run_abut({"clash", box_, "--rules", rules, "--out", folder_ / "out"}),
                       {name, word});
        EXPECT_EQ(folder_.list(), before);
    };
    expect_rules_refused("unknown.json", R"({"rules": [], "clearence": 1})", "clearence");
    expect_rules_refused("syntax.json", R"({"rules": [)", "");
    expect_rules_refused("type.json", R"({"rules": 7})", "rules");
    expect_rules_refused("empty.json", "", "");
    expect_refused(run_abut({"clash", box_, "--rules", folder_ / "none.json"}), {"none.json"});
}

TEST_F(BadInputTest, OutputThatCannotBeWritten) {
    const auto before = folder_.list();
    // Permissions do not stop root, but a file in the way or a folder of the kernel does.
    expect_refused(run_abut({"clash", box_, "--out", box_}), {"box.obj", "cannot be written"});
    expect_refused(run_abut({"clash", box_, "--out", box_ + "/out"}), {"box.obj"});
    expect_refused(run_abut({"clash", box_, "--out", "/proc/abut/out"}), {"/proc/abut/out"});
    expect_refused(run_abut({"scene", "plant", "--out", box_ + "/plant.glb"}), {"box.obj"});
    EXPECT_EQ(folder_.list(), before);

    std::filesystem::create_directories(folder_ / "out/report.csv");
    expect_refused(run_abut({"clash", box_, "--out", folder_ / "out"}), {"report.csv"});
    EXPECT_EQ(folder_.list(), (std::vector<std::string>{"box.obj", "out", "out/report.csv"}));
}

TEST_F(BadInputTest, AFileNameCannotForgeASecondLine) {
    expect_refused(run_abut({"info", folder_ / "two\nlines.obj"}), {"two\\nlines.obj"});
}

} // namespace
} // namespace abut::test
