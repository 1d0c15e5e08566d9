// Files that must be refused, each with one line that says why.

#include "tests/io/sample_files.h"
#include "tests/io/support.h"

#include <cmath>
#include <limits>
#include <random>
#include <sys/stat.h>

namespace abut::test {
namespace {

using nlohmann::json;

class Hostile : public testing::Test {
protected:
    std::string refuse(const std::string& name, const std::string& content, ErrorCode code) {
        return error_of(folder_.file(name, content), code);
    }
    std::string refuse_glb(const json& document, ErrorCode code,
                           const std::string& bytes = tetrahedron_bytes()) {
        return refuse("hostile.glb", glb(document, bytes), code);
    }
    static std::string replaced(std::string text, const std::string& what,
                                const std::string& with) {
        text.replace(text.find(what), what.size(), with);
        return text;
    }

    TemporaryFolder folder_;
    std::map<std::string, std::string> samples_ = sample_files();
    json document_ = tetrahedron_document({{{"name", "n"}, {"mesh", 0}}}, {0});
};

TEST_F(Hostile, PathsThatCannotBeRead) {
    error_of(folder_.path("missing.glb"), ErrorCode::file_not_found);
    error_of(folder_.path("no/folder.obj"), ErrorCode::file_not_found);
    error_of("", ErrorCode::file_not_found);
    std::filesystem::create_directory(folder_.path("folder.obj"));
    EXPECT_TRUE(
        contains(error_of(folder_.path("folder.obj"), ErrorCode::unreadable), "is a folder"));
    ASSERT_EQ(mkfifo(folder_.path("pipe.ply").c_str(), 0600), 0);
    error_of(folder_.path("pipe.ply"), ErrorCode::unreadable);
    error_of(folder_.file("empty.stl", ""), ErrorCode::malformed);
    error_of(folder_.file("model.xyz", "1 2 3"), ErrorCode::unsupported);
    error_of(folder_.file("model", "1 2 3"), ErrorCode::unsupported);
}

TEST_F(Hostile, AFileWithoutPermission) {
    const std::string path = folder_.file("locked.obj", samples_.at("sample.obj"));
    ASSERT_EQ(chmod(folder_.path("").c_str(), 0755), 0);
    ASSERT_EQ(chmod(path.c_str(), 0), 0);
    const AsNobody nobody;
    const std::string text = error_of(path, ErrorCode::unreadable);
    EXPECT_NE(text.find("Permission denied"), std::string::npos) << text;
}

TEST_F(Hostile, GarbageInEveryFormat) {
    for (const auto& [name, content] : samples_) {
        // As OBJ the text has no known line, so the scene is empty.
        const ErrorCode code = name == "sample.obj" ? ErrorCode::bad_mesh : ErrorCode::malformed;
        refuse(name, std::string(300, '\x5a'), code);
        std::string noise;
        for (unsigned i = 0; i < 2000; ++i)
            noise += static_cast<char>(i * 2654435761U >> 13);
        refuse(name, noise, ErrorCode::malformed);
    }
}

TEST_F(Hostile, IndexOutOfRange) {
    refuse("a.obj", samples_.at("sample.obj") + "f 1 2 5\n", ErrorCode::bad_mesh);
    refuse("b.obj", samples_.at("sample.obj") + "f -1 -2 -5\n", ErrorCode::bad_mesh);
    refuse("c.obj", samples_.at("sample.obj") + "f 0 1 2\n", ErrorCode::bad_mesh);
    refuse("a.off", replaced(samples_.at("sample.off"), "3 0 2 1", "3 0 4 1"), ErrorCode::bad_mesh);
    refuse("b.off", replaced(samples_.at("sample.off"), "3 0 2 1", "3 0 -1 1"),
           ErrorCode::bad_mesh);
    refuse("a.ply", replaced(samples_.at("text.ply"), "3 0 2 1", "3 0 4 1"), ErrorCode::bad_mesh);
    std::string ply = samples_.at("little.ply");
    ply[ply.size() - 2] = 1; // the last index becomes 65539
    refuse("b.ply", ply, ErrorCode::bad_mesh);
    std::string bytes = tetrahedron_bytes();
    bytes[48 + 4] = 4;
    EXPECT_TRUE(contains(refuse_glb(document_, ErrorCode::bad_mesh, bytes),
                         "part n: index 4 of a primitive"));
}

TEST_F(Hostile, NumbersThatAreNotFinite) {
    for (const char* const number : {"nan", "inf", "-inf", "1e99"}) {
        const std::string vertex = std::string(number) + " 0 0";
        refuse("a.obj", replaced(samples_.at("sample.obj"), "1.25 0 0", vertex),
               ErrorCode::bad_mesh);
        refuse("a.off", replaced(samples_.at("sample.off"), "1.25 0 0", vertex),
               ErrorCode::bad_mesh);
        refuse("a.ply", replaced(samples_.at("text.ply"), "1.25 0 0", vertex), ErrorCode::bad_mesh);
        refuse("a.stl", replaced(samples_.at("text.stl"), "1.25 0 0", vertex), ErrorCode::bad_mesh);
    }
    for (const float number : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
        std::string bytes = tetrahedron_bytes();
        std::memcpy(bytes.data() + 16, &number, sizeof number);
        EXPECT_TRUE(
            contains(refuse_glb(document_, ErrorCode::bad_mesh, bytes), "part n: vertex 1"));
    }
    document_["nodes"][0]["translation"] = {1e308, 0, 0};
    document_["nodes"][0]["scale"] = {1e300, 1, 1};
    EXPECT_TRUE(contains(refuse_glb(document_, ErrorCode::bad_mesh), "transform"));
}

TEST_F(Hostile, NothingButDegenerateTriangles) {
    refuse("line.off", "OFF\n3 2 0\n0 0 0\n0.1 0.1 0.1\n0.3 0.3 0.3\n3 0 1 2\n3 1 1 0\n",
           ErrorCode::bad_mesh);
    // An area of 1e-44 is below any tolerance, but not zero.
    const TemporaryFolder folder;
    EXPECT_EQ(
        read_scene(folder.file("thin.off", "OFF\n3 1 0\n0 0 0\n1e-22 0 0\n0 1e-22 0\n3 0 1 2\n"))
            .parts.size(),
        1U);
    // A scale of zero makes every triangle degenerate.
    document_["nodes"][0]["scale"] = {1, 0, 0};
    EXPECT_TRUE(contains(refuse_glb(document_, ErrorCode::bad_mesh), "degenerate"));
}

TEST_F(Hostile, ADegeneratePartAmongOthersIsKept) {
    document_["nodes"] = {{{"name", "flat"}, {"mesh", 0}, {"scale", {0, 0, 1}}},
                          {{"name", "whole"}, {"mesh", 0}}};
    document_["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(read_scene(folder_.file("two.glb", glb(document_, tetrahedron_bytes()))).parts.size(),
              2U);
}

TEST_F(Hostile, NoTriangles) {
    refuse("points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", ErrorCode::bad_mesh);
    refuse("points.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n0 0 0\n",
           ErrorCode::bad_mesh);
    document_["meshes"][0]["primitives"][0]["mode"] = 0; // points
    refuse_glb(document_, ErrorCode::bad_mesh);
}

TEST_F(Hostile, GltfThatContradictsItself) {
    const auto changed = [&](const char* pointer, const json& value) {
        json copy = document_;
        copy[json::json_pointer(pointer)] = value;
        return copy;
    };
    for (const auto& [pointer, value] : std::vector<std::pair<const char*, json>>{
             {"/nodes/0/mesh", 1},
             {"/nodes/0/mesh", -1},
             {"/nodes/0/mesh", "mesh"},
             {"/scenes/0/nodes/0", 7},
             {"/scene", 1},
             {"/nodes/0/children", json::array({0})}, // its own parent
             {"/meshes/0/primitives/0/indices", 9},
             {"/meshes/0/primitives/0/attributes", json::object()},
             {"/accessors/0/count", 5},
             {"/accessors/0/count", 4.5},
             {"/accessors/0/count", 1e18},
             {"/accessors/0/count", std::uint64_t{1} << 63},
             {"/accessors/0/bufferView", 3},
             {"/accessors/0/type", "VEC2"},
             {"/accessors/1/count", 11},
             {"/accessors/1/componentType", 1},
             {"/bufferViews/0/byteOffset", 90},
             {"/bufferViews/0/byteLength", std::uint64_t{0} - 1},
             {"/buffers/0/byteLength", 1000},
             {"/nodes/0/matrix", {1, 0, 0, 0}},
             {"/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
             {"/nodes/0/rotation", {0, 0, 0, 0}},
             {"/nodes/0/scale", {1, "2", 3}},
             {"/nodes", "none"},
             {"/meshes", 3},
             {"/scenes", json::array()}}) {
        SCOPED_TRACE(std::string(pointer) + " " + value.dump());
        refuse_glb(changed(pointer, value), ErrorCode::malformed);
    }
    refuse_glb(changed("/asset/version", "1.0"), ErrorCode::unsupported);
    refuse_glb(changed("/extensionsRequired", {"ACME_nurbs"}), ErrorCode::unsupported);
    refuse_glb(changed("/accessors/0/componentType", 5125), ErrorCode::unsupported);
}

TEST_F(Hostile, GltfWithABufferThatIsMissingOrShort) {
    document_["buffers"][0]["uri"] = "data.bin";
    refuse("a.gltf", document_.dump(), ErrorCode::malformed);
    (void)folder_.file("data.bin", tetrahedron_bytes().substr(0, 60));
    refuse("a.gltf", document_.dump(), ErrorCode::malformed);
    (void)folder_.file("data.bin", tetrahedron_bytes());
    EXPECT_EQ(world_triangles(read_scene(folder_.file("a.gltf", document_.dump()))).size(), 4U);
}

TEST_F(Hostile, CountsThatPromiseTooMuch) {
    refuse("a.off", replaced(samples_.at("sample.off"), "4 4 0", "4 4000000000 0"),
           ErrorCode::malformed);
    refuse("a.ply", replaced(samples_.at("little.ply"), "face 4", "face 99999999999999"),
           ErrorCode::malformed);
    refuse("b.ply", replaced(samples_.at("text.ply"), "vertex 4", "vertex -1"),
           ErrorCode::malformed);
    std::string stl = samples_.at("binary.stl");
    stl[83] = '\x7f';
    refuse("a.stl", stl, ErrorCode::malformed);
}

TEST_F(Hostile, DeepTreesAreReadOrRefusedButDoNotCrashTheCaller) {
    constexpr int kDepth = 200'000;
    json nodes = json::array();
    for (int i = 0; i < kDepth; ++i)
        nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    document_["nodes"] = nodes;
    try {
        EXPECT_EQ(
            read_scene(folder_.file("deep.glb", glb(document_, tetrahedron_bytes()))).parts.size(),
            1U);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::reader_failed) << error.what();
    }
}

TEST_F(Hostile, DamagedFilesAreReadOrRefused) {
    const unsigned seed = 20240607;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::size_t read = 0;
    std::size_t refused = 0;
    for (const auto& [name, content] : samples_) {
        for (int round = 0; round < 40; ++round) {
            std::string damaged = content;
            for (unsigned i = 0; i < 1 + random() % 4; ++i)
                damaged[random() % damaged.size()] = static_cast<char>(random());
            const std::string path = folder_.file(name, damaged);
            try {
                const Scene scene = read_scene(path);
                for (const auto& triangle : world_triangles(scene)) // at() throws for a bad index
                    for (const Vec3& p : triangle)
                        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << name;
                ++read;
            } catch (const Error& error) {
                EXPECT_EQ(error.file(), path);
                EXPECT_NE(error.code(), ErrorCode::file_not_found) << error.what();
                ++refused;
            }
        }
    }
    EXPECT_GT(read, (read + refused) / 10);
    EXPECT_GT(refused, (read + refused) / 10);
}

TEST_F(Hostile, TheFirstFaultOfSeveralFilesIsReported) {
    const std::string good = folder_.file("good.obj", samples_.at("sample.obj"));
    const std::string bad = folder_.file("bad.obj", "v 1 2\n");
    const std::string missing = folder_.path("missing.obj");
    for (const auto& [paths, code] : std::vector<std::pair<std::vector<std::string>, ErrorCode>>{
             {{good, bad, missing}, ErrorCode::malformed},
             {{good, missing, bad}, ErrorCode::file_not_found}}) {
        try {
            (void)read_scenes(paths);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
        }
    }
    const std::vector<Scene> scenes =
        read_scenes({good, folder_.file("b.off", samples_.at("sample.off")), good});
    ASSERT_EQ(scenes.size(), 3U);
    EXPECT_EQ(scenes[0].file, good);
    EXPECT_EQ(scenes[1].file, folder_.path("b.off"));
    EXPECT_EQ(scenes[2].meshes[0].positions.size(), kCorners.size());
}

} // namespace
} // namespace abut::test
