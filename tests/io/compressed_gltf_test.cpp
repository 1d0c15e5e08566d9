// Geometry compressed by Draco and by meshoptimizer against the same geometry uncompressed, and
// damaged streams.

#include "tests/io/gltf_builder.h"
#include "tests/io/support.h"
#include "tests/io/ways.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

namespace abut::test {
namespace {

using nlohmann::json;

/// A wavy sheet of triangles that share vertices.
struct Sheet {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::uint32_t> corners;
};

Sheet sheet(Random& random, int width, int height) {
    Sheet result;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result.positions.push_back({static_cast<float>(x), static_cast<float>(y),
                                        static_cast<float>(random.uniform(-1, 1))});
    for (int y = 0; y + 1 < height; ++y)
        for (int x = 0; x + 1 < width; ++x) {
            const auto a = static_cast<std::uint32_t>(y * width + x);
            const auto b = a + static_cast<std::uint32_t>(width);
            for (const std::uint32_t corner : {a, a + 1, b, b, a + 1, b + 1})
                result.corners.push_back(corner);
        }
    return result;
}

using Triangles = std::vector<std::array<std::array<double, 3>, 3>>;

/// Sorts triangles, and rotates each so that its smallest corner is first.
Triangles sorted(Triangles triangles) {
    for (auto& triangle : triangles)
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                    triangle.end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

Triangles triangles_of(const Scene& scene) {
    Triangles result;
    for (const auto& triangle : world_triangles(scene)) {
        auto& to = result.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            to.at(k) = {triangle.at(k).x, triangle.at(k).y, triangle.at(k).z};
    }
    return sorted(result);
}

template <typename Positions>
Triangles triangles_of(const Positions& positions, const std::vector<std::uint32_t>& corners) {
    Triangles result(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            result[i / 3].at(i % 3).at(k) = positions.at(corners[i]).at(k);
    return sorted(result);
}

struct DracoStream {
    std::string bytes;
    std::uint32_t attribute = 0;
};

/// bits: quantisation; 0 keeps the floats.
DracoStream draco_of(const Sheet& sheet, int method, int bits) {
    draco::Mesh mesh;
    mesh.set_num_points(static_cast<std::uint32_t>(sheet.positions.size()));
    mesh.SetNumFaces(sheet.corners.size() / 3);
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
        mesh.SetFace(draco::FaceIndex(i),
                     {draco::PointIndex(sheet.corners[std::size_t{3} * i]),
                      draco::PointIndex(sheet.corners[std::size_t{3} * i + 1]),
                      draco::PointIndex(sheet.corners[std::size_t{3} * i + 2])});
    draco::GeometryAttribute attribute;
    attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
    const int number = mesh.AddAttribute(attribute, true, mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i)
        mesh.attribute(number)->SetAttributeValue(draco::AttributeValueIndex(i),
                                                  sheet.positions[i].data());
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    if (bits > 0)
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {std::string(buffer.data(), buffer.size()), mesh.attribute(number)->unique_id()};
}

/// A GLB file of one part whose accessors have data only from Draco.
GltfBuilder draco_file(const Sheet& sheet, const DracoStream& stream) {
    GltfBuilder builder;
    builder.require("KHR_draco_mesh_compression");
    const std::size_t view = builder.view(stream.bytes);
    builder.append(
        "accessors",
        {{"componentType", kFloat}, {"count", sheet.positions.size()}, {"type", "VEC3"}});
    builder.append(
        "accessors",
        {{"componentType", kUnsignedShort}, {"count", sheet.corners.size()}, {"type", "SCALAR"}});
    const std::size_t mesh = builder.mesh(
        {{"attributes", {{"POSITION", 0}}},
         {"indices", 1},
         {"extensions",
          {{"KHR_draco_mesh_compression",
            {{"bufferView", view}, {"attributes", {{"POSITION", stream.attribute}}}}}}}});
    builder.node({{"name", "sheet"}, {"mesh", mesh}});
    return builder;
}

std::string meshopt_attributes(const void* elements, std::size_t count, std::size_t size) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, size), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                            bytes.size(), elements, count, size));
    return bytes;
}

std::string meshopt_triangles(const Sheet& sheet) {
    std::string bytes(meshopt_encodeIndexBufferBound(sheet.corners.size(), sheet.positions.size()),
                      '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                           bytes.size(), sheet.corners.data(),
                                           sheet.corners.size()));
    return bytes;
}

std::string meshopt_indices(const Sheet& sheet) {
    std::string bytes(
        meshopt_encodeIndexSequenceBound(sheet.corners.size(), sheet.positions.size()), '\0');
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()),
                                             bytes.size(), sheet.corners.data(),
                                             sheet.corners.size()));
    return bytes;
}

/// A buffer view with only compressed content, which lies in a buffer without bytes.
std::size_t compressed_view(GltfBuilder& builder, const std::string& bytes, const char* mode,
                            std::size_t count, std::size_t stride, const char* filter = nullptr,
                            const char* extension = "EXT_meshopt_compression") {
    if (builder.document["buffers"].size() == 1)
        builder.append("buffers", {{"byteLength", 1 << 30},
                                   {"extensions", {{extension, {{"fallback", true}}}}}});
    json compression = builder.place(bytes);
    compression["mode"] = mode;
    compression["count"] = count;
    compression["byteStride"] = stride;
    if (filter != nullptr)
        compression["filter"] = filter;
    json view{
        {"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{extension, compression}}}};
    if (std::string(mode) == "ATTRIBUTES")
        view["byteStride"] = stride;
    return builder.append("bufferViews", view);
}

void add_part(GltfBuilder& builder, std::size_t positions, std::size_t indices) {
    builder.node({{"name", "sheet"},
                  {"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}},
                                         {"indices", indices}})}});
}

class CompressedGltf : public testing::Test {
protected:
    /// The scene, which is the same read whole and streamed.
    Scene read(const GltfBuilder& builder) {
        return read_both_ways(folder_.file("model.glb", builder.file()), folder_.path(""));
    }
    /// Reads damaged copies. Each must give an error, or triangles with finite coordinates.
    void damage(const GltfBuilder& whole, std::size_t from, std::size_t bytes, Random& random) {
        std::size_t read = 0, refused = 0;
        for (int round = 0; round < many(60); ++round) {
            GltfBuilder builder = whole;
            for (int i = random.integer(1, 3); i > 0; --i)
                builder.binary[from + static_cast<std::size_t>(
                                          random.integer(0, static_cast<int>(bytes) - 1))] =
                    static_cast<char>(random.integer(0, 255));
            const std::string path = folder_.file("damaged.glb", builder.file());
            ReadOptions options;
            options.memory_limit = std::uint64_t{1} << 30;
            try {
                for (const auto& triangle : world_triangles(read_scene(path, options)))
                    for (const Vec3& p : triangle)
                        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
                ++read;
            } catch (const Error& error) {
                EXPECT_EQ(error.file(), path) << error.what();
                ++refused;
            }
        }
        EXPECT_GT(refused, 0U);
        EXPECT_GT(read + refused, 0U);
    }
    TemporaryFolder folder_;
};

TEST_F(CompressedGltf, DracoKeepsFloatsAsTheyAre) {
    Random random(1);
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const Sheet plain = sheet(random, 40, 30);
        const Scene scene = read(draco_file(plain, draco_of(plain, method, 0)));
        ASSERT_EQ(scene.parts.size(), 1U);
        EXPECT_EQ(scene.parts[0].id, "sheet");
        EXPECT_EQ(triangles_of(scene), triangles_of(plain.positions, plain.corners)) << method;
    }
}

TEST_F(CompressedGltf, DracoQuantisesWithinItsStep) {
    Random random(2);
    const Sheet plain = sheet(random, 25, 20);
    // Sequential encoding keeps the order of triangles and corners, so that they can be compared.
    const Scene scene =
        read(draco_file(plain, draco_of(plain, draco::MESH_SEQUENTIAL_ENCODING, 11)));
    const auto triangles = world_triangles(scene);
    ASSERT_EQ(triangles.size(), plain.corners.size() / 3);
    const double step = 24.0 / ((1 << 11) - 1);
    double largest = 0;
    for (std::size_t i = 0; i < plain.corners.size(); ++i) {
        const Vec3& p = triangles[i / 3].at(i % 3);
        const auto& [x, y, z] = plain.positions[plain.corners[i]];
        largest = std::max({largest, std::abs(p.x - x), std::abs(p.y - y), std::abs(p.z - z)});
    }
    EXPECT_LE(largest, 0.51 * step);
    EXPECT_GT(largest, 0); // the positions were quantised
}

TEST_F(CompressedGltf, ThePlainFormIsPreferredToDraco) {
    Random random(3);
    const Sheet plain = sheet(random, 8, 8);
    GltfBuilder builder = draco_file(plain, draco_of(plain, draco::MESH_EDGEBREAKER_ENCODING, 6));
    builder.document.erase("extensionsRequired");
    builder.document["accessors"] = json::array();
    const std::size_t positions =
        builder.accessor(plain.positions, kFloat, plain.positions.size(), "VEC3");
    const std::size_t corners =
        builder.accessor(plain.corners, kUnsignedInt, plain.corners.size(), "SCALAR");
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = positions;
    primitive["indices"] = corners;
    const Environment none("ABUT_READER", folder_.path("no-such-program"));
    EXPECT_EQ(triangles_of(read_scene(folder_.file("model.glb", builder.file()))),
              triangles_of(plain.positions, plain.corners));
}

TEST_F(CompressedGltf, DracoThatContradictsItsAccessors) {
    Random random(4);
    const Sheet plain = sheet(random, 8, 8);
    const GltfBuilder whole =
        draco_file(plain, draco_of(plain, draco::MESH_EDGEBREAKER_ENCODING, 10));
    EXPECT_EQ(world_triangles(read(whole)).size(), 98U);
    const auto refuse = [&](const char* pointer, const json& value, ErrorCode code) {
        SCOPED_TRACE(pointer);
        GltfBuilder builder = whole;
        builder.document[json::json_pointer(pointer)] = value;
        error_of(folder_.file("model.glb", builder.file()), code);
    };
    const std::string draco = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/";
    refuse("/accessors/0/count", 63, ErrorCode::malformed);
    refuse("/accessors/0/count", 1 << 30, ErrorCode::malformed);
    refuse("/accessors/1/count", 3, ErrorCode::malformed);
    refuse("/accessors/0/type", "VEC2", ErrorCode::malformed);
    refuse((draco + "attributes/POSITION").c_str(), 77, ErrorCode::malformed);
    refuse((draco + "bufferView").c_str(), 5, ErrorCode::malformed);
    refuse("/bufferViews/0/byteLength", 20, ErrorCode::malformed);
    refuse("/meshes/0/primitives/0/mode", 5, ErrorCode::unsupported);
}

TEST_F(CompressedGltf, DamagedDracoIsReadOrRefused) {
    const unsigned seed = 5;
    SCOPED_TRACE(seed);
    Random random(seed);
    const Sheet plain = sheet(random, 12, 10);
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const DracoStream stream = draco_of(plain, method, 10);
        damage(draco_file(plain, stream), 0, stream.bytes.size(), random);
        for (std::size_t size = 0; size + 1 < stream.bytes.size();
             size += 1 + stream.bytes.size() / 12)
            error_of(
                folder_.file(
                    "short.glb",
                    draco_file(plain, {stream.bytes.substr(0, size), stream.attribute}).file()),
                ErrorCode::malformed);
    }
}

TEST_F(CompressedGltf, MeshoptKeepsGeometryAsItIs) {
    Random random(6);
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        for (const bool as_sequence : {false, true})
            for (const int component : {kUnsignedShort, kUnsignedInt}) {
                const Sheet plain = sheet(random, 60, 50);
                GltfBuilder builder;
                builder.require(extension);
                const std::size_t count = plain.positions.size();
                const std::size_t positions = builder.accessor(
                    compressed_view(builder, meshopt_attributes(plain.positions.data(), count, 12),
                                    "ATTRIBUTES", count, 12, nullptr, extension),
                    kFloat, count, "VEC3");
                const std::size_t corners = builder.accessor(
                    compressed_view(builder,
                                    as_sequence ? meshopt_indices(plain) : meshopt_triangles(plain),
                                    as_sequence ? "INDICES" : "TRIANGLES", plain.corners.size(),
                                    component == kUnsignedInt ? 4 : 2, nullptr, extension),
                    component, plain.corners.size(), "SCALAR");
                add_part(builder, positions, corners);
                EXPECT_EQ(triangles_of(read(builder)),
                          triangles_of(plain.positions, plain.corners));
            }
}

TEST_F(CompressedGltf, MeshoptWithQuantisedPositionsInStrides) {
    Random random(7);
    Sheet plain = sheet(random, 20, 20);
    std::vector<std::array<std::int16_t, 4>> quantised;
    std::vector<std::array<double, 3>> expected;
    for (std::size_t i = 0; i < plain.positions.size(); ++i) {
        auto& to = quantised.emplace_back();
        auto& number = expected.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            to.at(k) = static_cast<std::int16_t>(random.integer(-32768, 32767));
            number.at(k) = static_cast<float>(std::max(to.at(k) / 32767.0, -1.0));
        }
    }
    GltfBuilder builder;
    builder.require("EXT_meshopt_compression");
    builder.require("KHR_mesh_quantization");
    const std::size_t count = quantised.size();
    const std::size_t positions =
        builder.accessor(compressed_view(builder, meshopt_attributes(quantised.data(), count, 8),
                                         "ATTRIBUTES", count, 8),
                         kShort, count, "VEC3");
    builder.document["accessors"][positions]["normalized"] = true;
    const std::size_t corners =
        builder.accessor(plain.corners, kUnsignedInt, plain.corners.size(), "SCALAR");
    add_part(builder, positions, corners);
    EXPECT_EQ(triangles_of(read(builder)), triangles_of(expected, plain.corners));
}

TEST_F(CompressedGltf, MeshoptFiltersOfPositionsAndInstances) {
    Random random(8);
    const Sheet plain = sheet(random, 20, 20);
    const std::size_t count = plain.positions.size();
    constexpr std::size_t kInstances = 37;
    std::vector<std::array<float, 3>> translations;
    std::vector<std::array<float, 4>> rotations;
    for (std::size_t i = 0; i < kInstances; ++i) {
        translations.push_back({static_cast<float>(i), 2, 3});
        const auto angle = static_cast<float>(i) * 0.1F;
        rotations.push_back({0, std::sin(angle), 0, std::cos(angle)});
    }
    std::vector<std::array<std::uint32_t, 3>> exponential(count), moved(kInstances);
    // 24 bits keep every float with a small exponent exactly.
    meshopt_encodeFilterExp(exponential.data(), count, 12, 24, plain.positions[0].data());
    meshopt_encodeFilterExp(moved.data(), kInstances, 12, 24, translations[0].data());
    std::vector<std::array<std::int16_t, 4>> turned(kInstances);
    meshopt_encodeFilterQuat(turned.data(), kInstances, 8, 16, rotations[0].data());

    GltfBuilder builder;
    builder.require("EXT_meshopt_compression");
    builder.require("EXT_mesh_gpu_instancing");
    const auto add = [&](const auto& elements, std::size_t size, const char* filter, int component,
                         const char* type) {
        return builder.accessor(
            compressed_view(builder, meshopt_attributes(elements.data(), elements.size(), size),
                            "ATTRIBUTES", elements.size(), size, filter),
            component, elements.size(), type);
    };
    const std::size_t positions = add(exponential, 12, "EXPONENTIAL", kFloat, "VEC3");
    const std::size_t translation = add(moved, 12, "EXPONENTIAL", kFloat, "VEC3");
    const std::size_t rotation = add(turned, 8, "QUATERNION", kShort, "VEC4");
    builder.document["accessors"][rotation]["normalized"] = true;
    const std::size_t corners =
        builder.accessor(plain.corners, kUnsignedInt, plain.corners.size(), "SCALAR");
    const std::size_t mesh =
        builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", corners}});
    builder.node({{"name", "sheet"},
                  {"mesh", mesh},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing",
                     {{"attributes", {{"TRANSLATION", translation}, {"ROTATION", rotation}}}}}}}});
    const Scene scene = read(builder);
    ASSERT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.parts.size(), kInstances);
    Scene untransformed = scene;
    untransformed.parts.resize(1);
    untransformed.parts[0].world_from_mesh = Transform();
    const auto triangles = world_triangles(untransformed);
    ASSERT_EQ(triangles.size(), plain.corners.size() / 3);
    for (std::size_t i = 0; i < plain.corners.size(); ++i) {
        const auto& p = plain.positions[plain.corners[i]];
        const Vec3& found = triangles[i / 3].at(i % 3);
        // A vertex has one exponent, that of its largest coordinate.
        EXPECT_NEAR(found.x, p[0], 4e-6);
        EXPECT_NEAR(found.y, p[1], 4e-6);
        EXPECT_NEAR(found.z, p[2], 4e-6);
    }
    for (std::size_t i = 0; i < kInstances; ++i) {
        const Transform& world = scene.parts[i].world_from_mesh;
        EXPECT_NEAR(world.m[9], static_cast<double>(i), 4e-6);
        EXPECT_NEAR(world.m[0], std::cos(0.2 * static_cast<double>(i)), 2e-4);
        EXPECT_NEAR(world.m[6], std::sin(0.2 * static_cast<double>(i)), 2e-4);
    }
}

TEST_F(CompressedGltf, DamagedMeshoptIsReadOrRefused) {
    const unsigned seed = 9;
    SCOPED_TRACE(seed);
    Random random(seed);
    const Sheet plain = sheet(random, 12, 10);
    const std::size_t count = plain.positions.size();
    const std::string vertices = meshopt_attributes(plain.positions.data(), count, 12);
    const std::string triangles = meshopt_triangles(plain);
    const auto file = [&](const std::string& from, const std::string& indices) {
        GltfBuilder builder;
        builder.require("EXT_meshopt_compression");
        const std::size_t positions = builder.accessor(
            compressed_view(builder, from, "ATTRIBUTES", count, 12), kFloat, count, "VEC3");
        const std::size_t corners = builder.accessor(
            compressed_view(builder, indices, "TRIANGLES", plain.corners.size(), 4), kUnsignedInt,
            plain.corners.size(), "SCALAR");
        add_part(builder, positions, corners);
        return builder;
    };
    const GltfBuilder whole = file(vertices, triangles);
    EXPECT_EQ(world_triangles(read(whole)).size(), plain.corners.size() / 3);
    damage(whole, 0, vertices.size() + triangles.size(), random);
    const auto refuse = [&](const GltfBuilder& builder, const char* what) {
        SCOPED_TRACE(what);
        error_of(folder_.file("short.glb", builder.file()), ErrorCode::malformed);
    };
    for (std::size_t size = 0; size + 1 < vertices.size(); size += 1 + vertices.size() / 10)
        refuse(file(vertices.substr(0, size), triangles), "vertices");
    for (std::size_t size = 0; size + 1 < triangles.size(); size += 1 + triangles.size() / 10)
        refuse(file(vertices, triangles.substr(0, size)), "triangles");
    // A large count without the bytes for it must not take memory.
    for (const auto& [pointer, value] : std::vector<std::pair<const char*, json>>{
             {"/bufferViews/0/extensions/EXT_meshopt_compression/count", 1U << 31},
             {"/bufferViews/0/extensions/EXT_meshopt_compression/count", 1ULL << 50},
             {"/bufferViews/0/extensions/EXT_meshopt_compression/byteStride", 10},
             {"/bufferViews/0/extensions/EXT_meshopt_compression/byteStride", 0},
             {"/bufferViews/0/extensions/EXT_meshopt_compression/filter", "OCTAHEDRAL"},
             {"/bufferViews/0/extensions/EXT_meshopt_compression/byteLength", 1 << 20},
             {"/bufferViews/0/extensions/EXT_meshopt_compression/buffer", 1},
             {"/bufferViews/1/extensions/EXT_meshopt_compression/count", 7},
             {"/bufferViews/1/extensions/EXT_meshopt_compression/byteStride", 1}}) {
        GltfBuilder builder = whole;
        builder.document[json::json_pointer(pointer)] = value;
        refuse(builder, pointer);
    }
    GltfBuilder unknown = whole;
    unknown.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["mode"] = "NEW";
    error_of(folder_.file("mode.glb", unknown.file()), ErrorCode::unsupported);
}

TEST_F(CompressedGltf, VersionOneOfMeshoptsVertexCodecIsRefusedByName) {
    Random random(11);
    const Sheet plain = sheet(random, 6, 5);
    const std::size_t count = plain.positions.size();
    std::string vertices = meshopt_attributes(plain.positions.data(), count, 12);
    ASSERT_EQ(vertices[0], '\xa0');
    vertices[0] = '\xa1';
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        GltfBuilder builder;
        builder.require(extension);
        const std::size_t positions = builder.accessor(
            compressed_view(builder, vertices, "ATTRIBUTES", count, 12, nullptr, extension), kFloat,
            count, "VEC3");
        const std::size_t corners =
            builder.accessor(compressed_view(builder, meshopt_triangles(plain), "TRIANGLES",
                                             plain.corners.size(), 4, nullptr, extension),
                             kUnsignedInt, plain.corners.size(), "SCALAR");
        add_part(builder, positions, corners);
        const std::string text =
            error_of(folder_.file("new.glb", builder.file()), ErrorCode::unsupported);
        EXPECT_NE(text.find("version 1"), std::string::npos) << text;
    }
}

TEST_F(CompressedGltf, AFilterOfColoursDoesNotMatter) {
    Random random(12);
    const Sheet plain = sheet(random, 6, 5);
    const std::size_t count = plain.positions.size();
    GltfBuilder builder;
    builder.require("KHR_meshopt_compression");
    const char* const extension = "KHR_meshopt_compression";
    const std::string vertices = meshopt_attributes(plain.positions.data(), count, 12);
    const std::size_t positions = builder.accessor(
        compressed_view(builder, vertices, "ATTRIBUTES", count, 12, nullptr, extension), kFloat,
        count, "VEC3");
    const std::size_t corners =
        builder.accessor(compressed_view(builder, meshopt_triangles(plain), "TRIANGLES",
                                         plain.corners.size(), 4, nullptr, extension),
                         kUnsignedInt, plain.corners.size(), "SCALAR");
    add_part(builder, positions, corners);
    (void)compressed_view(builder, vertices, "ATTRIBUTES", count, 12, "COLOR", extension);
    EXPECT_EQ(triangles_of(read(builder)), triangles_of(plain.positions, plain.corners));
}

TEST_F(CompressedGltf, AMissingDecoderIsNamed) {
    Random random(10);
    const Sheet plain = sheet(random, 4, 4);
    const GltfBuilder builder =
        draco_file(plain, draco_of(plain, draco::MESH_SEQUENTIAL_ENCODING, 0));
    const std::string path = folder_.file("model.glb", builder.file());
    {
        const Environment none("ABUT_READER", folder_.path("no-such-program"));
        error_of(path, ErrorCode::unsupported);
    }
    const Environment crash("ABUT_READER", folder_.script("crash", "kill -SEGV $$\n"));
    EXPECT_NE(error_of(path, ErrorCode::reader_failed).find("crashed"), std::string::npos);
    // A decoder that writes nothing, in place of one that crashes.
    const Environment idle("ABUT_READER", folder_.script("idle", "exit 0\n"));
    error_of(path, ErrorCode::malformed);
}

} // namespace
} // namespace abut::test
