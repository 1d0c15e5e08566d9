// Real buildings have their known numbers of parts, meshes and triangles. Every corner of a
// triangle is where a scan of the file's bytes finds it.

#include <abut/scene.h>

#include "tests/support/paths.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace abut::test {
namespace {

using nlohmann::json;

struct Building {
    const char* file;
    std::size_t parts, meshes, triangles; // triangles: counted once per instance
    friend std::ostream& operator<<(std::ostream& stream, const Building& building) {
        return stream << building.file;
    }
};

class Import : public testing::TestWithParam<Building> {};

template <typename Value>
Value value_at(const std::string& bytes, std::size_t offset) {
    Value value{};
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

TEST_P(Import, EqualsAScanOfTheFile) {
    const Building& building = GetParam();
    const std::string path = std::string(ABUT_SHARED_DATA) + "/bim/" + building.file;
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << path << " is not there";
    const Scene scene = read_scene(path);
    std::size_t triangles = 0;
    for (const Part& part : scene.parts)
        triangles += scene.meshes[part.mesh].triangles.size();
    EXPECT_EQ(scene.parts.size(), building.parts);
    EXPECT_EQ(scene.meshes.size(), building.meshes);
    EXPECT_EQ(triangles, building.triangles);

    std::ifstream stream(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    const std::size_t json_size = value_at<std::uint32_t>(bytes, 12);
    const json document = json::parse(bytes.substr(20, json_size));
    const std::size_t binary = 20 + json_size + 8;
    const auto start_of = [&](const json& accessor) {
        const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        return binary + view.value("byteOffset", std::size_t{0}) +
               accessor.value("byteOffset", std::size_t{0});
    };

    const json& nodes = document["nodes"];
    ASSERT_EQ(nodes.size(), scene.parts.size()); // in these files, every node is a part
    std::set<std::uint32_t> seen;
    std::size_t differences = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Part& part = scene.parts[i];
        ASSERT_EQ(part.id, nodes[i]["name"]);
        ASSERT_EQ(part.name, nodes[i]["extras"]["name"]);
        ASSERT_EQ(part.type, nodes[i]["extras"]["type"]);
        Transform transform;
        if (nodes[i].contains("matrix"))
            for (std::size_t k = 0; k < 12; ++k)
                transform.m.at(k) = nodes[i]["matrix"][k / 3 * 4 + k % 3];
        ASSERT_EQ(part.world_from_mesh, transform) << part.id;
        if (!seen.insert(part.mesh).second)
            continue;
        const Mesh& mesh = scene.meshes[part.mesh];
        std::set<std::array<double, 3>> distinct;
        std::size_t corner = 0;
        for (const json& primitive :
             document["meshes"][nodes[i]["mesh"].get<std::size_t>()]["primitives"]) {
            const json& positions =
                document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
            const json& indices = document["accessors"][primitive["indices"].get<std::size_t>()];
            ASSERT_EQ(indices["componentType"], 5125);
            const auto position = [&](std::size_t vertex) {
                const auto xyz =
                    value_at<std::array<float, 3>>(bytes, start_of(positions) + 12 * vertex);
                return Vec3{xyz[0], xyz[1], xyz[2]};
            };
            for (std::size_t k = 0; k < positions["count"].get<std::size_t>(); ++k)
                distinct.insert({position(k).x, position(k).y, position(k).z});
            for (std::size_t k = 0; k < indices["count"].get<std::size_t>(); ++k, ++corner) {
                const auto& vertex = mesh.triangles.at(corner / 3).at(corner % 3);
                const auto in_file = value_at<std::uint32_t>(bytes, start_of(indices) + 4 * k);
                differences += mesh.positions.at(vertex) == position(in_file) ? 0 : 1;
            }
        }
        ASSERT_EQ(mesh.positions.size(), distinct.size());
        ASSERT_EQ(corner, 3 * mesh.triangles.size());
    }
    EXPECT_EQ(differences, 0U);
}

INSTANTIATE_TEST_SUITE_P(Buildings, Import,
                         testing::Values(Building{"duplex_design.glb", 215, 215, 25'157},
                                         Building{"duplex_mep.glb", 926, 926, 335'822},
                                         Building{"hospital_structure.glb", 2827, 2637, 444'854},
                                         Building{"hospital_plumbing.glb", 9121, 4406, 4'312'914},
                                         Building{"hospital_sprinklers.glb", 13'490, 6452,
                                                  2'073'575}),
                         [](const auto& instance) {
                             const std::string file = instance.param.file;
                             return file.substr(0, file.find('.'));
                         });

} // namespace
} // namespace abut::test
