// Real buildings in IFC. Every product with a body, as found by scanning the file's text, is a part
// or is named in a note. Solids have closed surfaces, except those named here.

#include <abut/error.h>
#include <abut/mesh.h>
#include <abut/scene.h>

#include "tests/support/paths.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace abut::test {
namespace {

const std::string kFolder = std::string(ABUT_SHARED_DATA) + "/ifc/";

/// An entity of a STEP file: its class, and its parameters as written.
struct Entity {
    std::string type;
    std::vector<std::string> parameters;
};

/// Splits a list such as "a,(b,c),'d,'" into its parameters.
std::vector<std::string> split(std::string_view list) {
    std::vector<std::string> words(1);
    int depth = 0;
    bool in_text = false;
    for (const char c : list) {
        in_text = in_text != (c == '\''); // '' inside a text ends the text and begins it again
        if (!in_text && (c == '(' || c == ')'))
            depth += c == '(' ? 1 : -1;
        if (!in_text && depth == 0 && c == ',')
            words.emplace_back();
        else
            words.back() += c;
    }
    return words;
}

/// All entities by name (#12). The file must have no comments in its data.
std::map<std::string, Entity> entities(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    text.erase(
        std::remove_if(text.begin(), text.end(), [](char c) { return c == '\r' || c == '\n'; }),
        text.end());
    std::map<std::string, Entity> all;
    bool in_text = false;
    for (std::size_t at = text.find("DATA;") + 5, end = at; end < text.size(); ++end) {
        in_text = in_text != (text[end] == '\'');
        if (in_text || text[end] != ';')
            continue;
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        const std::size_t equals = line.find('='), open = line.find('(');
        if (equals == std::string::npos || open == std::string::npos)
            continue;
        const auto bare = [](std::string word) {
            std::erase(word, ' ');
            return word;
        };
        all[bare(line.substr(0, equals))] = {
            bare(line.substr(equals + 1, open - equals - 1)),
            split(line.substr(open + 1, line.rfind(')') - open - 1))};
    }
    return all;
}

/// GlobalId and class of all products with a 'Body' representation, except openings.
std::map<std::string, std::string> products_with_body(const std::string& path) {
    const auto all = entities(path);
    const auto trimmed = [](std::string word) {
        word.erase(0, word.find_first_not_of(' '));
        return word.substr(0, word.find_last_not_of(' ') + 1);
    };
    const auto at = [&](const std::string& name) -> const Entity& { return all.at(trimmed(name)); };
    std::map<std::string, std::string> products;
    for (const auto& [name, entity] : all) {
        if (entity.parameters.size() < 7 || entity.parameters[6].find('#') == std::string::npos ||
            entity.type == "IFCOPENINGELEMENT")
            continue;
        const auto shape = all.find(trimmed(entity.parameters[6]));
        if (shape == all.end() || shape->second.type != "IFCPRODUCTDEFINITIONSHAPE")
            continue;
        std::string list = trimmed(shape->second.parameters[2]);
        for (const std::string& representation : split(list.substr(1, list.size() - 2)))
            if (at(representation).parameters[1] == "'Body'")
                products[entity.parameters[0].substr(1, 22)] = entity.type;
    }
    return products;
}

struct File {
    const char* path;
    std::size_t parts, spaces, cut_away;
    std::vector<std::string> open; ///< ids of solids whose surface is not closed
    friend std::ostream& operator<<(std::ostream& stream, const File& file) {
        return stream << file.path;
    }
};

class IfcData : public testing::TestWithParam<File> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(kFolder + GetParam().path))
            GTEST_SKIP() << kFolder + GetParam().path << " is not there";
        try {
            scene_ = read_scene(kFolder + GetParam().path);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::unsupported)
                throw;
            GTEST_SKIP() << error.what();
        }
    }
    static void expect_spaces_if_asked_for() {
        ReadOptions options;
        options.spaces = true;
        const Scene all = read_scene(kFolder + GetParam().path, options);
        EXPECT_EQ(all.parts.size(), GetParam().parts + GetParam().spaces);
        const auto spaces = std::count_if(all.parts.begin(), all.parts.end(), [](const Part& part) {
            return part.type == "IfcSpace" || part.type == "IfcSpatialZone";
        });
        EXPECT_EQ(spaces, static_cast<std::ptrdiff_t>(GetParam().spaces));
        for (const SceneNote& note : all.notes)
            EXPECT_NE(note.kind, NoteKind::space);
    }
    Scene scene_;
};

TEST_P(IfcData, EveryProductWithABodyIsAPartOrHasANote) {
    const auto products = products_with_body(kFolder + GetParam().path);
    EXPECT_GT(products.size(), 0U);
    std::set<std::string> found;
    for (const Part& part : scene_.parts) {
        EXPECT_TRUE(products.contains(part.id)) << part.id;
        EXPECT_TRUE(found.insert(part.id).second) << part.id;
        EXPECT_FALSE(scene_.meshes[part.mesh].triangles.empty());
    }
    std::map<NoteKind, std::size_t> counts;
    std::set<std::string> open;
    for (const SceneNote& note : scene_.notes) {
        ++counts[note.kind];
        EXPECT_TRUE(products.contains(note.id)) << note.id;
        EXPECT_EQ(note.text.find('\n'), std::string::npos);
        if (note.kind == NoteKind::open)
            open.insert(note.id);
        else
            EXPECT_TRUE(found.insert(note.id).second) << note.id;
        EXPECT_EQ(note.kind == NoteKind::space,
                  products.at(note.id) == "IFCSPACE" || products.at(note.id) == "IFCSPATIALZONE");
    }
    for (const auto& [id, type] : products)
        EXPECT_TRUE(found.contains(id)) << type << " " << id << " is lost without a word";
    EXPECT_EQ(scene_.parts.size(), GetParam().parts);
    EXPECT_EQ(counts[NoteKind::space], GetParam().spaces);
    EXPECT_EQ(counts[NoteKind::cut_away], GetParam().cut_away);
    EXPECT_EQ(counts[NoteKind::not_built], 0U);
    EXPECT_EQ(open, std::set<std::string>(GetParam().open.begin(), GetParam().open.end()));
    EXPECT_EQ(scene_.up, UpAxis::z);
    // The projects are in millimetres, metres or feet.
    EXPECT_TRUE(scene_.unit == 0.001 || scene_.unit == 1 || std::fabs(scene_.unit - 0.3048) < 1e-9)
        << scene_.unit;
    if (GetParam().spaces > 0)
        expect_spaces_if_asked_for();
}

INSTANTIATE_TEST_SUITE_P(
    Buildings, IfcData,
    testing::Values(File{"duplex/Duplex_A_20110907.ifc",
                         215,
                         21,
                         0,
                         {"1oKjKg9PD3fP1iIwXLh3lK", "3KMJUyUe9DfQ2FOCd5ZoiN"}},
                    File{"duplex/Duplex_Electrical_20121207.ifc", 103, 1, 0, {}},
                    File{"pcert/Building-Architecture.ifc", 11, 3, 0, {}},
                    File{"pcert/Building-Hvac.ifc", 5, 0, 0, {}},
                    File{"pcert/Building-Landscaping.ifc", 6, 0, 0, {}},
                    File{"pcert/Building-Structural.ifc", 16, 0, 0, {}},
                    File{"samplehouse/Ifc4_SampleHouse.ifc",
                         58,
                         4,
                         0,
                         {"3cUkl32yn9qRSPvBJVyWXt", "3cUkl32yn9qRSPvBJVyWy4",
                          "3cUkl32yn9qRSPvBJVyYGp", "09J5N7xMHBfQZeQGAEMomB"}},
                    File{"schependomlaan/IFC-Vebo.ifc", 130, 0, 0, {"2idEjti6zFIgYm2tBrhV$n"}},
                    File{"schependomlaan/IFC-breedplaatvloeren.ifc", 59, 0, 0, {}},
                    File{"schependomlaan/IFC-houten_kozijnen.ifc", 100, 0, 64, {}},
                    File{"schependomlaan/IFC-kalkzandsteen.ifc", 135, 0, 0, {}},
                    File{"schependomlaan/IFC-kanaalplaatvloer.ifc", 50, 0, 0, {}},
                    File{"schependomlaan/IFC-kapconstructie_dakkapellen_platdak.ifc",
                         141,
                         0,
                         0,
                         {"0e2AmNgkb1Gflqp22P2CPd", "3AuBloy8rB2eQ0HbTV6Kmm"}},
                    File{"schependomlaan/IFC-lateien_en_geveldragers.ifc", 42, 0, 0, {}},
                    File{"schependomlaan/IFC-prefab_balkons.ifc", 4, 0, 0, {}},
                    File{"schependomlaan/IFC-prefab_trappen.ifc", 10, 0, 0, {}},
                    File{"schependomlaan/IFC-prefab_vloer_lifttop.ifc", 2, 0, 0, {}},
                    File{"schependomlaan/IFC-staal.ifc", 78, 0, 0, {}},
                    File{"schependomlaan/IFC-traphekken.ifc", 14, 0, 0, {}},
                    File{"schependomlaan/LINDEN-Kozijnen.ifc", 1438, 0, 0, {}}),
    [](const auto& instance) {
        std::string name = std::filesystem::path(instance.param.path).stem();
        std::replace_if(
            name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
        return name;
    });

Scene read_or_skip(const std::string& path) {
    if (!std::filesystem::exists(path))
        return {};
    try {
        return read_scene(path);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::unsupported)
            throw;
        return {};
    }
}

TEST(IfcMap, FilesWithAMapConversionArePlacedOnTheMap) {
    const std::string file = kFolder + "pcert/Building-Structural.ifc";
    const Scene scene = read_or_skip(file);
    if (scene.parts.empty())
        GTEST_SKIP() << "the file or web-ifc is not there";
    ReadOptions options;
    options.map = false;
    const Scene project = read_scene(file, options);
    ASSERT_EQ(project.parts.size(), scene.parts.size());
    // #19=IFCMAPCONVERSION(…) in millimetres rotates by 60 degrees.
    const double sine = std::sqrt(0.75);
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const auto& from = project.parts[i].world_from_mesh.m;
        const auto& to = scene.parts[i].world_from_mesh.m;
        EXPECT_NEAR(to[9], 729013.3488297004 + 0.5 * from[9] - sine * from[10], 1e-8);
        EXPECT_NEAR(to[10], 9063992.684697363 + sine * from[9] + 0.5 * from[10], 1e-8);
        EXPECT_NEAR(to[11], 1.3 + from[11], 1e-12);
        for (std::size_t column = 0; column < 9; column += 3) {
            EXPECT_NEAR(to[column], 0.5 * from[column] - sine * from[column + 1], 1e-15);
            EXPECT_NEAR(to[column + 1], sine * from[column] + 0.5 * from[column + 1], 1e-15);
            EXPECT_EQ(to[column + 2], from[column + 2]);
        }
    }
}

TEST(IfcSurfaces, AGirderHasAllOfItsSixteenTriangles) {
    const Scene scene = read_or_skip(kFolder + "pcert/Building-Structural.ifc");
    if (scene.parts.empty())
        GTEST_SKIP() << "the file or web-ifc is not there";
    std::size_t girders = 0;
    for (const Part& part : scene.parts)
        if (part.name.find("girder") != std::string::npos) {
            ++girders;
            const MeshReport report = inspect(scene.meshes[part.mesh]);
            EXPECT_EQ(report.triangles, 16U) << part.id;
            EXPECT_TRUE(report.closed) << part.id;
        }
    EXPECT_GT(girders, 0U);
}

TEST(IfcSurfaces, AWallWithOpeningsIsClosed) {
    const Scene scene = read_or_skip(kFolder + "duplex/Duplex_A_20110907.ifc");
    if (scene.parts.empty())
        GTEST_SKIP() << "the file or web-ifc is not there";
    std::size_t walls = 0;
    for (const Part& part : scene.parts)
        if (part.type == "IfcWallStandardCase") {
            ++walls;
            EXPECT_TRUE(inspect(scene.meshes[part.mesh]).closed) << part.id;
        }
    EXPECT_EQ(walls, 56U);
}

Box3 box_of(const Scene& scene, const Part& part) {
    Scene alone;
    alone.meshes = {scene.meshes[part.mesh]};
    alone.parts = {part};
    alone.parts[0].mesh = 0;
    return inspect(to_mesh(alone)).bounds;
}

/// A building as GLB (y up) and as IFC (z up): the frames agree after a quarter turn.
TEST(IfcFrame, EqualsThatOfTheBuildingAsGlb) {
    std::vector<Scene> scenes{
        read_or_skip(std::string(ABUT_SHARED_DATA) + "/bim/duplex_design.glb"),
        read_or_skip(kFolder + "duplex/Duplex_A_20110907.ifc")};
    if (scenes[0].parts.empty() || scenes[1].parts.empty())
        GTEST_SKIP() << "the files or web-ifc are not there";
    EXPECT_EQ(scenes[0].up, UpAxis::y);
    EXPECT_EQ(scenes[1].up, UpAxis::z);
    into_one_frame(scenes);
    std::map<std::string, Box3> boxes;
    for (const Part& part : scenes[0].parts)
        boxes.emplace(part.id, box_of(scenes[0], part));
    std::size_t same = 0;
    for (const Part& part : scenes[1].parts) {
        const Box3 a = boxes.at(part.id), b = box_of(scenes[1], part);
        const double apart =
            std::max({std::fabs(a.lower.x - b.lower.x), std::fabs(a.lower.y - b.lower.y),
                      std::fabs(a.lower.z - b.lower.z), std::fabs(a.upper.x - b.upper.x),
                      std::fabs(a.upper.y - b.upper.y), std::fabs(a.upper.z - b.upper.z)});
        same += apart < 0.001 ? 1 : 0;
    }
    EXPECT_EQ(same, 215U);
    EXPECT_EQ(boxes.size(), 215U);
}

} // namespace
} // namespace abut::test
