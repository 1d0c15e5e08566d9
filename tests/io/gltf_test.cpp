// Nodes of glTF: transforms in double precision, names and instances. read_scene gives back what
// write_glb wrote.

#include "tests/io/support.h"

#include <limits>

namespace abut::test {
namespace {

using nlohmann::json;

class Gltf : public testing::Test {
protected:
    Scene read(const json& nodes, const json& roots) {
        return read_scene(folder_.file(
            "model.glb", glb(tetrahedron_document(nodes, roots), tetrahedron_bytes())));
    }
    TemporaryFolder folder_;
};

TEST_F(Gltf, MatricesKeepAllTheirDigits) {
    // A building in survey coordinates; as floats these would be off by a quarter of a metre.
    const Scene scene = read({{{"name", "a"},
                               {"mesh", 0},
                               {"matrix",
                                {0.1, 0.2, 0.3, 0, -0.4, 0.5, 0.6, 0, 0.7, -0.8, 0.9, 0,
                                 3512345.6789012, 5412345.0123456, -0.123456789012345, 1}}}},
                             {0});
    EXPECT_EQ(scene.parts[0].world_from_mesh,
              Transform({0.1, 0.2, 0.3, -0.4, 0.5, 0.6, 0.7, -0.8, 0.9, 3512345.6789012,
                         5412345.0123456, -0.123456789012345}));
}

TEST_F(Gltf, TransformsAreComposedDownTheTree) {
    // A quarter turn about z takes x to y. The rotation is written in floats, so its length is not
    // exactly one.
    const double half = 0.70710676908493042;
    const Scene scene = read({{{"children", {1, 2}}, {"translation", {1e7, 0, 0.1}}},
                              {{"name", "leaf"}, {"mesh", 0}, {"translation", {0.125, 0, 0}}},
                              {{"children", {3}}, {"rotation", {0, 0, half, half}}},
                              {{"mesh", 0}, {"translation", {2, 0, 0}}, {"scale", {3, 4, 5}}}},
                             {0});
    ASSERT_EQ(scene.parts.size(), 2U);
    EXPECT_EQ(scene.parts[0].id, "leaf");
    EXPECT_EQ(scene.parts[0].world_from_mesh,
              Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, 1e7 + 0.125, 0, 0.1}));
    EXPECT_EQ(scene.parts[1].id, "node 3");
    const std::array<double, 12> turned{0, 3, 0, -4, 0, 0, 0, 0, 5, 1e7, 2, 0.1};
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_NEAR(scene.parts[1].world_from_mesh.m.at(i), turned.at(i), 2e-15) << i;
}

TEST_F(Gltf, IdsAreUniqueAndExtrasGiveNameAndType) {
    const Scene scene = read(
        {{{"name", "wall"}, {"mesh", 0}},
         {{"name", "wall#2"}, {"mesh", 0}},
         {{"name", "wall"}, {"mesh", 0}},
         {{"mesh", 0}},
         {{"name", "wall"}, {"mesh", 0}, {"extras", {{"name", "Wänd \"1\""}, {"type", "IfcWall"}}}},
         {{"name", "odd"}, {"mesh", 0}, {"extras", {{"name", 7}}}},
         {{"name", "empty"}}},
        {0, 1, 2, 3, 4, 5, 6});
    std::vector<std::array<std::string, 3>> found;
    for (const Part& part : scene.parts)
        found.push_back({part.id, part.name, part.type});
    const std::vector<std::array<std::string, 3>> expected{{"wall", "wall", ""},
                                                           {"wall#2", "wall#2", ""},
                                                           {"wall#3", "wall#3", ""},
                                                           {"node 3", "node 3", ""},
                                                           {"wall#4", "Wänd \"1\"", "IfcWall"},
                                                           {"odd", "odd", ""}};
    EXPECT_EQ(found, expected);
    EXPECT_EQ(scene.meshes.size(), 1U); // all parts are instances of it
}

TEST_F(Gltf, PrimitivesOfAMeshAreOneMeshAndLinesAreSkipped) {
    json document =
        tetrahedron_document({{{"name", "a"}, {"mesh", 0}}, {{"name", "b"}, {"mesh", 1}}}, {0, 1});
    const json surface = document["meshes"][0]["primitives"][0];
    json lines = surface;
    lines["mode"] = 1;
    json strip = surface;
    strip["mode"] = 5;
    document["meshes"] = {{{"primitives", {surface, lines, strip, surface}}},
                          {{"primitives", json::array({lines})}}};
    const Scene scene = read_scene(folder_.file("m.glb", glb(document, tetrahedron_bytes())));
    ASSERT_EQ(scene.parts.size(), 1U);
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].positions.size(), 4U); // joined across the primitives
    ASSERT_EQ(scene.meshes[0].triangles.size(), 4U + 10U + 4U);
    EXPECT_EQ(scene.meshes[0].triangles[14], kFaces[0]);
}

TEST_F(Gltf, AnUnusedMeshAndAnotherSceneAreLeftOut) {
    json document =
        tetrahedron_document({{{"name", "a"}, {"mesh", 1}}, {{"name", "b"}, {"mesh", 0}}}, {0});
    document["meshes"].push_back(document["meshes"][0]);
    document["scenes"].push_back({{"nodes", {1}}});
    EXPECT_EQ(read_scene(folder_.file("m.glb", glb(document, tetrahedron_bytes()))).parts[0].id,
              "a");
    document["scene"] = 1;
    const Scene scene = read_scene(folder_.file("m.glb", glb(document, tetrahedron_bytes())));
    ASSERT_EQ(scene.parts.size(), 1U);
    EXPECT_EQ(scene.parts[0].id, "b");
}

Scene sample_scene() {
    Scene scene;
    for (const float size : {1.0F, 0.1F}) {
        Mesh& mesh = scene.meshes.emplace_back();
        for (const auto& [x, y, z] : kCorners)
            mesh.positions.push_back({x * size, y * size, z * size});
        mesh.triangles.assign(kFaces.begin(), kFaces.end());
    }
    scene.meshes[1].triangles.push_back({0, 0, 0});
    scene.parts = {
        {"one", "First \"part\" \\ é", "IfcWall", 0, Transform()},
        {"two", "two", "", 1, Transform()},
        {"three", "three", "", 0,
         Transform({1. / 3, 0, 0.1, 0, 1e-300, 0, -2. / 7, 0, 1, 5412345.0123456, 1e-17, -0.1})}};
    return scene;
}

TEST_F(Gltf, WritingAndReadingGivesTheSameScene) {
    const Scene scene = sample_scene();
    const std::string path = folder_.path("written.glb");
    write_glb(scene, path);
    const Scene back = read_scene(path);
    ASSERT_EQ(back.meshes.size(), scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        EXPECT_EQ(back.meshes[i].positions, scene.meshes[i].positions);
        EXPECT_EQ(back.meshes[i].triangles, scene.meshes[i].triangles);
    }
    ASSERT_EQ(back.parts.size(), scene.parts.size());
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        EXPECT_EQ(back.parts[i].id, scene.parts[i].id);
        EXPECT_EQ(back.parts[i].name, scene.parts[i].name);
        EXPECT_EQ(back.parts[i].type, scene.parts[i].type);
        EXPECT_EQ(back.parts[i].mesh, scene.parts[i].mesh);
        EXPECT_EQ(back.parts[i].world_from_mesh, scene.parts[i].world_from_mesh);
    }
    const std::string first = read_bytes(path);
    write_glb(back, path);
    EXPECT_EQ(read_bytes(path), first);
}

TEST_F(Gltf, AFolderThatCannotBeWrittenIsNamed) {
    const std::string path = folder_.path("no/such/folder.glb");
    try {
        write_glb(sample_scene(), path);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cannot_write);
        EXPECT_EQ(error.file(), path);
    }
}

} // namespace
} // namespace abut::test
