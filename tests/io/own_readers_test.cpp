// Our own readers run in the caller's process. They need no helper program, obey limits and stop
// requests, and take no more memory than the file justifies.

#include "io/scene/scene_source.h"
#include "tests/io/sample_files.h"
#include "tests/io/support.h"

#include <atomic>

namespace abut::test {
namespace {

const std::vector<std::string> kOwnFormats{"sample.obj", "sample.off", "text.stl", "binary.stl",
                                           "text.ply",   "little.ply", "big.ply",  "sample.glb"};

class OwnReaders : public testing::Test {
protected:
    /// A file of 4 * count triangles.
    std::string large_obj(int count) {
        std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (int i = 0; i < count; ++i)
            text += "f 1 2 3\nf 1 3 2\nf 2 1 3\nf 2 3 1\n";
        return folder_.file("large.obj", text);
    }
    TemporaryFolder folder_;
    std::map<std::string, std::string> samples_ = sample_files();
};

TEST_F(OwnReaders, NeedNoHelper) {
    const Environment reader("ABUT_READER", folder_.path("nothing"));
    for (const std::string& name : kOwnFormats)
        EXPECT_EQ(world_triangles(read_scene(folder_.file(name, samples_.at(name)))).size(), 4U)
            << name;
    error_of(folder_.file("a.dae", samples_.at("sample.dae")), ErrorCode::unsupported);
}

TEST_F(OwnReaders, RefuseWithoutAHelper) {
    const Environment reader("ABUT_READER", folder_.path("nothing"));
    for (const std::string& name : kOwnFormats)
        if (name != "sample.glb")
            error_of(folder_.file(name, samples_.at(name).substr(0, samples_.at(name).size() - 30)),
                     ErrorCode::malformed);
}

TEST_F(OwnReaders, MaterialLibrariesOutsideOfTheFolderAreRefused) {
    const std::string text = samples_.at("sample.obj");
    ReadOptions allowed;
    allowed.allow_outside_files = true;
    SourceOptions in_pieces;
    in_pieces.folder = folder_.path("");
    in_pieces.memory = std::uint64_t{1} << 20;
    // The second file can be streamed: one part, with its vertices before its faces.
    for (const std::string& content : {text, std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}) {
        for (const std::string library : {"a.mtl", "sub/my materials.mtl", "./a.mtl b.mtl", ""}) {
            const std::string path = folder_.file(
                "in.obj", std::string("mtllib ").append(library).append("\n") + content);
            EXPECT_FALSE(read_scene(path).parts.empty()) << library;
            EXPECT_GT(open_scene_source({path}, in_pieces)->parts().size(), 0U) << library;
        }
        for (const std::string library : {"/etc/passwd", "../a.mtl", "a.mtl sub/../../b.mtl"}) {
            const std::string path = folder_.file(
                "out.obj", std::string(content).append("mtllib ").append(library) + "\r\n");
            EXPECT_NE(error_of(path, ErrorCode::unsupported).find("outside"), std::string::npos);
            EXPECT_THROW((void)open_scene_source({path}, in_pieces), Error) << library;
            EXPECT_FALSE(read_scene(path, allowed).parts.empty()) << library;
        }
    }
}

TEST_F(OwnReaders, StopAtTheTimeLimit) {
    for (const std::string& name : kOwnFormats) {
        const std::string text = error_of(folder_.file(name, samples_.at(name)),
                                          ErrorCode::reader_failed, {.time_limit = 1e-9});
        EXPECT_NE(text.find("stopped after"), std::string::npos) << text;
    }
}

TEST_F(OwnReaders, StopOnRequestWhileTheyRead) {
    const std::string path = large_obj(100'000);
    std::atomic<bool> stop = false;
    ReadOptions options;
    options.progress.stop = &stop;
    // The stop is requested by the first report above 0.
    options.progress.report = [&](std::string_view, double fraction) { stop = fraction > 0; };
    const std::string small = folder_.file("small.obj", samples_.at("sample.obj"));
    EXPECT_THROW((void)read_scenes({path, small, path}, options), Error);
}

TEST_F(OwnReaders, TakeNoMoreMemoryThanTheyMay) {
    const std::string path = large_obj(500'000); // about 100 MB in memory
    ReadOptions options;
    options.memory_limit = std::uint64_t{50} << 20;
    const std::string text = error_of(path, ErrorCode::reader_failed, options);
    EXPECT_NE(text.find("memory (limit 50 MiB)"), std::string::npos) << text;
    options.memory_limit = std::uint64_t{1} << 30;
    EXPECT_EQ(read_scene(path, options).meshes.at(0).triangles.size(), 2'000'000U);
}

TEST_F(OwnReaders, AGlbFileThatAsksForMoreMemoryThanThereIs) {
    // One large buffer used by a hundred thousand meshes: 30 MB on disk, terabytes in memory.
    constexpr std::size_t kVertices = 1 << 20, kMeshes = 100'000;
    nlohmann::json document = tetrahedron_document(nlohmann::json::array(), {});
    document["accessors"][0]["count"] = kVertices;
    document["bufferViews"][0]["byteLength"] = 12 * kVertices;
    document["bufferViews"][1]["byteOffset"] = 12 * kVertices;
    document["buffers"][0]["byteLength"] = 12 * kVertices + 48;
    nlohmann::json mesh = document["meshes"][0];
    const nlohmann::json indices = document["accessors"][1];
    for (std::size_t i = 0; i < kMeshes; ++i) {
        // With the same accessors they would be one mesh.
        document["accessors"][1 + i] = indices;
        mesh["primitives"][0]["indices"] = 1 + i;
        document["meshes"][i] = mesh;
        document["nodes"][i] = {{"mesh", i}};
        document["scenes"][0]["nodes"][i] = i;
    }
    std::string bytes(12 * kVertices, '\0');
    append(bytes, kFaces);
    const std::string text =
        error_of(folder_.file("greedy.glb", glb(document, bytes)), ErrorCode::reader_failed);
    EXPECT_NE(text.find("memory"), std::string::npos) << text;
}

TEST_F(OwnReaders, PartsOfAnObjFile) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const Scene scene = read_scene(
        folder_.file("parts.obj", vertices + "f 1 2 3\n"           // before any name
                                             "o Pump 1\nf 1 2 4\n" // an object
                                             "g casing\nf 1 3 4\n" // a group of it
                                             "g bolts\nusemtl red\nf 2 3 4\nusemtl blue\nf 4 3 2\n"
                                             "g casing\nf 4 3 1\n"  // goes on
                                             "o Pump 1\nf 2 3 1\n"  // another object of that name
                                             "g default\nf 3 2 1\n" // its own
                                             "o nothing\ng nothing\n"));
    std::vector<std::pair<std::string, std::size_t>> found;
    for (const Part& part : scene.parts)
        found.emplace_back(part.id, scene.meshes[part.mesh].triangles.size());
    const std::vector<std::pair<std::string, std::size_t>> expected{
        {"defaultobject", 1}, {"Pump 1", 1}, {"casing", 2}, {"bolts", 2}, {"Pump 1#2", 2}};
    EXPECT_EQ(found, expected);
    // A mesh has the vertices of its own faces, in the order of first use.
    const std::vector<Vec3> casing{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(scene.meshes[2].positions, casing);
}

TEST_F(OwnReaders, SolidsOfATextStlFile) {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                              "vertex 0 1 0\nendloop\nendfacet\n";
    const Scene scene = read_scene(
        folder_.file("solids.stl", "solid left side\n" + facet + "endsolid left side\nsolid\n" +
                                       facet + facet + "endsolid\nsolid empty\nendsolid empty\n"));
    ASSERT_EQ(scene.parts.size(), 2U);
    EXPECT_EQ(scene.parts[0].id, "left side");
    EXPECT_EQ(scene.parts[1].id, "node 2");
    EXPECT_EQ(scene.meshes[scene.parts[1].mesh].triangles.size(), 2U);
}

TEST_F(OwnReaders, StripsOfAPlyFile) {
    const Mesh mesh = read_mesh(folder_.file(
        "strips.ply", "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\n"
                      "property float y\nproperty float z\nelement tristrips 1\n"
                      "property list int int vertex_indices\nend_header\n"
                      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n8 0 1 2 3 -1 3 5 4\n"));
    const std::vector<std::array<std::uint32_t, 3>> expected{{0, 1, 2}, {2, 1, 3}, {3, 5, 4}};
    EXPECT_EQ(mesh.triangles, expected);
}

TEST_F(OwnReaders, NumbersAreTheNearestFloats) {
    const Mesh mesh = read_mesh(folder_.file(
        "numbers.obj", "v 0.1 1e-50 3.4e17\nv 123456.789012345678 -0.30000001192092896 +7\n"
                       "v 1e-400 16777217 .5\nf 1 2 3\n"));
    const std::vector<Vec3> expected{
        {0.1F, 0, 3.4e17F}, {123456.789012345678F, -0.3F, 7}, {0, 16777216, 0.5}};
    EXPECT_EQ(mesh.positions, expected);
}

} // namespace
} // namespace abut::test
