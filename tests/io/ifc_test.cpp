// IFC 2x3 and 4 through web-ifc. Without Node.js or web-ifc these tests are skipped.

#include "tests/io/support.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace abut::test {
namespace {

const std::string kFolder = std::string(ABUT_SOURCE_DIR) + "/tests/io/";

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<std::array<Vec3, 3>> triangles_of(const Scene& scene, const Part& part) {
    Scene alone;
    alone.meshes = scene.meshes;
    alone.parts = {part};
    return world_triangles(alone);
}

/// The volume that closed triangles enclose: a sixth of the sum of their triple products.
double volume_of(const Scene& scene, const Part& part) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles_of(scene, part))
        sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
               a.z * (b.x * c.y - b.y * c.x);
    return sum / 6;
}

/// The box around one part.
Box3 bounds_of(const Scene& scene, const Part& part) {
    Box3 box;
    for (const auto& triangle : triangles_of(scene, part))
        for (const Vec3& p : triangle) {
            box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                         std::min(box.lower.z, p.z)};
            box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                         std::max(box.upper.z, p.z)};
        }
    return box;
}

/// web-ifc holds geometry as floats around its centre: some 1e-7 of its size remain.
void expect_box(const Box3& box, const Vec3& lower, const Vec3& upper) {
    constexpr double kAccuracy = 5e-7;
    EXPECT_NEAR(box.lower.x, lower.x, kAccuracy);
    EXPECT_NEAR(box.lower.y, lower.y, kAccuracy);
    EXPECT_NEAR(box.lower.z, lower.z, kAccuracy);
    EXPECT_NEAR(box.upper.x, upper.x, kAccuracy);
    EXPECT_NEAR(box.upper.y, upper.y, kAccuracy);
    EXPECT_NEAR(box.upper.z, upper.z, kAccuracy);
}

class Ifc : public testing::Test {
protected:
    void SetUp() override {
        try {
            (void)read_scene(kFolder + "house_2x3.ifc");
        } catch (const Error& error) {
            if (error.code() == ErrorCode::unsupported)
                GTEST_SKIP() << error.what();
        }
    }
    static std::map<std::string, Part> by_id(const Scene& scene) {
        std::map<std::string, Part> parts;
        for (const Part& part : scene.parts)
            parts.emplace(part.id, part);
        return parts;
    }
    TemporaryFolder folder_;
};

TEST_F(Ifc, House2x3) {
    const Scene scene = read_scene(kFolder + "house_2x3.ifc");
    ASSERT_EQ(scene.parts.size(), 5U);
    EXPECT_EQ(scene.meshes.size(), 3U);
    const auto parts = by_id(scene);
    const Part& wall = parts.at("1WallOfTheTests0000001");
    EXPECT_EQ(wall.name, "South wall");
    EXPECT_EQ(wall.type, "IfcWallStandardCase");
    EXPECT_EQ(scene.meshes[wall.mesh].triangles.size(), 12U);
    EXPECT_EQ(scene.meshes[wall.mesh].positions.size(), 8U); // none is stored twice
    // Y is up: IFC's (x, y, z) is (x, z, -y).
    expect_box(bounds_of(scene, wall), {0, 0, -0.2}, {4, 3, 0});
    // The same shape again, and with a hole: that one must not share the mesh.
    const Part& plain = parts.at("1WallOfTheTests0000002");
    EXPECT_EQ(plain.mesh, wall.mesh);
    expect_box(bounds_of(scene, plain), {0, 0, -5.2}, {4, 3, -5});
    const Part& holed = parts.at("1WallOfTheTests0000003");
    EXPECT_NE(holed.mesh, wall.mesh);
    EXPECT_GE(scene.meshes[holed.mesh].triangles.size(), 28U);
    expect_box(bounds_of(scene, holed), {0, 0, -10.2}, {4, 3, -10});
    EXPECT_NEAR(volume_of(scene, wall), 4 * 0.2 * 3, 1e-6);
    EXPECT_NEAR(volume_of(scene, holed), 4 * 0.2 * 3 - 0.2, 1e-6);

    const Part& one = parts.at("1BlockOfTheTests000001");
    const Part& two = parts.at("1BlockOfTheTests000002");
    EXPECT_EQ(one.name, "Block one");
    EXPECT_EQ(two.name, "Block two");
    EXPECT_EQ(two.type, "IfcFurnishingElement");
    EXPECT_EQ(one.mesh, two.mesh);
    expect_box(bounds_of(scene, one), {1, 0, -2.25}, {1.5, 1, -2});
    // Turned by a quarter about its origin at (3, 2, 0.5): x to y, y to -x.
    expect_box(bounds_of(scene, two), {2.75, 0.5, -2.5}, {3, 1.5, -2});
}

TEST_F(Ifc, House4InMillimetresWithPartsOfTwoSolids) {
    const Scene scene = read_scene(kFolder + "house_4.ifc");
    ASSERT_EQ(scene.parts.size(), 3U);
    EXPECT_EQ(scene.meshes.size(), 2U);
    const auto parts = by_id(scene);
    const Part& wall = parts.at("4WallOfTheTests0000001");
    EXPECT_EQ(wall.name, "Wänd");
    EXPECT_EQ(wall.type, "IfcWall");
    expect_box(bounds_of(scene, wall), {0, 0, -0.2}, {4, 3, 0});
    const Part& one = parts.at("4TableOfTheTests000001");
    const Part& two = parts.at("4TableOfTheTests000002");
    EXPECT_EQ(one.type, "IfcFurniture");
    EXPECT_EQ(one.mesh, two.mesh);
    EXPECT_EQ(scene.meshes[one.mesh].triangles.size(), 24U);
    expect_box(bounds_of(scene, one), {0.5, 0, -2.3}, {1.5, 0.75, -1.7});
    expect_box(bounds_of(scene, two), {2.7, 1, -2.5}, {3.3, 1.75, -1.5});
}

TEST_F(Ifc, UnitComesOnTop) {
    ReadOptions options;
    options.unit = 1000;
    const Scene scene = read_scene(kFolder + "house_2x3.ifc", options);
    EXPECT_NEAR(bounds_of(scene, by_id(scene).at("1WallOfTheTests0000001")).upper.x, 4000, 1e-3);
}

TEST_F(Ifc, ATruncatedFileIsRefused) {
    const std::string content = read_bytes(kFolder + "house_4.ifc");
    const std::size_t end = content.find_last_not_of(" \n") + 1;
    for (const std::size_t size : {std::size_t{5}, std::size_t{200}, end / 2, end - 30, end - 1})
        error_of(folder_.file("cut.ifc", content.substr(0, size)), ErrorCode::malformed);
}

TEST_F(Ifc, OtherContentIsRefused) {
    error_of(folder_.file("garbage.ifc", std::string(5000, 'x')), ErrorCode::malformed);
    const std::string frame = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('";
    const std::string rest = "'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
    error_of(folder_.file("empty.ifc", frame + "IFC4" + rest), ErrorCode::bad_mesh);
    error_of(folder_.file("machine.ifc", frame + "AP203" + rest), ErrorCode::unsupported);
}

TEST_F(Ifc, ItsReaderIsIsolatedToo) {
    const std::string file = kFolder + "house_4.ifc";
    {
        const Environment node("ABUT_NODE", folder_.script("node", "kill -SEGV $$\n"));
        EXPECT_TRUE(contains(error_of(file, ErrorCode::reader_failed), "crashed"));
    }
    {
        ReadOptions options;
        options.time_limit = 0.25;
        const Environment node("ABUT_NODE", folder_.script("node", "exec sleep 1000\n"));
        EXPECT_TRUE(contains(error_of(file, ErrorCode::reader_failed, options), "stopped"));
    }
    ReadOptions options;
    options.memory_limit = std::uint64_t{20} << 20; // less than Node.js itself takes
    EXPECT_TRUE(contains(error_of(file, ErrorCode::reader_failed, options), "memory"));
}

TEST(IfcWithout, NodeOrWebIfcTheErrorSaysWhatToDo) {
    const TemporaryFolder folder;
    const std::string file = kFolder + "house_4.ifc";
    std::filesystem::create_directories(folder.path("converter/node_modules/web-ifc"));
    (void)folder.file("converter/convert.mjs", "");
    const Environment converter("ABUT_IFC_CONVERTER", folder.path("converter"));
    {
        const Environment path("PATH", folder.path("empty"));
        const Environment node("ABUT_NODE", "");
        const std::string text = error_of(file, ErrorCode::unsupported);
        EXPECT_TRUE(contains(text, "apt-get install nodejs npm")) << text;
        EXPECT_TRUE(contains(text, "npm ci")) << text;
    }
    std::filesystem::remove_all(folder.path("converter/node_modules"));
    const Environment node("ABUT_NODE", folder.script("node", "exit 0\n"));
    const std::string text = error_of(file, ErrorCode::unsupported);
    EXPECT_TRUE(contains(text, "npm ci")) << text;
    EXPECT_TRUE(contains(text, folder.path("converter"))) << text;
}

} // namespace
} // namespace abut::test
