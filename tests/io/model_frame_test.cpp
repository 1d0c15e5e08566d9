// Units and axes: suffixes of a path, quarter turns, and scenes in a common frame.

#include "io/scene/model_frame.h"
#include "math/transform.h"
#include "tests/io/sample_files.h"
#include "tests/io/support.h"
#include "tests/support/random.h"

#include <array>
#include <map>

namespace abut::test {
namespace {

void expect_path(const ModelPath& path, const std::string& name, double unit,
                 std::optional<UpAxis> up) {
    EXPECT_EQ(path.path, name);
    EXPECT_EQ(path.unit, unit);
    EXPECT_EQ(path.up, up);
}

TEST(ModelPath, MayEndWithAUnitAndAxes) {
    expect_path(parse_model_path("none.stl"), "none.stl", 0, std::nullopt);
    expect_path(parse_model_path("none.stl:mm"), "none.stl", 0.001, std::nullopt);
    expect_path(parse_model_path("none.obj:mm:y-up"), "none.obj", 0.001, UpAxis::y);
    expect_path(parse_model_path("none.obj:x-up:in"), "none.obj", 0.0254, UpAxis::x);
    expect_path(parse_model_path("a:b/none.ply:0.3048:z-up"), "a:b/none.ply", 0.3048, UpAxis::z);
    for (const auto& [word, unit] : std::map<std::string, double>{{"um", 1e-6},
                                                                  {"cm", 0.01},
                                                                  {"dm", 0.1},
                                                                  {"m", 1},
                                                                  {"km", 1000},
                                                                  {"ft", 0.3048},
                                                                  {"yd", 0.9144},
                                                                  {"1e-3", 0.001}})
        expect_path(parse_model_path("none.stl:" + word), "none.stl", unit, std::nullopt);
    // A suffix that is neither a unit nor an axis is part of the name.
    for (const char* const name : {"none.stl:miles", "none.stl:0", "none.stl:-1", "none.stl:inf",
                                   "none.stl:nan", "none.stl:w-up", "none.stl:"})
        expect_path(parse_model_path(name), name, 0, std::nullopt);
    expect_path(parse_model_path("none.stl:miles:mm"), "none.stl:miles", 0.001, std::nullopt);
    expect_path(parse_model_path(":mm"), ":mm", 0, std::nullopt);
}

TEST(ModelPath, IsAnExistingFileWhateverItsName) {
    const TemporaryFolder folder;
    const std::string odd = folder.file("odd:mm", "x"), plain = folder.file("plain.stl", "x");
    expect_path(parse_model_path(odd), odd, 0, std::nullopt);
    expect_path(parse_model_path(odd + ":y-up"), odd, 0, UpAxis::y);
    expect_path(parse_model_path(plain + ":cm"), plain, 0.01, std::nullopt);
    for (const char* const end : {":miles", ":", ":mm:w-up", ":mm:cm", ":y-up:mm:z-up"})
        error_of(plain, ErrorCode::bad_argument, [&] { (void)parse_model_path(plain + end); });
}

TEST(ModelFrame, TurnsAreThoseOfColladaAndExact) {
    // The directions right, up and towards the viewer in each frame.
    const std::map<UpAxis, std::array<Vec3, 3>> directions{
        {UpAxis::x, {Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}},
        {UpAxis::y, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}},
        {UpAxis::z, {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}}}};
    Random random(20261123);
    for (const auto& [from, in_from] : directions)
        for (const auto& [to, in_to] : directions) {
            const Transform turn = turned(Transform(), from, to);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_EQ(apply(turn, in_from.at(i)), in_to.at(i));
            for (int round = 0; round < 200; ++round) {
                Transform transform;
                for (double& value : transform.m)
                    value = random.uniform(-1e7, 1e7);
                const Transform there = turned(transform, from, to);
                EXPECT_EQ(turned(there, to, from), transform);
                const Vec3 p{random.uniform(-10, 10), random.uniform(-10, 10),
                             random.uniform(-10, 10)};
                EXPECT_EQ(apply(there, p), apply(turn, apply(transform, p)));
            }
        }
}

TEST(ModelFrame, APathOverrulesTheFormatWhichOverrulesTheOptions) {
    const TemporaryFolder folder;
    ReadOptions options;
    options.unit = 0.01;
    options.up = UpAxis::x;
    for (const auto& [name, content] : sample_files()) {
        SCOPED_TRACE(name);
        const std::string path = folder.file(name, content);
        const bool has_own = name.find(".gl") != std::string::npos ||
                             name.find(".dae") != std::string::npos ||
                             name.find(".fbx") != std::string::npos;
        const Scene plain = read_scene(path, options),
                    scene = read_scene(ModelPath{path, 2, UpAxis::z}, options);
        if (!has_own) {
            EXPECT_EQ(plain.unit, 0.01);
            EXPECT_EQ(plain.up, UpAxis::x);
            EXPECT_EQ(read_scene(path).unit, 1);
            EXPECT_EQ(read_scene(path).up, UpAxis::z);
        } else if (name.find(".gl") != std::string::npos) {
            EXPECT_EQ(plain.unit, 1);
            EXPECT_EQ(plain.up, UpAxis::y);
        }
        EXPECT_EQ(scene.unit, 2);
        EXPECT_EQ(scene.up, UpAxis::z);
        const auto before = world_triangles(plain), after = world_triangles(scene);
        ASSERT_EQ(before.size(), after.size());
        EXPECT_NEAR(after[1][2].y, before[1][2].y * 2 / plain.unit, 1e-12);
    }
}

TEST(ModelFrame, ScenesComeIntoTheFrameOfTheFirst) {
    const TemporaryFolder folder;
    const std::string off = folder.file("a.off", "OFF\n3 1 0\n1 2 3\n4 5 6\n7 8 10\n3 0 1 2\n");
    const std::string gltf =
        folder.file("b.glb", glb(tetrahedron_document({{{"mesh", 0}}}, {0}), tetrahedron_bytes()));
    std::vector<Scene> scenes = read_scenes(std::vector<ModelPath>{{gltf}, {off, 0.001}});
    into_one_frame(scenes);
    EXPECT_EQ(scenes[1].up, UpAxis::y);
    EXPECT_EQ(world_triangles(scenes[1])[0][0], (Vec3{0.001, 0.001 * 3, -0.001 * 2}));
    std::vector<Scene> other = read_scenes({off, gltf});
    into_one_frame(other);
    EXPECT_EQ(other[1].up, UpAxis::z);
    EXPECT_EQ(world_triangles(other[1])[0][1], (Vec3{0, 0, 2.5})); // corner 2: (0, 2.5, 0)
    EXPECT_EQ(to_mesh(other[1]).positions.size(), 4U);
}

TEST(ModelFrame, WritingAsGlbKeepsTransforms) {
    const TemporaryFolder folder;
    for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z}) {
        Scene scene;
        scene.up = up;
        scene.meshes = {Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
        scene.parts = {
            {"a", "a", "", 0,
             Transform({0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.8, 0.9, 1.1, 123456.7, 654321.1, 0.3})}};
        write_glb(scene, folder.path("a.glb"));
        Scene back = read_scene(folder.path("a.glb"));
        EXPECT_EQ(back.up, UpAxis::y);
        turn_up(back, up);
        EXPECT_EQ(back.parts[0].world_from_mesh, scene.parts[0].world_from_mesh);
    }
}

} // namespace
} // namespace abut::test
