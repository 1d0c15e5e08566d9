// Sources of numbers in glTF: instances, quantised and sparse accessors, strips, data: URIs, and
// files beside the model.

#include "tests/io/gltf_builder.h"
#include "tests/io/support.h"
#include "tests/io/ways.h"
#include "tests/support/random.h"

#include <cmath>
#include <limits>

namespace abut::test {
namespace {

using nlohmann::json;

class GltfGeometry : public testing::Test {
protected:
    Scene read(const GltfBuilder& builder) {
        return read_both_ways(folder_.file("model.glb", builder.file()), folder_.path(""));
    }
    std::string refuse(const GltfBuilder& builder, ErrorCode code) {
        return error_of(folder_.file("model.glb", builder.file()), code);
    }
    TemporaryFolder folder_;
};

/// Adds the tetrahedron and returns its mesh's index.
std::size_t add_tetrahedron(GltfBuilder& builder) {
    const std::vector<std::array<float, 3>> corners(kCorners.begin(), kCorners.end());
    const std::vector<std::array<std::uint32_t, 3>> faces(kFaces.begin(), kFaces.end());
    const std::size_t positions = builder.accessor(corners, kFloat, 4, "VEC3");
    const std::size_t indices = builder.accessor(faces, kUnsignedInt, 12, "SCALAR");
    return builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
}

json instanced(const json& attributes) {
    return {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}};
}

TEST_F(GltfGeometry, EachInstanceIsAPartOfTheSameMesh) {
    GltfBuilder builder;
    builder.require("EXT_mesh_gpu_instancing");
    const std::size_t mesh = add_tetrahedron(builder);
    const std::size_t translation = builder.accessor(
        std::vector<std::array<float, 3>>{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, kFloat, 3, "VEC3");
    const float half = std::sqrt(0.5F);
    const std::size_t rotation = builder.accessor(
        std::vector<std::array<float, 4>>{{0, 0, 0, 1}, {0, 0, half, half}, {0, 0, 0, 1}}, kFloat,
        3, "VEC4");
    const std::size_t scale = builder.accessor(
        std::vector<std::array<float, 3>>{{1, 1, 1}, {1, 1, 1}, {2, 3, 4}}, kFloat, 3, "VEC3");
    builder.append("nodes", {{"name", "child"}, {"mesh", mesh}});
    builder.node(
        {{"name", "bolt"},
         {"mesh", mesh},
         {"children", {0}},
         {"translation", {100, 0, 0}},
         {"extras", {{"name", "M12"}, {"type", "IfcFastener"}}},
         {"extensions",
          instanced({{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}})}});
    builder.node({{"name", "bolt#2"}, {"mesh", mesh}});
    const Scene scene = read(builder);
    EXPECT_EQ(scene.meshes.size(), 1U);
    std::vector<std::array<std::string, 3>> found;
    for (const Part& part : scene.parts)
        found.push_back({part.id, part.name, part.type});
    const std::vector<std::array<std::string, 3>> expected{{"bolt", "M12", "IfcFastener"},
                                                           {"bolt#3", "M12", "IfcFastener"},
                                                           {"bolt#4", "M12", "IfcFastener"},
                                                           {"child", "child", ""},
                                                           {"bolt#2", "bolt#2", ""}};
    ASSERT_EQ(found, expected);
    EXPECT_EQ(scene.parts[0].world_from_mesh, Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, 101, 0, 0}));
    EXPECT_EQ(scene.parts[2].world_from_mesh, Transform({2, 0, 0, 0, 3, 0, 0, 0, 4, 100, 0, 3}));
    // The child appears once, at its parent's place: instances do not apply to children.
    EXPECT_EQ(scene.parts[3].world_from_mesh, Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, 100, 0, 0}));
    const std::array<double, 12> turned{0, 1, 0, -1, 0, 0, 0, 0, 1, 100, 2, 0};
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_NEAR(scene.parts[1].world_from_mesh.m.at(i), turned.at(i), 2e-15) << i;
}

TEST_F(GltfGeometry, InstancesRotateByNormalisedIntegers) {
    for (const int component : {kByte, kShort}) {
        GltfBuilder builder;
        const std::size_t mesh = add_tetrahedron(builder);
        // 0.6, 0, 0, 0.8 as integers; the length is not exactly one.
        const std::size_t rotation =
            component == kByte
                ? builder.accessor(std::vector<std::array<std::int8_t, 4>>{{76, 0, 0, 102}}, kByte,
                                   1, "VEC4")
                : builder.accessor(std::vector<std::array<std::int16_t, 4>>{{19660, 0, 0, 26214}},
                                   kShort, 1, "VEC4");
        builder.document["accessors"][rotation]["normalized"] = true;
        builder.node({{"mesh", mesh}, {"extensions", instanced({{"ROTATION", rotation}})}});
        const Scene scene = read(builder);
        ASSERT_EQ(scene.parts.size(), 1U);
        const double x = component == kByte ? 76 : 19660, w = component == kByte ? 102 : 26214;
        const double cosine = (w * w - x * x) / (w * w + x * x);
        EXPECT_NEAR(scene.parts[0].world_from_mesh.m[4], cosine, 1e-15);
        EXPECT_NEAR(scene.parts[0].world_from_mesh.m[7], -2 * x * w / (w * w + x * x), 1e-15);
    }
}

TEST_F(GltfGeometry, InstancesThatContradictThemselves) {
    const auto file = [](const json& attributes) {
        GltfBuilder builder;
        const std::size_t mesh = add_tetrahedron(builder);
        builder.accessor(std::vector<std::array<float, 3>>{{1, 0, 0}, {0, 2, 0}}, kFloat, 2,
                         "VEC3");                                                             // 2
        builder.accessor(std::vector<std::array<float, 3>>{{1, 1, 1}}, kFloat, 1, "VEC3");    // 3
        builder.accessor(std::vector<std::array<float, 4>>{{0, 0, 0, 0}}, kFloat, 1, "VEC4"); // 4
        builder.node({{"mesh", mesh}, {"extensions", instanced(attributes)}});
        return builder;
    };
    EXPECT_EQ(read(file({{"TRANSLATION", 2}})).parts.size(), 2U);
    refuse(file({{"TRANSLATION", 2}, {"SCALE", 3}}), ErrorCode::malformed);
    refuse(file({{"TRANSLATION", 4}}), ErrorCode::malformed);
    refuse(file({{"ROTATION", 4}}), ErrorCode::malformed); // of zero length
    refuse(file({{"ROTATION", 3}}), ErrorCode::malformed);
    refuse(file({{"TRANSLATION", 9}}), ErrorCode::malformed);
    refuse(file({{"TRANSLATION", "all"}}), ErrorCode::malformed);
    refuse(file(json::object()), ErrorCode::malformed);
}

template <typename Component>
void expect_quantised(GltfBuilder builder, int component, bool is_normalized,
                      const TemporaryFolder& folder) {
    using Limits = std::numeric_limits<Component>;
    const std::vector<std::array<Component, 4>> stored{
        {Limits::min(), 3, 5, 0}, {Limits::max(), 1, 2, 0}, {0, Limits::max(), 7, 0}};
    const std::size_t positions = builder.accessor(stored, component, 3, "VEC3", sizeof stored[0]);
    builder.document["accessors"][positions]["normalized"] = is_normalized;
    builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}}})}});
    const Scene scene =
        read_both_ways(folder.file("quantised.glb", builder.file()), folder.path(""));
    ASSERT_EQ(scene.meshes.size(), 1U);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = scene.meshes[0].positions.at(i);
        const std::array<double, 3> found{p.x, p.y, p.z};
        for (std::size_t k = 0; k < 3; ++k) {
            const double number = stored[i].at(k);
            const double expected =
                is_normalized ? std::max(number / static_cast<double>(Limits::max()), -1.0)
                              : number;
            EXPECT_EQ(found.at(k), static_cast<double>(static_cast<float>(expected)))
                << component << ' ' << i << ' ' << k;
        }
    }
}

TEST_F(GltfGeometry, QuantisedPositionsOfEveryType) {
    for (const bool is_normalized : {false, true}) {
        GltfBuilder builder;
        builder.require("KHR_mesh_quantization");
        expect_quantised<std::int8_t>(builder, kByte, is_normalized, folder_);
        expect_quantised<std::uint8_t>(builder, kUnsignedByte, is_normalized, folder_);
        expect_quantised<std::int16_t>(builder, kShort, is_normalized, folder_);
        expect_quantised<std::uint16_t>(builder, kUnsignedShort, is_normalized, folder_);
    }
}

TEST_F(GltfGeometry, TheStepOfQuantisedPositionsIsTheirPrecision) {
    for (const bool is_normalized : {false, true}) {
        GltfBuilder builder;
        builder.require("KHR_mesh_quantization");
        const std::vector<std::array<std::int16_t, 4>> corners{
            {0, 0, 0, 0}, {32767, 0, 0, 0}, {0, 32767, 0, 0}, {0, 0, 32767, 0}};
        const std::size_t positions = builder.accessor(corners, kShort, 4, "VEC3", 8);
        builder.document["accessors"][positions]["normalized"] = is_normalized;
        const std::size_t indices =
            builder.accessor(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3},
                             kUnsignedShort, 12, "SCALAR");
        const std::size_t mesh =
            builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        const double scale = is_normalized ? 30 : 0.001;
        builder.node({{"mesh", mesh}, {"scale", {scale, 0.5 * scale, scale}}});
        const ModelPrecision precision = read(builder).precision;
        EXPECT_DOUBLE_EQ(precision.stated, is_normalized ? 30 / 32767.0 : 0.001);
        EXPECT_TRUE(precision.single_meshes);
    }
}

/// A fan of triangles in a plane, with more corners than readers take at once.
std::vector<std::array<float, 3>> many_positions(std::size_t count) {
    std::vector<std::array<float, 3>> positions;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = i / 200;
        positions.push_back({static_cast<float>(i % 200), static_cast<float>(row),
                             static_cast<float>(i * i % 101)});
    }
    return positions;
}

TEST_F(GltfGeometry, SparseAccessors) {
    Random random(1);
    for (const bool has_base : {true, false})
        for (const int component : {kUnsignedShort, kUnsignedInt}) {
            constexpr std::size_t kCount = 60'000;
            std::vector<std::array<float, 3>> expected = many_positions(kCount);
            GltfBuilder builder;
            if (!has_base)
                std::fill(expected.begin(), expected.end(), std::array<float, 3>{});
            const json base{{"componentType", kFloat}, {"count", kCount}, {"type", "VEC3"}};
            const std::size_t positions = has_base
                                              ? builder.accessor(expected, kFloat, kCount, "VEC3")
                                              : builder.append("accessors", base);
            std::string indices;
            std::vector<std::array<float, 3>> values;
            std::size_t changed = 0;
            for (std::size_t i = 0; i < kCount; ++i) {
                if (!random.chance(i % 20'000 < 10'000 ? 0.4 : 0.001))
                    continue;
                expected[i] = {static_cast<float>(i), -1, static_cast<float>(random.uniform(0, 9))};
                values.push_back(expected[i]);
                if (component == kUnsignedShort)
                    append(indices, static_cast<std::uint16_t>(i));
                else
                    append(indices, static_cast<std::uint32_t>(i));
                ++changed;
            }
            std::string bytes;
            for (const auto& value : values)
                append(bytes, value);
            const std::size_t index_view = builder.view(indices);
            const std::size_t value_view = builder.view(bytes);
            builder.document["accessors"][positions]["sparse"] = {
                {"count", changed},
                {"indices", {{"bufferView", index_view}, {"componentType", component}}},
                {"values", {{"bufferView", value_view}}}};
            builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}}})}});
            const auto triangles = world_triangles(read(builder));
            ASSERT_EQ(triangles.size(), kCount / 3);
            for (std::size_t i = 0; i < kCount; ++i) {
                const Vec3& p = triangles[i / 3].at(i % 3);
                ASSERT_EQ(p, (Vec3{expected[i][0], expected[i][1], expected[i][2]})) << i;
            }
        }
}

TEST_F(GltfGeometry, SparseAccessorsThatContradictThemselves) {
    const auto file = [](const std::vector<std::uint16_t>& indices,
                         const json& change = json::object()) {
        GltfBuilder builder;
        const std::size_t mesh = add_tetrahedron(builder);
        std::string bytes;
        for (const std::uint16_t index : indices)
            append(bytes, index);
        const std::size_t view = builder.view(bytes);
        json sparse{{"count", indices.size()},
                    {"indices", {{"bufferView", view}, {"componentType", kUnsignedShort}}},
                    {"values", {{"bufferView", 0}}}};
        sparse.merge_patch(change);
        builder.document["accessors"][0]["sparse"] = sparse;
        builder.node({{"mesh", mesh}});
        return builder;
    };
    EXPECT_EQ(world_triangles(read(file({1, 3}))).size(), 4U);
    refuse(file({3, 1}), ErrorCode::malformed);
    refuse(file({1, 1}), ErrorCode::malformed);
    refuse(file({1, 4}), ErrorCode::malformed); // beyond the end of the accessor
    refuse(file({0, 1, 2, 3, 4}), ErrorCode::malformed);
    refuse(file({1, 3}, {{"count", 1000}}), ErrorCode::malformed);
    refuse(file({1, 3}, {{"indices", {{"componentType", kFloat}}}}), ErrorCode::malformed);
    refuse(file({1, 3}, {{"values", {{"bufferView", 12}}}}), ErrorCode::malformed);
    refuse(file({1, 3}, {{"values", nullptr}}), ErrorCode::malformed);
}

TEST_F(GltfGeometry, StripsAndFansOfManyTriangles) {
    constexpr std::size_t kCount = 40'000;
    const auto stored = many_positions(kCount);
    for (const bool is_indexed : {false, true})
        for (const int mode : {5, 6}) {
            GltfBuilder builder;
            json primitive{
                {"attributes", {{"POSITION", builder.accessor(stored, kFloat, kCount, "VEC3")}}},
                {"mode", mode}};
            std::vector<std::uint32_t> corners(kCount);
            for (std::size_t i = 0; i < kCount; ++i)
                corners[i] = static_cast<std::uint32_t>(is_indexed ? kCount - 1 - i : i);
            if (is_indexed)
                primitive["indices"] = builder.accessor(corners, kUnsignedInt, kCount, "SCALAR");
            builder.node({{"mesh", builder.mesh(primitive)}});
            const auto triangles = world_triangles(read(builder));
            ASSERT_EQ(triangles.size(), kCount - 2);
            const auto at = [&](std::size_t i) {
                const auto& p = stored[corners[i]];
                return Vec3{p[0], p[1], p[2]};
            };
            for (std::size_t i = 0; i < triangles.size(); ++i) {
                const std::array<Vec3, 3> expected =
                    mode == 6    ? std::array{at(0), at(i + 1), at(i + 2)}
                    : i % 2 == 0 ? std::array{at(i), at(i + 1), at(i + 2)}
                                 : std::array{at(i + 1), at(i), at(i + 2)};
                ASSERT_EQ(triangles[i], expected) << mode << ' ' << i;
            }
        }
}

TEST_F(GltfGeometry, RequiredExtensions) {
    const auto file = [](const char* extension) {
        GltfBuilder builder;
        builder.node({{"mesh", add_tetrahedron(builder)}});
        builder.require(extension);
        return builder;
    };
    for (const char* const extension :
         {"KHR_materials_unlit", "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp",
          "KHR_lights_punctual", "EXT_lights_image_based", "KHR_mesh_quantization",
          "EXT_mesh_features", "CESIUM_primitive_outline"})
        EXPECT_EQ(read(file(extension)).parts.size(), 1U) << extension;
    for (const char* const extension : {"KHR_gaussian_splatting", "CESIUM_RTC", "ACME_nurbs"})
        EXPECT_NE(refuse(file(extension), ErrorCode::unsupported).find(extension),
                  std::string::npos);
}

/// A text file of the tetrahedron with its buffer at a URI.
std::string text_file(const json& uri) {
    json document = tetrahedron_document({{{"name", "n"}, {"mesh", 0}}}, {0});
    document["buffers"][0]["uri"] = uri;
    return document.dump();
}

class GltfFiles : public GltfGeometry {
protected:
    void expect_read(const std::string& uri, const ReadOptions& options = {}) {
        const std::string path = folder_.file("model.gltf", text_file(uri));
        try {
            EXPECT_EQ(world_triangles(read_scene(path, options)).size(), 4U) << uri;
        } catch (const Error& error) {
            ADD_FAILURE() << uri << ": " << error.what();
        }
    }
    std::string expect_refused(const json& uri, ErrorCode code) {
        return error_of(folder_.file("model.gltf", text_file(uri)), code);
    }
};

TEST_F(GltfFiles, PercentEncodedNamesAreDecoded) {
    std::filesystem::create_directory(folder_.path("a b"));
    (void)folder_.file("a b/größe 100%.bin", tetrahedron_bytes());
    expect_read("a%20b/gr%C3%B6%c3%9fe%20100%25.bin");
    expect_read("./a b/größe 100%25.bin");
    const std::string path =
        folder_.file("model.gltf", text_file("a%20b/gr%C3%B6%C3%9Fe%20100%25.bin"));
    EXPECT_EQ(read_both_ways(path, folder_.path("")).parts.size(), 1U);
    expect_refused("a%2", ErrorCode::malformed);
    expect_refused("a%zz.bin", ErrorCode::malformed);
    expect_refused("a%00.bin", ErrorCode::malformed);
    expect_refused(7, ErrorCode::malformed);
}

TEST_F(GltfFiles, DataUris) {
    const std::string zeros = "data:application/gltf-buffer;base64,";
    // 96 bytes of zeros make all triangles degenerate.
    EXPECT_NE(expect_refused(zeros + std::string(128, 'A'), ErrorCode::bad_mesh).find("degenerate"),
              std::string::npos);
    expect_refused(zeros + std::string(124, 'A'), ErrorCode::malformed);
    expect_refused(zeros + std::string(127, 'A') + "!", ErrorCode::malformed);
    expect_refused(zeros + std::string(129, 'A'), ErrorCode::malformed);
    expect_refused("data:application/octet-stream,abc", ErrorCode::unsupported);
    expect_refused("data:application/octet-stream;base64", ErrorCode::malformed);
}

TEST_F(GltfFiles, OnlyFilesOfItsOwnFolderAreOpened) {
    const TemporaryFolder elsewhere;
    const std::string outside = elsewhere.file("data.bin", tetrahedron_bytes());
    const std::string name = std::filesystem::path(elsewhere.path("")).parent_path().filename();
    std::filesystem::create_directory(folder_.path("sub"));
    (void)folder_.file("sub/data.bin", tetrahedron_bytes());
    expect_read("sub/data.bin");
    expect_read("sub/../sub/data.bin");
    expect_read(folder_.path("sub/data.bin")); // absolute, but inside
    // A link to a folder inside the model's folder counts as inside.
    std::filesystem::create_directory_symlink("sub", folder_.path("inner"));
    expect_read("inner/data.bin");
    std::filesystem::create_directory_symlink(elsewhere.path(""), folder_.path("link"));
    std::filesystem::create_symlink(outside, folder_.path("link.bin"));
    ReadOptions allowed;
    allowed.allow_outside_files = true;
    for (const std::string& uri :
         {outside, "../" + name + "/data.bin", "sub/../../" + name + "/data.bin",
          "%2e%2e/" + name + "/data.bin", std::string("link/data.bin"), std::string("link.bin")}) {
        const std::string text = expect_refused(uri, ErrorCode::unsupported);
        EXPECT_NE(text.find("outside"), std::string::npos) << text;
        expect_read(uri, allowed);
    }
    // The message does not reveal whether the file exists.
    EXPECT_NE(expect_refused("../no-such-file.bin", ErrorCode::unsupported).find("outside"),
              std::string::npos);
    for (const char* const uri :
         {"https://example.org/data.bin", "file:///etc/passwd", "C:\\data.bin"})
        expect_refused(uri, ErrorCode::unsupported);
    expect_refused("missing.bin", ErrorCode::malformed);
    expect_refused("sub", ErrorCode::malformed);
    // The model itself may be opened through a link.
    (void)folder_.file("model.gltf", text_file("sub/data.bin"));
    std::filesystem::create_symlink(folder_.path("model.gltf"), elsewhere.path("linked.gltf"));
    error_of(elsewhere.path("linked.gltf"), ErrorCode::malformed); // sub is not beside the link
}

TEST_F(GltfFiles, SeveralBuffersAndExtraChunks) {
    // Positions are in a file, indices in the GLB's binary chunk, and a chunk of unknown type
    // follows.
    json document = tetrahedron_document({{{"name", "n"}, {"mesh", 0}}}, {0});
    const std::string bytes = tetrahedron_bytes();
    (void)folder_.file("positions.bin", bytes.substr(0, 48) + "more than is needed");
    document["buffers"] = {{{"byteLength", 48}}, {{"byteLength", 48}, {"uri", "positions.bin"}}};
    document["bufferViews"] = {{{"buffer", 1}, {"byteLength", 48}},
                               {{"buffer", 0}, {"byteLength", 48}}};
    std::string file = glb(document, bytes.substr(48));
    append(file, std::uint32_t{4});
    file += "MORE1234";
    const auto length = static_cast<std::uint32_t>(file.size());
    std::memcpy(file.data() + 8, &length, sizeof length);
    const Scene scene = read_both_ways(folder_.file("model.glb", file), folder_.path(""));
    EXPECT_EQ(world_triangles(scene).size(), 4U);
}

} // namespace
} // namespace abut::test
