#include "tests/io/sample_files.h"

#include "tests/io/support.h"

#include <algorithm>
#include <fmt/format.h>

namespace abut::test {

namespace {

std::string obj() {
    std::string text = "# a tetrahedron\n";
    for (const auto& [x, y, z] : kCorners)
        text += fmt::format("v {} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : kFaces)
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return text;
}

std::string off() {
    std::string text = "OFF\n4 4 0\n";
    for (const auto& [x, y, z] : kCorners)
        text += fmt::format("{} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : kFaces)
        text += fmt::format("3 {} {} {}\n", a, b, c);
    return text;
}

std::string text_stl() {
    std::string text = "solid tetrahedron\n";
    for (const auto& face : kFaces) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const auto corner : face)
            text += fmt::format("  vertex {} {} {}\n", kCorners[corner][0], kCorners[corner][1],
                                kCorners[corner][2]);
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid tetrahedron\n";
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    append(bytes, static_cast<std::uint32_t>(kFaces.size()));
    for (const auto& face : kFaces) {
        append(bytes, std::array<float, 3>{});
        for (const auto corner : face)
            append(bytes, kCorners[corner]);
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string ply_header(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string text_ply() {
    std::string text = ply_header("ascii");
    for (const auto& [x, y, z] : kCorners)
        text += fmt::format("{} {} {}\n", x, y, z);
    for (const auto& [a, b, c] : kFaces)
        text += fmt::format("3 {} {} {}\n", a, b, c);
    return text;
}

std::string binary_ply(bool big_endian) {
    std::string bytes = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian");
    const auto append_word = [&](const auto& value) {
        std::string word;
        append(word, value);
        if (big_endian)
            std::reverse(word.begin(), word.end());
        bytes += word;
    };
    for (const auto& corner : kCorners)
        for (const float value : corner)
            append_word(value);
    for (const auto& face : kFaces) {
        bytes += '\3';
        for (const std::uint32_t index : face)
            append_word(index);
    }
    return bytes;
}

std::string base64(const std::string& bytes) {
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size();
         i += 3) { // the tetrahedron's 96 bytes need no padding
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | static_cast<unsigned char>(bytes.at(i + k));
        for (int k = 3; k >= 0; --k)
            text += digits[word >> (6 * k) & 63];
    }
    return text;
}

nlohmann::json one_node() {
    return tetrahedron_document({{{"name", "tetrahedron"}, {"mesh", 0}}}, {0});
}

std::string gltf() {
    nlohmann::json document = one_node();
    document["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + base64(tetrahedron_bytes());
    return document.dump(1);
}

std::string dae() {
    std::string positions;
    for (const auto& [x, y, z] : kCorners)
        positions += fmt::format("{} {} {} ", x, y, z);
    std::string indices;
    for (const auto& [a, b, c] : kFaces)
        indices += fmt::format("{} {} {} ", a, b, c);
    return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="meter"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="12">)" +
           positions + R"(</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
           indices + R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="tetrahedron"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

/// ASCII FBX 7.4 with one mesh; a negative index ends a polygon.
std::string fbx(const std::string& vertices, std::size_t numbers, const std::string& indices,
                std::size_t corners, int centimetres) {
    return fmt::format(R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {{
    FBXHeaderVersion: 1003
    FBXVersion: 7400
}}
GlobalSettings:  {{
    Version: 1000
    Properties70:  {{
        P: "UpAxis", "int", "Integer", "",1
        P: "UpAxisSign", "int", "Integer", "",1
        P: "FrontAxis", "int", "Integer", "",2
        P: "FrontAxisSign", "int", "Integer", "",1
        P: "CoordAxis", "int", "Integer", "",0
        P: "CoordAxisSign", "int", "Integer", "",1
        P: "UnitScaleFactor", "double", "Number", "",{}
    }}
}}
Definitions:  {{
    Version: 100
    Count: 2
}}
Objects:  {{
    Geometry: 1001, "Geometry::shape", "Mesh" {{
        Vertices: *{} {{
            a: {}
        }}
        PolygonVertexIndex: *{} {{
            a: {}
        }}
        GeometryVersion: 124
    }}
    Model: 1002, "Model::tetrahedron", "Mesh" {{
        Version: 232
    }}
}}
Connections:  {{
    C: "OO",1002,0
    C: "OO",1001,1002
}}
)",
                       centimetres, numbers, vertices, corners, indices);
}

std::string tetrahedron_fbx() {
    std::string vertices;
    for (const auto& [x, y, z] : kCorners)
        vertices += fmt::format("{},{},{},", x, y, z);
    vertices.pop_back();
    std::string indices;
    for (const auto& [a, b, c] : kFaces)
        indices += fmt::format("{},{},{},", a, b, -1 - static_cast<int>(c));
    indices.pop_back();
    return fbx(vertices, 12, indices, 12, 100);
}

} // namespace

std::string cube_fbx() {
    return fbx("0,0,0,1,0,0,1,1,0,0,1,0,0,0,1,1,0,1,1,1,1,0,1,1", 24,
               "0,3,2,-2,4,5,6,-8,0,1,5,-5,2,3,7,-7,0,4,7,-4,1,2,6,-6", 24, 100);
}

std::map<std::string, std::string> sample_files() {
    return {{"sample.obj", obj()},
            {"sample.off", off()},
            {"text.stl", text_stl()},
            {"binary.stl", binary_stl()},
            {"text.ply", text_ply()},
            {"little.ply", binary_ply(false)},
            {"big.ply", binary_ply(true)},
            {"sample.glb", glb(one_node(), tetrahedron_bytes())},
            {"sample.gltf", gltf()},
            {"sample.dae", dae()},
            {"sample.fbx", tetrahedron_fbx()}};
}

} // namespace abut::test
