// Streaming readers give the scene of read_scene, bit for bit. Files that they do not support are
// read whole.

#include "io/scene/scene_source.h"
#include "store/import/mesh_draft.h"
#include "tests/io/sample_files.h"
#include "tests/io/support.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/stores.h"

#include <fmt/format.h>

namespace abut::test {
namespace {

using nlohmann::json;

enum class Way { streamed, whole };

Scene scene_of(const SceneSource& source) {
    Scene scene;
    for (std::uint32_t i = 0; i < source.meshes(); ++i)
        scene.meshes.push_back(load_mesh(source, i).mesh);
    for (std::uint64_t i = 0; i < source.parts().size(); ++i)
        scene.parts.push_back(source.parts().part(i));
    return scene;
}

class Stream : public testing::Test {
protected:
    void expect_same(const std::string& path, Way way, double unit = 0) {
        SCOPED_TRACE(path);
        SourceOptions options; // not one temporary: GCC 12 would warn that a part is uninitialised
        options.read.unit = unit;
        options.folder = folder_.path("");
        options.memory = std::uint64_t{1} << 20;
        const auto source = open_scene_source({path}, options);
        EXPECT_EQ(source->streams(), way == Way::streamed);
        const Scene expected = read_scene(path, {.unit = unit});
        const Scene scene = scene_of(*source);
        EXPECT_EQ(scene.meshes.size(), expected.meshes.size());
        expect_same_scene(expected, scene);
        for (std::size_t i = 0; i < scene.parts.size(); ++i)
            EXPECT_EQ(scene.parts[i].mesh, expected.parts[i].mesh);
    }
    void expect_glb(const json& document, const std::string& binary, Way way) {
        expect_same(folder_.file("model.glb", glb(document, binary)), way);
    }
    TemporaryFolder folder_;
};

TEST_F(Stream, EveryFormatIsRead) {
    for (const auto& [name, content] : sample_files()) {
        const std::string path = folder_.file(name, content);
        const std::string extension = std::filesystem::path(path).extension();
        const bool own = extension == ".glb" || extension == ".gltf" || extension == ".obj" ||
                         extension == ".stl" ||
                         (extension == ".ply" && content.find("format binary") < 20);
        expect_same(path, own ? Way::streamed : Way::whole);
        expect_same(path, own ? Way::streamed : Way::whole, 0.001);
    }
}

TEST_F(Stream, NodesOfAGlbFile) {
    const double half = 0.70710676908493042;
    expect_glb(
        tetrahedron_document({{{"children", {1, 2}}, {"translation", {1e7, 0, 0.1}}},
                              {{"name", "leaf"}, {"mesh", 0}, {"translation", {0.125, 0, 0}}},
                              {{"children", {3}}, {"rotation", {0, 0, half, half}}},
                              {{"mesh", 0}, {"translation", {2, 0, 0}}, {"scale", {3, 4, 5}}},
                              {{"name", "not shown"}, {"mesh", 0}}},
                             {0}),
        tetrahedron_bytes(), Way::streamed);
    expect_glb(tetrahedron_document(
                   {{{"name", "wall"}, {"mesh", 0}},
                    {{"name", "wall#2"}, {"mesh", 0}},
                    {{"name", "wall"}, {"mesh", 0}},
                    {{"mesh", 0}},
                    {{"name", "wall"},
                     {"mesh", 0},
                     {"matrix", {-1, -0.0, 0, 0, 0, 1, -0.0, 0, 0, 0, 1, 0, -0.0, 0, 0, 1}},
                     {"extras", {{"name", "Wänd \"1\""}, {"type", "IfcWall"}, {"more", {1, 2}}}}},
                    {{"name", "wall"}, {"mesh", 0}}},
                   {5, 4, 3, 2, 1, 0}),
               tetrahedron_bytes(), Way::streamed);
}

TEST_F(Stream, ContentsOfAGlbFile) {
    const json plain = tetrahedron_document({{{"name", "a"}, {"mesh", 0}}}, {0});
    const auto change = [&](const auto& how) {
        json document = plain;
        how(document);
        return document;
    };
    const auto expect = [&](Way way, const auto& how) {
        expect_glb(change(how), tetrahedron_bytes(), way);
    };
    // Without indices, four vertices are no list of triangles, so the count is 3.
    expect(Way::streamed, [](json& d) {
        d["accessors"][0]["count"] = 3;
        d["meshes"][0]["primitives"][0].erase("indices");
    });
    expect(Way::streamed, [](json& d) { // the same triangles twice
        d["meshes"][0]["primitives"].push_back(d["meshes"][0]["primitives"][0]);
    });
    expect(Way::streamed, [](json& d) { // the second mesh is used first
        d["meshes"].push_back(d["meshes"][0]);
        d["accessors"].push_back(d["accessors"][1]);
        d["accessors"][2]["count"] = 6;
        d["meshes"][1]["primitives"][0]["indices"] = 2;
        d["nodes"].push_back({{"name", "b"}, {"mesh", 1}});
        d["scenes"][0]["nodes"] = {1, 0};
    });
    expect(Way::streamed, [](json& d) { d["bufferViews"][0]["byteStride"] = 12; });
    expect(Way::streamed, [](json& d) { d["materials"] = {{{"name", "red"}}}; });
    expect(Way::streamed, [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 5; });
    expect(Way::streamed, [](json& d) { d.erase("scene"); });
    expect(Way::streamed, [](json& d) { d["nodes"][0]["name"] = "<" + std::string(2000, 'n'); });
    expect(Way::streamed, [](json& d) { // the skin is read in its rest pose
        d["skins"] = {{{"joints", {0}}}};
        d["nodes"][0]["skin"] = 0;
    });
}

TEST_F(Stream, ShortIndicesAndStrides) {
    for (const int component : {5121, 5123}) {
        std::string binary;
        for (const auto& corner : kCorners) {
            append(binary, corner);
            append(binary, std::array<float, 2>{7, 7}); // other data between the positions
        }
        for (const auto& face : kFaces)
            for (const std::uint32_t index : face)
                if (component == 5121)
                    append(binary, static_cast<std::uint8_t>(index));
                else
                    append(binary, static_cast<std::uint16_t>(index));
        json document = tetrahedron_document({{{"name", "a"}, {"mesh", 0}}}, {0});
        document["accessors"][1]["componentType"] = component;
        document["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 80}, {"byteStride", 20}};
        document["bufferViews"][1] = {
            {"buffer", 0}, {"byteOffset", 80}, {"byteLength", component == 5121 ? 12 : 24}};
        document["buffers"][0]["byteLength"] = component == 5121 ? 92 : 104;
        expect_glb(document, binary, Way::streamed);
    }
}

/// Files that read_scene refuses are refused with the same code.
TEST_F(Stream, RefusesWhatReadSceneRefuses) {
    const json plain = tetrahedron_document({{{"name", "a"}, {"mesh", 0}}}, {0});
    std::size_t refused = 0;
    const auto expect_refused = [&](const std::string& name, const std::string& content) {
        SCOPED_TRACE(name);
        const std::string path = folder_.file(name, content);
        ErrorCode code{};
        try {
            (void)read_scene(path);
            ADD_FAILURE() << "read_scene takes it";
        } catch (const Error& error) {
            code = error.code();
        }
        const std::string store = folder_.path("store.abut");
        (void)error_of(path, code, [&] { import_models({path}, store); });
        EXPECT_FALSE(std::filesystem::exists(store)) << "a store of nothing is left";
        ++refused;
    };
    const std::string whole = glb(plain, tetrahedron_bytes());
    expect_refused("short.glb", whole.substr(0, whole.size() - 40));
    std::string bytes = tetrahedron_bytes();
    bytes[48] = 9; // an index
    expect_refused("index.glb", glb(plain, bytes));
    bytes = tetrahedron_bytes();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(bytes.data(), &nan, sizeof nan);
    expect_refused("nan.glb", glb(plain, bytes));
    bytes = tetrahedron_bytes();
    std::fill_n(bytes.begin(), 48, '\0');
    expect_refused("flat.glb", glb(plain, bytes));
    json cycle = plain;
    cycle["nodes"][0]["children"] = {0};
    expect_refused("cycle.glb", glb(cycle, tetrahedron_bytes()));
    json unknown = plain;
    unknown["extensionsRequired"] = {"ACME_nurbs"};
    expect_refused("unknown.glb", glb(unknown, tetrahedron_bytes()));
    json far = plain;
    far["nodes"][0]["scale"] = {1e300, 1, 1};
    expect_refused("far.glb", glb(far, tetrahedron_bytes()));
    const auto samples = sample_files();
    for (const auto& [name, content] : samples)
        if (name.ends_with(".stl") || name.ends_with(".obj") || name.ends_with(".ply"))
            expect_refused("short-" + name, content.substr(0, content.size() - 30));
    expect_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    expect_refused("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    EXPECT_GT(refused, 10U);
}

std::string some_number(Random& random) {
    switch (random.integer(0, 7)) {
    case 0:
        return fmt::format("{}", random.integer(-1000, 1000));
    case 1:
        return fmt::format("{:e}", random.uniform(-1e6, 1e6));
    case 2:
        return fmt::format("{:.20f}", random.uniform(-10, 10));
    case 3:
        return fmt::format("{:+.3f}", random.uniform(-10, 10));
    case 4:
        return fmt::format("{}E{}", random.integer(-99, 99), random.integer(-5, 5));
    case 5:
        return fmt::format("{}.", random.integer(0, 9));
    case 6:
        return random.chance(0.5) ? "-0" : "-0.0";
    default:
        return fmt::format("{}", random.uniform(-100, 100));
    }
}

TEST_F(Stream, ObjFilesOfAllKinds) {
    Random random(1);
    std::size_t polygons = 0;
    for (int round = 0; round < many(40); ++round) {
        std::string text = random.chance(0.5) ? "# comment\nmtllib none.mtl\n" : "";
        if (random.chance(0.5))
            text += random.chance(0.5) ? "o thing\n" : "g group-1\n";
        int vertices = 0;
        const bool triangles_only = random.chance(0.4);
        for (int block = random.integer(1, 3); block > 0; --block) {
            for (int i = random.integer(5, 12); i > 0; --i, ++vertices)
                text += fmt::format("v {} {} {}{}", some_number(random), some_number(random),
                                    some_number(random), random.chance(0.2) ? " \r\n" : "\n");
            text += "vn 0 0 1\nvt 0 0\ns off\n";
            for (int i = random.integer(1, 8); i > 0; --i) {
                text += "f";
                const int corners = triangles_only ? 3 : random.integer(3, 6);
                polygons += corners > 3 ? 1 : 0;
                for (int k = 0; k < corners; ++k) {
                    const int index = random.integer(1, vertices);
                    const int written = random.chance(0.3) ? index - vertices - 1 : index;
                    text += fmt::format(" {}{}", written, random.chance(0.3) ? "//1" : "");
                }
                text += "\n";
            }
        }
        text += "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\n"; // one that has an area
        if (random.chance(0.5))
            text.pop_back(); // without the last line end
        expect_same(folder_.file("model.obj", text), Way::streamed);
        if (HasFailure()) {
            std::cout << text;
            return;
        }
    }
    EXPECT_GT(polygons, 20U);
}

TEST_F(Stream, ObjFilesThatAreReadWhole) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const std::string& more :
         {std::string("o second\nf 3 2 1\n"), std::string("g second\nf 3 2 1\n"),
          std::string("f 1 2 4\nv 0 0 1\n")})
        expect_same(folder_.file("model.obj", triangle + more), Way::whole);
    for (const std::string& more :
         {std::string("usemtl red\nf 3 2 1\n"), std::string("v 0 0 0 2\nf 1 2 4\n"),
          std::string("l 1 2\n"), std::string("f 1 2 \\\n3\n"), std::string("o empty\n")})
        expect_same(folder_.file("model.obj", triangle + more), Way::streamed);
}

TEST_F(Stream, TextStlFiles) {
    Random random(2);
    for (int round = 0; round < many(20); ++round) {
        std::string text = random.chance(0.5) ? "solid part_7 made by hand\n" : "solid\n";
        for (int i = random.integer(1, 20); i > 0; --i) {
            text += "  facet normal 0 0 1\n    outer loop\n";
            for (int k = 0; k < 3; ++k)
                text += fmt::format("      vertex {} {} {}\n", some_number(random),
                                    some_number(random), some_number(random));
            text += "    endloop\n  endfacet\n";
        }
        text += "endsolid part_7\n";
        expect_same(folder_.file("model.stl", text), Way::streamed);
        if (HasFailure()) {
            std::cout << text;
            return;
        }
    }
    const std::string solid = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                              "0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    expect_same(folder_.file("two.stl", solid + solid), Way::whole);
}

TEST_F(Stream, BinaryStlFiles) {
    Random random(3);
    for (int round = 0; round < many(10); ++round) {
        std::string bytes = random.chance(0.3) ? "solid but binary" : "COLOR=abcd";
        bytes.resize(80, '\0');
        const int triangles = random.integer(1, 10000);
        append(bytes, static_cast<std::uint32_t>(triangles));
        for (int i = 0; i < triangles; ++i) {
            append(bytes, std::array<float, 3>{});
            for (int k = 0; k < 9; ++k)
                append(bytes,
                       random.chance(0.1) ? -0.0F : static_cast<float>(random.integer(-20, 20)));
            append(bytes, static_cast<std::uint16_t>(random.integer(0, 65535)));
        }
        expect_same(folder_.file("model.stl", bytes), Way::streamed);
    }
}

template <typename Value>
void append_as(std::string& bytes, Value value, bool big_endian) {
    std::string word;
    append(word, value);
    if (big_endian)
        std::reverse(word.begin(), word.end());
    bytes += word;
}

TEST_F(Stream, BinaryPlyFiles) {
    Random random(4);
    std::size_t polygons = 0;
    for (int round = 0; round < many(30); ++round) {
        const bool big = random.chance(0.3), wide = random.chance(0.4);
        const int vertices = random.integer(4, 60), faces = random.integer(1, 80);
        std::string bytes = fmt::format(
            "ply\nformat binary_{}_endian 1.0\ncomment by hand\nelement vertex {}\n"
            "property {} x\nproperty uchar red\nproperty {} y\nproperty {} z\n"
            "element face {}\nproperty list uchar {} vertex_ind{}\nend_header\n",
            big ? "big" : "little", vertices, wide ? "double" : "float", wide ? "double" : "float",
            wide ? "float" : "float32", faces + 1, wide ? "ushort" : "int", wide ? "ex" : "ices");
        for (int i = 0; i < vertices; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                // The first three vertices form a triangle with an area.
                const double value =
                    i < 3 ? (i == axis ? 1 : 0) : random.integer(-9, 9) * random.uniform(0.9, 1);
                if (wide && axis < 2)
                    append_as(bytes, value, big);
                else
                    append_as(bytes, static_cast<float>(value), big);
                if (axis == 0)
                    bytes += static_cast<char>(random.integer(0, 255));
            }
        const bool triangles_only = random.chance(0.4);
        for (int i = 0; i <= faces; ++i) {
            const int corners = i == 0 || triangles_only ? 3 : random.integer(3, 6);
            polygons += corners > 3 ? 1 : 0;
            bytes += static_cast<char>(corners);
            for (int k = 0; k < corners; ++k) {
                const int index = i == 0 ? k : random.integer(0, vertices - 1);
                if (wide)
                    append_as(bytes, static_cast<std::uint16_t>(index), big);
                else
                    append_as(bytes, static_cast<std::int32_t>(index), big);
            }
        }
        expect_same(folder_.file("model.ply", bytes), Way::streamed);
        if (HasFailure())
            return;
    }
    EXPECT_GT(polygons, 50U);
}

} // namespace
} // namespace abut::test
