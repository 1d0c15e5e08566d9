// Every format gives the same tetrahedron with the same positions, and no truncated file is read.

#include "tests/io/sample_files.h"
#include "tests/io/support.h"

#include <algorithm>

namespace abut::test {
namespace {

class Format : public testing::TestWithParam<std::string> {
protected:
    TemporaryFolder folder_;
    std::string content_ = sample_files().at(GetParam());
};

TEST_P(Format, GivesTheStoredPositions) {
    const Scene scene = read_scene(folder_.file(GetParam(), content_));
    ASSERT_EQ(scene.parts.size(), 1U);
    const auto triangles = world_triangles(scene);
    ASSERT_EQ(triangles.size(), kFaces.size());
    for (std::size_t i = 0; i < kFaces.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& corner = kCorners.at(kFaces[i].at(k));
            EXPECT_EQ(triangles[i].at(k), (Vec3{corner[0], corner[1], corner[2]})) << i << ' ' << k;
        }
    EXPECT_EQ(scene.meshes[0].positions.size(), kCorners.size()); // each vertex is stored once
    EXPECT_FALSE(scene.parts[0].id.empty());
    EXPECT_EQ(scene.parts[0].name, scene.parts[0].id);
    // Every reader hands on floats, and Assimp also places parts with them.
    const std::string extension = GetParam().substr(GetParam().rfind('.'));
    const bool is_assimp = extension == ".fbx" || extension == ".dae" || extension == ".3mf";
    EXPECT_EQ(scene.precision, (ModelPrecision{0, true, is_assimp}));
}

TEST_P(Format, RefusesATruncatedFile) {
    // A text file without its last line end is complete.
    std::size_t end = content_.find_last_not_of(" \n\r\t") + 1;
    if (GetParam() == "text.stl")
        end = content_.find("endsolid") + 8; // a name follows, which may be left out
    const bool is_obj = GetParam() == "sample.obj";
    std::size_t cuts = 0;
    for (std::size_t size = 1; size < end; size += 1 + end / 60) {
        // An OBJ file has no count and no end mark, so one without its last lines is valid. A fault
        // shows only if faces refer to missing vertices.
        if (is_obj && size > content_.find("\nf "))
            continue;
        ++cuts;
        const std::string path = folder_.file(GetParam(), content_.substr(0, size));
        try {
            const Scene scene = read_scene(path);
            ADD_FAILURE() << "read " << size << " of " << content_.size()
                          << " bytes: " << world_triangles(scene).size() << " triangles";
        } catch (const Error& error) {
            EXPECT_TRUE(error.code() == ErrorCode::malformed ||
                        error.code() == ErrorCode::bad_mesh ||
                        error.code() == ErrorCode::unsupported)
                << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(cuts, 20U);
}

INSTANTIATE_TEST_SUITE_P(All, Format,
                         testing::Values("sample.obj", "sample.off", "text.stl", "binary.stl",
                                         "text.ply", "little.ply", "big.ply", "sample.glb",
                                         "sample.gltf", "sample.dae", "sample.fbx"),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             name[name.find('.')] = '_';
                             return name;
                         });

TEST(Formats, PolygonsAreCutIntoAllTheirTriangles) {
    const TemporaryFolder folder;
    // An L of six corners. Newell's normal is -z, so the plane is seen from below.
    const std::string path = folder.file(
        "l.off", "OFF\n6 1 0\n0 0 0\n0 2 0\n1 2 0\n1 1 0\n2 1 0\n2 0 0\n6 0 1 2 3 4 5\n");
    double area = 0;
    for (const auto& [a, b, c] : world_triangles(read_scene(path))) {
        const double doubled = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        EXPECT_LT(doubled, 0); // all triangles turn as the polygon does, so none lies outside it
        area -= doubled / 2;
    }
    EXPECT_EQ(area, 3);
}

TEST(Formats, APolygonThatCrossesItselfLosesNothing) {
    const TemporaryFolder folder;
    const std::string bow_tie =
        folder.file("bow.off", "OFF\n4 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n4 0 1 2 3\n");
    EXPECT_EQ(world_triangles(read_scene(bow_tie)).size(), 2U);
}

TEST(Formats, ZeroAreaTrianglesAreKept) {
    const TemporaryFolder folder;
    const std::string path = folder.file(
        "flat.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 1 3\n3 0 1 2\n3 1 1 1\n3 0 1 3\n");
    EXPECT_EQ(world_triangles(read_scene(path)).size(), 4U);
}

TEST(Formats, VerticesAtEqualPositionsAreJoinedInTheirOrder) {
    const TemporaryFolder folder;
    // Two triangles and one of zero area. Vertices 4 and 6 repeat 1 and 0 (as -0), and 5 is unused.
    const Mesh mesh = read_mesh(
        folder.file("soup.off", "OFF\n7 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n1 0 0\n7 7 7\n-0 0 -0\n"
                                "3 6 1 2\n3 4 3 2\n3 0 6 4\n"));
    ASSERT_EQ(mesh.positions.size(), 5U);
    EXPECT_EQ(mesh.positions[3], (Vec3{1, 1, 0}));
    EXPECT_EQ(mesh.positions[4], (Vec3{7, 7, 7}));
    const std::vector<std::array<std::uint32_t, 3>> expected{{0, 1, 2}, {1, 3, 2}, {0, 0, 1}};
    EXPECT_EQ(mesh.triangles, expected);
}

TEST(Formats, UnitScalesTheTransformAndKeepsTheMesh) {
    const TemporaryFolder folder;
    ReadOptions options;
    options.unit = 0.001;
    const Scene scene =
        read_scene(folder.file("sample.obj", sample_files().at("sample.obj")), options);
    EXPECT_EQ(scene.parts[0].world_from_mesh,
              Transform({0.001, 0, 0, 0, 0.001, 0, 0, 0, 0.001, 0, 0, 0}));
    EXPECT_EQ(scene.meshes[0].positions[1], (Vec3{0, 2.5, 0})); // face 0 2 1
    options.unit = -1;
    EXPECT_THROW(read_scene("any.obj", options), Error);
}

/// The smallest and largest coordinates of a scene.
std::array<Vec3, 2> extent_of(const Scene& scene) {
    Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (const auto& triangle : world_triangles(scene))
        for (const Vec3& p : triangle) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    return {low, high};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
    return text;
}

TEST(Formats, FbxComesInMetresByItsUnitAndQuadsBecomeTriangles) {
    const TemporaryFolder folder;
    for (const auto& [written, metres] :
         std::vector<std::pair<std::string, double>>{{"100", 1}, {"1", 0.01}, {"2.54", 0.0254}}) {
        const Scene scene = read_scene(folder.file(
            "cube.fbx",
            replaced(cube_fbx(), "\"UnitScaleFactor\", \"double\", \"Number\", \"\",100",
                     "\"UnitScaleFactor\", \"double\", \"Number\", \"\"," + written)));
        EXPECT_EQ(world_triangles(scene).size(), 12U);
        EXPECT_EQ(scene.unit, metres);
        EXPECT_EQ(scene.up, UpAxis::y);
        EXPECT_EQ(extent_of(scene)[1], (Vec3{metres, metres, metres}));
    }
}

TEST(Formats, FbxHasItsOwnAxes) {
    const TemporaryFolder folder;
    const std::string y_up = sample_files().at("sample.fbx");
    std::string z_up = replaced(y_up, "\"UpAxis\", \"int\", \"Integer\", \"\",1",
                                "\"UpAxis\", \"int\", \"Integer\", \"\",2");
    z_up = replaced(z_up, "\"FrontAxis\", \"int\", \"Integer\", \"\",2",
                    "\"FrontAxis\", \"int\", \"Integer\", \"\",1");
    z_up = replaced(z_up, "\"FrontAxisSign\", \"int\", \"Integer\", \"\",1",
                    "\"FrontAxisSign\", \"int\", \"Integer\", \"\",-1");
    const Scene upright = read_scene(folder.file("z.fbx", z_up));
    EXPECT_EQ(upright.up, UpAxis::z);
    EXPECT_EQ(extent_of(upright)[1], (Vec3{1.25, 2.5, 0.1F})); // as in the file
    // With x up and y to the left the file is turned to y up; the corner at y = 2.5 comes to x =
    // -2.5.
    std::string x_up = replaced(y_up, "\"UpAxis\", \"int\", \"Integer\", \"\",1",
                                "\"UpAxis\", \"int\", \"Integer\", \"\",0");
    x_up = replaced(x_up, "\"CoordAxis\", \"int\", \"Integer\", \"\",0",
                    "\"CoordAxis\", \"int\", \"Integer\", \"\",1");
    x_up = replaced(x_up, "\"CoordAxisSign\", \"int\", \"Integer\", \"\",1",
                    "\"CoordAxisSign\", \"int\", \"Integer\", \"\",-1");
    const Scene turned = read_scene(folder.file("x.fbx", x_up));
    EXPECT_EQ(turned.up, UpAxis::y);
    EXPECT_EQ(extent_of(turned)[0], (Vec3{-2.5, 0, 0}));
    EXPECT_EQ(extent_of(turned)[1], (Vec3{0, 1.25, 0.1F}));
    error_of(folder.file("twice.fbx", replaced(y_up, "\"UpAxis\", \"int\", \"Integer\", \"\",1",
                                               "\"UpAxis\", \"int\", \"Integer\", \"\",2")),
             ErrorCode::malformed);
}

TEST(Formats, ColladaComesInItsOwnUnitAndAxes) {
    const TemporaryFolder folder;
    std::string text = sample_files().at("sample.dae");
    text.replace(text.find("meter=\"1\""), 9, "meter=\".5\"");
    text.replace(text.find("Y_UP"), 4, "Z_UP");
    const Scene scene = read_scene(folder.file("sample.dae", text));
    EXPECT_EQ(scene.unit, 0.5);
    EXPECT_EQ(scene.up, UpAxis::z);
    EXPECT_EQ(world_triangles(scene)[0][1], (Vec3{0, 1.25, 0})); // corner 2
    // The unit and axes of a path override those of the file.
    const Scene other = read_scene(ModelPath{scene.file, 2, UpAxis::x});
    EXPECT_EQ(other.up, UpAxis::x);
    EXPECT_EQ(world_triangles(other)[0][1], (Vec3{0, 5, 0}));
}

TEST(Formats, ColladaWithAnInvalidUnitOrAxesIsRefused) {
    const TemporaryFolder folder;
    const std::string sample = sample_files().at("sample.dae");
    for (const char* const meter : {"0", "-1", "0,01", "nan", "inf", "1e999", "mm"}) {
        const std::string text =
            replaced(sample, "meter=\"1\"", std::string("meter=\"") + meter + '"');
        EXPECT_NE(error_of(folder.file("a.dae", text), ErrorCode::malformed).find("unit"),
                  std::string::npos);
    }
    const std::string text = replaced(sample, "Y_UP", "W_UP");
    EXPECT_NE(error_of(folder.file("a.dae", text), ErrorCode::malformed).find("W_UP"),
              std::string::npos);
}

TEST(Formats, ReadMeshJoinsTheParts) {
    const TemporaryFolder folder;
    const nlohmann::json nodes = {{{"name", "a"}, {"mesh", 0}},
                                  {{"name", "b"}, {"mesh", 0}, {"translation", {0.1, 0, 1e6}}}};
    const std::string path =
        folder.file("two.glb", glb(tetrahedron_document(nodes, {0, 1}), tetrahedron_bytes()));
    const Mesh mesh = read_mesh(path);
    ASSERT_EQ(mesh.positions.size(), 8U);
    ASSERT_EQ(mesh.triangles.size(), 8U);
    EXPECT_EQ(mesh.positions[7], (Vec3{0.1, 0, double{0.1F} + 1e6}));
    EXPECT_EQ(mesh.triangles[4], (std::array<std::uint32_t, 3>{4, 6, 5}));
}

} // namespace
} // namespace abut::test
