// Colours of parts: from the materials of every format, the same whole and in pieces, and back from
// what write_glb wrote. What a material states wrongly never makes a model unreadable.

#include "io/scene/colour.h"
#include "io/scene/scene_source.h"
#include "tests/io/gltf_builder.h"
#include "tests/io/sample_files.h"
#include "tests/io/support.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/stores.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

namespace abut::test {
namespace {

using nlohmann::json;
using MaybeColour = std::optional<Colour>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string text_of(const MaybeColour& colour) {
    return colour ? to_string(*colour) : "none";
}

class PartColours : public testing::Test {
protected:
    /// The colours of all parts of a file, which are the same whole and in pieces.
    static std::vector<std::string> colours(const std::string& path, const ReadOptions& read = {}) {
        const Scene scene = read_scene(path, read);
        SourceOptions options;
        options.read = read;
        options.folder = std::filesystem::path(path).parent_path();
        options.memory = std::uint64_t{1} << 20;
        const auto source = open_scene_source({path}, options);
        EXPECT_EQ(source->parts().size(), scene.parts.size());
        std::vector<std::string> result;
        for (std::uint64_t i = 0; i < scene.parts.size(); ++i) {
            result.push_back(text_of(scene.parts[i].colour));
            EXPECT_EQ(text_of(source->parts().part(i).colour), result.back()) << i;
        }
        return result;
    }
    /// The colour of a GLB file's only part, whose mesh has this material.
    std::string of_material(const json& material) {
        json document = tetrahedron_document({{{"name", "a"}, {"mesh", 0}}}, {0});
        document["meshes"][0]["primitives"][0]["material"] = 0;
        document["materials"] = json::array({material});
        return colours(folder_.file("m.glb", glb(document, tetrahedron_bytes()))).at(0);
    }
    std::string of_obj(const std::string& library, const std::string& head = "mtllib a.mtl\n") {
        (void)folder_.file("a.mtl", library);
        return colours(folder_.file("m.obj",
                                    head + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\n" + "f 1 2 3\n"))
            .at(0);
    }
    std::string of_file(const std::string& name, const std::string& content) {
        return colours(folder_.file(name, content)).at(0);
    }
    TemporaryFolder folder_;
};

std::string with(std::string text, const std::string& what, const std::string& then) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), what + then);
}

TEST_F(PartColours, AreShownAsText) {
    EXPECT_EQ(to_string(Colour{0, 10, 255}), "#000aff");
    EXPECT_EQ(to_string(Colour{0, 10, 255, 16}), "#000aff10");
}

TEST_F(PartColours, LightIsEncodedAsDisplaysTakeIt) {
    // Values of IEC 61966-2-1.
    EXPECT_EQ(text_of(display_colour_of_linear({0, 1, 0.5, 0.5})), "#00ffbc80");
    EXPECT_EQ(text_of(display_colour_of_linear({0.0021246, 0.2158605, 0.0030353, 1})), "#07800a");
    for (int i = 0; i < 256; ++i) {
        const auto byte = static_cast<std::uint8_t>(i);
        const Colour colour{byte, static_cast<std::uint8_t>(255 - i), 7, byte};
        EXPECT_EQ(display_colour_of_linear(linear_components(colour)), MaybeColour(colour));
        const double s = i / 255.0;
        const double light = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(linear_components(colour)[0], light, 1e-15);
    }
}

TEST_F(PartColours, ValuesThatAreNoneAreClampedOrLeftOut) {
    EXPECT_EQ(text_of(display_colour({-1, 2, 1e300, kInfinity})), "#00ffff");
    EXPECT_EQ(text_of(display_colour_of_linear({-kInfinity, kInfinity, -1e-300, -5})), "#00ff0000");
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<double, 4> components{0.5, 0.5, 0.5, 0.5};
        components.at(i) = kNan;
        EXPECT_EQ(display_colour(components), std::nullopt);
        EXPECT_EQ(display_colour_of_linear(components), std::nullopt);
    }
}

TEST_F(PartColours, TheLargestShareWins) {
    Random random(1);
    std::size_t none = 0, ties = 0;
    for (int round = 0; round < many(300); ++round) {
        ColourTally tally;
        std::vector<std::pair<std::string, std::uint64_t>> shares; // in the order of their coming
        for (int i = random.integer(0, 8); i > 0; --i) {
            MaybeColour colour;
            if (random.chance(0.7))
                colour = Colour{static_cast<std::uint8_t>(random.integer(0, 1)), 0, 0,
                                static_cast<std::uint8_t>(random.integer(254, 255))};
            const auto triangles = static_cast<std::uint64_t>(random.integer(0, 3));
            tally.add(colour, triangles);
            const std::string name = text_of(colour);
            const auto known = std::find_if(shares.begin(), shares.end(),
                                            [&](const auto& share) { return share.first == name; });
            if (known == shares.end())
                shares.emplace_back(name, triangles);
            else
                known->second += triangles;
        }
        std::pair<std::string, std::uint64_t> best{"none", 0};
        for (std::size_t i = 0; i < shares.size(); ++i) {
            ties += i > 0 && shares[i].second == best.second ? 1 : 0;
            if (i == 0 || shares[i].second > best.second)
                best = shares[i];
        }
        ASSERT_EQ(text_of(tally.largest()), best.first);
        none += best.first == "none" ? 1 : 0;
    }
    EXPECT_GT(none, 20U);
    EXPECT_GT(ties, 20U);
}

TEST_F(PartColours, OfGltfMaterials) {
    const json factor{0.5, 0.25, 1, 0.5};
    const json plain{{"pbrMetallicRoughness", {{"baseColorFactor", factor}}}};
    EXPECT_EQ(of_material(plain), "#bc89ff");
    json blend = plain;
    blend["alphaMode"] = "BLEND";
    EXPECT_EQ(of_material(blend), "#bc89ff80");
    json mask = plain;
    mask["alphaMode"] = "MASK";
    EXPECT_EQ(of_material(mask), "#bc89ff");
    // glTF defines white as the default.
    EXPECT_EQ(of_material(json::object()), "#ffffff");
    EXPECT_EQ(of_material({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}), "#ffffff");
    json textured = plain;
    textured["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    EXPECT_EQ(of_material(textured), "none");
    const json diffuse{
        {"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", factor}}}}}};
    EXPECT_EQ(of_material(diffuse), "#bc89ff");
    json both = diffuse;
    both["pbrMetallicRoughness"] = {{"baseColorFactor", {0, 0, 0, 1}}};
    EXPECT_EQ(of_material(both), "#000000");
}

TEST_F(PartColours, OfGltfMaterialsThatAreWrong) {
    const auto of_factor = [&](const json& factor) {
        return of_material({{"pbrMetallicRoughness", {{"baseColorFactor", factor}}}});
    };
    EXPECT_EQ(of_factor({-1, 2, 1e300, 7}), "#00ffff");
    for (const json& factor :
         {json("red"), json(1), json(nullptr), json::array({1, 1, 1}), json::array({1, 1, 1, 1, 1}),
          json::array({1, "1", 1, 1}), json::array({1, nullptr, 1, 1}), json::object()})
        EXPECT_EQ(of_factor(factor), "none") << factor;
    EXPECT_EQ(of_material({{"pbrMetallicRoughness", 7}}), "#ffffff");
    EXPECT_EQ(of_material({{"extensions", {7}}}), "#ffffff");
    EXPECT_EQ(of_material({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", "x"}}}}),
              "#ffffff");
    EXPECT_EQ(of_material({{"alphaMode", {"BLEND"}}}), "#ffffff");
    for (const json& material : {json(7), json("red"), json::array({1}), json(nullptr)})
        EXPECT_EQ(of_material(material), "none") << material;
}

TEST_F(PartColours, GltfIndicesAndListsThatAreWrong) {
    const json red{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}};
    const auto of = [&](const json& index, const json& list) {
        json document = tetrahedron_document({{{"name", "a"}, {"mesh", 0}}}, {0});
        document["meshes"][0]["primitives"][0]["material"] = index;
        document["materials"] = list;
        return of_file("m.glb", glb(document, tetrahedron_bytes()));
    };
    EXPECT_EQ(of(0, json::array({red})), "#ff0000");
    for (const json& index : {json(1), json(-1), json("0"), json(0.5), json(nullptr),
                              json(4294967295U), json(std::uint64_t{1} << 40)})
        EXPECT_EQ(of(index, json::array({red})), "none") << index;
    // Where elements are not objects, the indices of the others are not trusted.
    EXPECT_EQ(of(0, json::array({7, red})), "none");
    EXPECT_EQ(of(1, json::array({7, red})), "none");
    EXPECT_EQ(of(0, json{{"a", red}}), "none");
    EXPECT_EQ(of(0, "red"), "none");
}

TEST_F(PartColours, TheMaterialWithTheMostTrianglesOfAMeshCounts) {
    const auto material = [](double red) {
        return json{{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}};
    };
    json document =
        tetrahedron_document({{{"name", "a"}, {"mesh", 0}}, {{"name", "b"}, {"mesh", 1}}}, {0, 1});
    document["materials"] = {material(1), material(0), material(1)};
    json surface = document["meshes"][0]["primitives"][0]; // 4 triangles
    json strip = surface, lines = surface;
    strip["mode"] = 5; // 10 triangles
    lines["mode"] = 1;
    const auto of = [&](const std::vector<std::pair<json, int>>& primitives) {
        json list = json::array();
        for (const auto& [primitive, number] : primitives) {
            list.push_back(primitive);
            if (number >= 0)
                list.back()["material"] = number;
        }
        document["meshes"] = {{{"primitives", list}}, {{"primitives", json::array({surface})}}};
        const auto found = colours(folder_.file("m.glb", glb(document, tetrahedron_bytes())));
        EXPECT_EQ(found.at(1), "none"); // without a material
        return found.at(0);
    };
    EXPECT_EQ(of({{surface, 0}, {surface, 1}}), "#ff0000"); // the first of equal shares
    EXPECT_EQ(of({{surface, 1}, {surface, 0}}), "#000000");
    EXPECT_EQ(of({{surface, 1}, {surface, 0}, {surface, 2}}), "#ff0000"); // two materials, one red
    EXPECT_EQ(of({{surface, 0}, {surface, 2}, {strip, 1}}), "#000000");
    EXPECT_EQ(of({{surface, 0}, {lines, 1}, {lines, 1}}), "#ff0000");
    EXPECT_EQ(of({{surface, 0}, {strip, -1}}), "none");
}

TEST_F(PartColours, GltfMeshesThatDifferInMaterialsAreOneMesh) {
    GltfBuilder builder;
    const std::size_t positions = builder.accessor(
        std::vector<std::array<float, 3>>(kCorners.begin(), kCorners.end()), 5126, 4, "VEC3");
    const auto indices = [&](std::size_t triangles) {
        std::vector<std::array<std::uint32_t, 3>> faces(
            kFaces.begin(), kFaces.begin() + static_cast<std::ptrdiff_t>(triangles));
        return builder.accessor(faces, 5125, 3 * triangles, "SCALAR");
    };
    const std::size_t all = indices(4), two = indices(2);
    const auto add = [&](std::size_t from, int material, int mode) {
        json primitive{{"attributes", {{"POSITION", positions}}}, {"indices", from}};
        primitive["material"] = material;
        primitive["mode"] = mode;
        builder.node({{"mesh", builder.mesh(primitive)}});
    };
    for (const int material : {0, 1, 0}) {
        add(all, material, 4);
        add(two, material, 4);
    }
    add(all, 0, 5);
    for (const double green : {0.0, 1.0})
        builder.append("materials",
                       {{"pbrMetallicRoughness", {{"baseColorFactor", {1, green, 0, 1}}}}});
    const std::string path = folder_.file("m.glb", builder.file());
    const Scene scene = read_scene(path);
    std::vector<std::uint32_t> meshes;
    for (const Part& part : scene.parts)
        meshes.push_back(part.mesh);
    EXPECT_EQ(meshes, (std::vector<std::uint32_t>{0, 1, 0, 1, 0, 1, 2}));
    EXPECT_EQ(scene.meshes[1].triangles.size(), 2U);
    EXPECT_EQ(colours(path), (std::vector<std::string>{"#ff0000", "#ff0000", "#ffff00", "#ffff00",
                                                       "#ff0000", "#ff0000", "#ff0000"}));
}

TEST_F(PartColours, WriteGlbKeepsThemAndSharedMeshes) {
    Random random(2);
    std::size_t repeated = 0, without = 0;
    for (int round = 0; round < many(30); ++round) {
        Scene scene;
        for (int i = random.integer(1, 4); i > 0; --i) {
            Mesh& mesh = scene.meshes.emplace_back();
            for (const auto& [x, y, z] : kCorners)
                mesh.positions.push_back({x * static_cast<float>(i), y, z});
            mesh.triangles.assign(kFaces.begin(), kFaces.end());
        }
        const auto byte = [&] { return static_cast<std::uint8_t>(random.integer(0, 255)); };
        std::vector<MaybeColour> palette{std::nullopt};
        for (int i = random.integer(0, 3); i > 0; --i)
            palette.emplace_back(
                Colour{byte(), byte(), byte(), random.chance(0.5) ? byte() : std::uint8_t{255}});
        std::set<std::uint32_t> used;
        std::set<std::pair<std::uint32_t, std::string>> shown;
        for (int i = 0; i < 12; ++i) {
            Part& part = scene.parts.emplace_back();
            part.id = part.name = std::to_string(i);
            part.mesh = static_cast<std::uint32_t>(
                random.integer(0, static_cast<int>(scene.meshes.size()) - 1));
            part.colour = palette.at(
                static_cast<std::size_t>(random.integer(0, static_cast<int>(palette.size()) - 1)));
            used.insert(part.mesh);
            shown.emplace(part.mesh, text_of(part.colour));
            without += part.colour ? 0 : 1;
        }
        repeated += shown.size() - used.size();
        const std::string path = folder_.path("written.glb");
        write_glb(scene, path);
        const Scene back = read_scene(path);
        expect_same_scene(scene, back);
        ASSERT_EQ(back.meshes.size(), used.size());
        const auto found = colours(path);
        for (std::size_t i = 0; i < found.size(); ++i)
            ASSERT_EQ(found[i], text_of(scene.parts[i].colour));
        write_glb(back, path);
        expect_same_scene(scene, read_scene(path));
        if (HasFatalFailure())
            return;
    }
    EXPECT_GT(repeated, 20U) << "no mesh had two colours";
    EXPECT_GT(without, 20U);
}

TEST_F(PartColours, OfObjMaterials) {
    EXPECT_EQ(of_obj("newmtl red\nKd 1 0.5 0\n"), "#ff8000");
    EXPECT_EQ(of_obj("newmtl red\r\nKd 1 0.5 0\r\nd 0.5\r\n"), "#ff800080");
    EXPECT_EQ(of_obj("newmtl red\nKd 1 0.5 0\nTr 0.25"), "#ff8000bf");
    EXPECT_EQ(of_obj("Kd 0 0 0\nnewmtl blue\nKd 0 0 1\nnewmtl red\n\tKd 1 0 0\nnewmtl x\nKd 0 0 0"),
              "#ff0000");
    EXPECT_EQ(of_obj("newmtl red\nKd 0.5\n"), "#808080");
    EXPECT_EQ(of_obj("newmtl red\nKd -1 2 1e300\n"), "#00ffff");
    EXPECT_EQ(of_obj("newmtl red\nKd 1 0 0\nmap_Kd wood.png\n"), "none");
    for (const std::string library :
         {"", "newmtl red\n", "newmtl blue\nKd 1 0 0\n", "newmtl red\nKd\n", "newmtl red\nKd a b c",
          "newmtl red\nKd nan 0 0\n", "newmtl red\nKd spectral a.rfl\n", "newmtl red\nKd 1 2\n",
          "newmtl\nKd 1 0 0\n"})
        EXPECT_EQ(of_obj(library), "none") << library;
    EXPECT_EQ(of_obj(std::string("newmtl red\nKd 1 0 0\nx\0y", 23)), "none");        // no text
    EXPECT_EQ(of_obj("newmtl red\nKd 1 0 0\n" + std::string(5 << 20, '#')), "none"); // too large
}

TEST_F(PartColours, OfObjLibrariesWhereverTheyLie) {
    const std::string red = "newmtl red\nKd 1 0 0\n";
    EXPECT_EQ(of_obj(red, "mtllib missing.mtl\n"), "none");
    EXPECT_EQ(of_obj(red, "mtllib missing.mtl a.mtl\n"), "#ff0000");
    EXPECT_EQ(of_obj(red, "# none\n"), "none");
    const std::string spaced = "with blanks.mtl";
    (void)folder_.file(spaced, red);
    EXPECT_EQ(of_obj("", "mtllib " + spaced + "\n"), "#ff0000");
    // A library outside of the folder is opened only if that is allowed.
    const TemporaryFolder other;
    const std::string outside = other.file("b.mtl", red);
    const std::string model = folder_.file(
        "m.obj", "mtllib " + outside + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
    error_of(model, ErrorCode::unsupported);
    ReadOptions allowed;
    allowed.allow_outside_files = true;
    EXPECT_EQ(colours(model, allowed).at(0), "#ff0000");
    std::filesystem::create_symlink(outside, folder_.path("link.mtl"));
    error_of(folder_.file("n.obj", "mtllib link.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
             ErrorCode::unsupported);
}

TEST_F(PartColours, OfObjPartsWithSeveralMaterials) {
    (void)folder_.file("a.mtl",
                       "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nnewmtl also\nKd 1 0 0\n");
    const std::string head = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    // A square counts as two triangles. Groups go on where they are named again.
    EXPECT_EQ(
        colours(folder_.file("m.obj", head + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3 4\n")),
        std::vector<std::string>{"#0000ff"});
    EXPECT_EQ(
        colours(folder_.file("m.obj", head + "f 1 2 3\ng a\nusemtl red\nf 1 2 3\ng b\n"
                                             "usemtl blue\nf 1 2 3 4\ng a\nf 1 2 3\n"
                                             "usemtl also\nf 2 3 4\ng c\nusemtl no\nf 1 2 4")),
        (std::vector<std::string>{"none", "#ff0000", "#0000ff", "none"}));
}

TEST_F(PartColours, OfCollada) {
    const auto dae = [](const std::string& diffuse) {
        std::string text = sample_files().at("sample.dae");
        text = with(text, "</asset>",
                    "<library_effects><effect id=\"e\"><profile_COMMON><technique sid=\"t\">"
                    "<lambert><diffuse>" +
                        diffuse +
                        "</diffuse></lambert></technique></profile_COMMON></effect>"
                        "</library_effects><library_materials><material id=\"m\" name=\"paint\">"
                        "<instance_effect url=\"#e\"/></material></library_materials>");
        text = with(text, "<triangles", " material=\"paint\"");
        text.replace(text.find("url=\"#g\"/>"), 10,
                     "url=\"#g\"><bind_material><technique_common>"
                     "<instance_material symbol=\"paint\" target=\"#m\"/>"
                     "</technique_common></bind_material></instance_geometry>");
        return text;
    };
    EXPECT_EQ(of_file("a.dae", dae("<color>0.2 0.4 0.6 1</color>")), "#336699");
    EXPECT_EQ(of_file("a.dae", dae("<color>-1 2 0.6 1</color>")), "#00ff99");
    EXPECT_EQ(of_file("a.dae", dae("<texture texture=\"t\" texcoord=\"u\"/>")), "none");
    EXPECT_EQ(of_file("a.dae", sample_files().at("sample.dae")), "none");
}

TEST_F(PartColours, OfFbx) {
    const auto fbx = [](const std::string& properties) {
        std::string text =
            with(cube_fbx(), "GeometryVersion: 124\n",
                 "LayerElementMaterial: 0 {\nVersion: 101\nName: \"\"\n"
                 "MappingInformationType: \"AllSame\"\nReferenceInformationType: "
                 "\"IndexToDirect\"\nMaterials: *1 {\na: 0\n}\n}\n"
                 "Layer: 0 {\nVersion: 100\nLayerElement:  {\nType: \"LayerElementMaterial\"\n"
                 "TypedIndex: 0\n}\n}\n");
        text = with(text, "Objects:  {\n",
                    "Material: 1003, \"Material::paint\", \"\" {\nVersion: 102\n"
                    "ShadingModel: \"lambert\"\nMultiLayer: 0\nProperties70:  {\n" +
                        properties + "}\n}\n");
        return with(text, "Connections:  {\n", "C: \"OO\",1003,1002\n");
    };
    const std::string diffuse = "P: \"DiffuseColor\", \"Color\", \"\", \"A\",0.2,0.4,0.6\n";
    EXPECT_EQ(of_file("a.fbx", fbx(diffuse)), "#336699");
    EXPECT_EQ(of_file("a.fbx", fbx(diffuse + "P: \"Opacity\", \"double\", \"Number\", \"\",0.5\n")),
              "#33669980");
    EXPECT_EQ(of_file("a.fbx", cube_fbx()), "none");
}

TEST_F(PartColours, OfFormatsWithoutMaterials) {
    for (const auto& [name, content] : sample_files())
        EXPECT_EQ(of_file(name, content), "none") << name;
}

} // namespace
} // namespace abut::test
