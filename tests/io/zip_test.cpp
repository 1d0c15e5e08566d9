// Models in ZIP archives: 3MF and ifcZIP, and archives with false sizes.

#include "tests/io/support.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <fmt/format.h>
#include <zlib.h>

namespace abut::test {
namespace {

struct Entry {
    std::string name, content;
    std::uint32_t promised = 0; ///< size in the directory; 0: the true one
};

std::string deflated(const std::string& content) {
    std::string packed(compressBound(content.size()) + 64, '\0');
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
    std::string copy = content;
    stream.next_in = reinterpret_cast<Bytef*>(copy.data());
    stream.avail_in = static_cast<uInt>(copy.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

std::string zip(const std::vector<Entry>& entries, bool packs = true) {
    std::string bytes, directory;
    for (const Entry& entry : entries) {
        const std::string packed = packs ? deflated(entry.content) : entry.content;
        const auto checksum = static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>(entry.content.data()),
                  static_cast<uInt>(entry.content.size())));
        const auto at = static_cast<std::uint32_t>(bytes.size());
        std::string facts; // equal in both records
        append(facts, std::array<std::uint16_t, 5>{20, 0, std::uint16_t(packs ? 8 : 0), 0, 0});
        append(facts, checksum);
        append(facts, static_cast<std::uint32_t>(packed.size()));
        append(facts, entry.promised > 0 ? entry.promised
                                         : static_cast<std::uint32_t>(entry.content.size()));
        append(facts,
               std::array<std::uint16_t, 2>{static_cast<std::uint16_t>(entry.name.size()), 0});
        bytes.append("PK\x03\x04").append(facts).append(entry.name).append(packed);
        directory += "PK\x01\x02" + std::string(1, '\x14') + std::string(1, '\0') + facts;
        append(directory, std::array<std::uint16_t, 3>{});
        append(directory, std::uint32_t{0});
        append(directory, at);
        directory += entry.name;
    }
    const auto start = static_cast<std::uint32_t>(bytes.size());
    bytes += directory + "PK\x05\x06";
    const auto count = static_cast<std::uint16_t>(entries.size());
    append(bytes, std::array<std::uint16_t, 4>{0, 0, count, count});
    append(bytes, static_cast<std::uint32_t>(directory.size()));
    append(bytes, start);
    append(bytes, std::uint16_t{0});
    return bytes;
}

class Zip : public testing::Test {
protected:
    TemporaryFolder folder_;
};

const std::string kRelations = R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>)";

std::string model_3mf(const std::string& unit) {
    std::string vertices, triangles;
    for (const auto& [x, y, z] : kCorners)
        vertices += fmt::format(R"(<vertex x="{}" y="{}" z="{}"/>)", x, y, z);
    for (const auto& [a, b, c] : kFaces)
        triangles += fmt::format(R"(<triangle v1="{}" v2="{}" v3="{}"/>)", a, b, c);
    return R"(<?xml version="1.0" encoding="UTF-8"?><!-- <model unit="foot"> -->
<model )" + unit +
           R"( xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><object id="1" name="wedge &lt;a&gt;" type="model"><mesh><vertices>)" +
           vertices + "</vertices><triangles>" + triangles + R"(</triangles></mesh></object>
<object id="2" type="model" name="pair"><components><component objectid="1"/>
<component objectid="1" transform="1 0 0 0 1 0 0 0 1 10 0 0"/></components></object></resources>
<build><item objectid="2" transform="0 1 0 -1 0 0 0 0 1 100 200 300"/><item objectid="1"/></build></model>)";
}

std::string file_3mf(const std::string& model) {
    return zip(
        {{"[Content_Types].xml",
          R"(<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>)"},
         {"_rels/.rels", kRelations},
         {"3D/3dmodel.model", model}});
}

TEST_F(Zip, A3mfFileHasAUnitComponentsAndBuildItems) {
    for (const auto& [word, metres] :
         std::vector<std::pair<std::string, double>>{{"", 0.001},
                                                     {"unit=\"micron\"", 1e-6},
                                                     {"unit=\"millimeter\"", 0.001},
                                                     {"unit='centimeter'", 0.01},
                                                     {"unit=\"inch\"", 0.0254},
                                                     {"unit = \"foot\"", 0.3048},
                                                     {"unit=\"meter\"", 1}}) {
        SCOPED_TRACE(word);
        const Scene scene = read_scene(folder_.file("model.3mf", file_3mf(model_3mf(word))));
        EXPECT_EQ(scene.unit, metres);
        EXPECT_EQ(scene.up, UpAxis::z);
        ASSERT_EQ(scene.parts.size(), 3U);
        EXPECT_EQ(scene.meshes.size(), 1U);
        EXPECT_EQ(scene.parts[0].name, "wedge <a>");
        EXPECT_NE(scene.parts[0].id, scene.parts[1].id);
        const auto triangles = world_triangles(scene);
        ASSERT_EQ(triangles.size(), 12U);
        // Corner 1, (1.25, 0, 0): the pair is rotated by x to y and y to -x, then moved.
        const auto expect_near = [unit = metres](const Vec3& found, const Vec3& expected) {
            EXPECT_NEAR(found.x, expected.x * unit, 1e-6 * unit);
            EXPECT_NEAR(found.y, expected.y * unit, 1e-6 * unit);
            EXPECT_NEAR(found.z, expected.z * unit, 1e-6 * unit);
        };
        expect_near(triangles[0][2], {100, 201.25, 300});
        expect_near(triangles[4][2], {100, 211.25, 300});
        expect_near(triangles[8][2], {1.25, 0, 0});
    }
}

TEST_F(Zip, A3mfFileHasColours) {
    const auto colour_of = [&](const std::string& base, const std::string& object) {
        std::string model = model_3mf("");
        model.insert(model.find("<resources>") + 11,
                     "<basematerials id=\"5\"><base name=\"paint\" " + base + "/></basematerials>");
        model.insert(model.find("<object ") + 8, object + " ");
        const Scene scene = read_scene(folder_.file("model.3mf", file_3mf(model)));
        for (const Part& part : scene.parts)
            EXPECT_EQ(part.colour, scene.parts[0].colour);
        return scene.parts[0].colour;
    };
    const std::string uses = "pid=\"5\" pindex=\"0\"";
    EXPECT_EQ(colour_of("displaycolor=\"#336699\"", uses), (Colour{0x33, 0x66, 0x99}));
    EXPECT_EQ(colour_of("displaycolor=\"#33669980\"", uses), (Colour{0x33, 0x66, 0x99, 0x80}));
    EXPECT_FALSE(colour_of("displaycolor=\"#336699\"", "")); // the object does not use it
    EXPECT_FALSE(read_scene(folder_.file("model.3mf", file_3mf(model_3mf("")))).parts[0].colour);
}

TEST_F(Zip, A3mfFileThatIsDamaged) {
    const std::string whole = file_3mf(model_3mf(""));
    const auto refuse = [&](const std::string& bytes) {
        return error_of(folder_.file("bad.3mf", bytes), ErrorCode::malformed);
    };
    for (std::size_t size = 10; size < whole.size(); size += 1 + whole.size() / 20)
        refuse(whole.substr(0, size));
    refuse(file_3mf(model_3mf("unit=\"cubit\"")));
    refuse(file_3mf("no xml"));
    refuse(zip({{"3D/3dmodel.model", model_3mf("")}})); // without relationships
    refuse(zip({{"_rels/.rels", kRelations}}));         // without the model
    // The entry claims 4 GB.
    EXPECT_NE(refuse(zip({{"_rels/.rels", kRelations},
                          {"3D/3dmodel.model", model_3mf(""), 4'000'000'000U}}))
                  .find("claims"),
              std::string::npos);
    std::string damaged = whole;
    damaged[whole.find("3D/3dmodel.model") + 200] ^= 0x55;
    try {
        (void)read_scene(folder_.file("bad.3mf", damaged));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::malformed) << error.what();
    }
}

TEST_F(Zip, A3mfFileWhoseComponentsMultiplyOrFormACycle) {
    const auto model = [](const std::string& components, const std::string& item) {
        std::string text = model_3mf("");
        text.insert(text.find("</resources>"), components);
        return text.insert(text.find("</build>"), "<item objectid=\"" + item + "\"/>");
    };
    const auto refuse = [&](const std::string& text) {
        return error_of(folder_.file("bad.3mf", file_3mf(text)), ErrorCode::malformed);
    };
    // Each object contains the one before ten times: 2 * 10^9 parts in all.
    std::string tower;
    for (int id = 3; id <= 11; ++id) {
        tower += "<object id=\"" + std::to_string(id) + "\"><components>";
        for (int i = 0; i < 10; ++i)
            tower += "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
        tower += "</components></object>";
    }
    EXPECT_NE(refuse(model(tower, "11")).find("builds more than"), std::string::npos);
    EXPECT_EQ(read_scene(folder_.file("good.3mf", file_3mf(model(tower, "4")))).parts.size(), 203U);
    const std::string own =
        R"(<object id="3"><components><component objectid="3"/></components></object>)";
    EXPECT_NE(refuse(model(own, "3")).find("object 3"), std::string::npos);
    const std::string circle =
        R"(<object id="3"><components><component objectid="4"/></components></object>)"
        R"(<object id="4"><components><component objectid="3"/></components></object>)";
    EXPECT_NE(refuse(model(circle, "4")).find("object 4"), std::string::npos);
    EXPECT_NE(refuse(model("", "9")).find("object 9"), std::string::npos);
}

class IfcZip : public Zip {
protected:
    void SetUp() override {
        try {
            house_ = read_scene(std::string(ABUT_SOURCE_DIR) + "/tests/io/house_4.ifc");
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
    Scene house_;
    std::string text_ = read_bytes(std::string(ABUT_SOURCE_DIR) + "/tests/io/house_4.ifc");
};

TEST_F(IfcZip, EqualsTheFileInTheArchive) {
    for (const bool packs : {true, false}) {
        const Scene scene = read_scene(folder_.file(
            "house.ifczip",
            zip({{"read me.txt", "text"}, {"House.IFC", text_}, {"__MACOSX/._House.IFC", "macOS"}},
                packs)));
        ASSERT_EQ(scene.parts.size(), house_.parts.size());
        EXPECT_EQ(scene.up, house_.up);
        for (std::size_t i = 0; i < scene.parts.size(); ++i)
            EXPECT_EQ(scene.parts[i].id, house_.parts[i].id);
        EXPECT_EQ(world_triangles(scene), world_triangles(house_));
    }
}

TEST_F(IfcZip, DamagedArchivesAreRefused) {
    const std::string whole = zip({{"house.ifc", text_}});
    const auto refuse = [&](const std::string& bytes) {
        return error_of(folder_.file("bad.ifczip", bytes), ErrorCode::malformed);
    };
    for (std::size_t size = 10; size < whole.size(); size += 1 + whole.size() / 8)
        refuse(whole.substr(0, size));
    refuse(zip({{"a.ifc", text_}, {"b.ifc", text_}}));
    refuse(zip({{"a.txt", text_}}));
    EXPECT_NE(refuse(zip({{"a.ifc", text_, 4'000'000'000U}})).find("claims"), std::string::npos);
    refuse(zip({{"a.ifc", text_, static_cast<std::uint32_t>(text_.size() - 1)}}));
    std::string damaged = whole;
    damaged[whole.size() / 3] ^= 0x55;
    refuse(damaged);
}

} // namespace
} // namespace abut::test
