// Properties and relations of parts from IFC. Skipped without Node.js or web-ifc.

#include "tests/io/ifc_folder.h"
#include "tests/io/support.h"

#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace abut::test {
namespace {

// The parts of house_4.ifc: lines #38, #58 and #66.
const std::string kWall = "4WallOfTheTests0000001", kTable = "4TableOfTheTests000001",
                  kOther = "4TableOfTheTests000002";

/// The first attributes of a relationship.
std::string root(int number) {
    const std::string digits = std::to_string(number);
    return "'0RelationOfTests" + std::string(6 - digits.size(), '0') + digits + "',$,$,$,";
}

using Values = std::vector<std::string>;

class IfcProperties : public testing::Test {
protected:
    void SetUp() override {
        try {
            (void)read_scene(kFolder + "house_2x3.ifc");
        } catch (const Error& error) {
            if (error.code() == ErrorCode::unsupported)
                GTEST_SKIP() << error.what();
        }
    }
    /// Reads a house with lines added. Each `without` is removed from its text.
    void read(const std::string& lines, const std::string& house = "house_4.ifc",
              const Values& without = {}) {
        std::string text = read_bytes(kFolder + house);
        for (const std::string& word : without) {
            const std::size_t at = text.find(word);
            ASSERT_NE(at, std::string::npos) << word;
            text.erase(at, word.size());
        }
        text.insert(text.rfind("ENDSEC;"), lines);
        scene_ = read_scene(folder_.file("house.ifc", text));
    }
    [[nodiscard]] std::uint32_t part(const std::string& id) const {
        for (std::uint32_t i = 0; i < scene_.parts.size(); ++i)
            if (scene_.parts[i].id == id)
                return i;
        throw std::out_of_range(id);
    }
    [[nodiscard]] Values values(const std::string& id, const std::string& name) const {
        Values found;
        if (const auto number = scene_.properties.find(name))
            for (const auto& entry : scene_.properties.of(part(id), *number))
                found.push_back(scene_.properties.values[entry.value]);
        return found;
    }
    using Named = std::tuple<std::string, std::string, std::string>;
    [[nodiscard]] std::set<Named> relations() const {
        std::set<Named> found;
        for (const auto& [a, b, kind] : scene_.relations)
            found.emplace(scene_.parts[a].id, to_string(kind), scene_.parts[b].id);
        return found;
    }
    Scene scene_;
    TemporaryFolder folder_;
};

TEST_F(IfcProperties, PlacesOfAPart) {
    read("");
    EXPECT_EQ(scene_.project, "0ProjectOfTests0000004");
    EXPECT_EQ(scene_.map_from_project, Transform());
    for (const std::string& id : {kWall, kTable, kOther}) {
        EXPECT_EQ(values(id, "storey"), Values{"Ground"});
        EXPECT_EQ(values(id, "building"), Values{"House"});
        EXPECT_EQ(values(id, "site"), Values{"Site"});
        EXPECT_EQ(values(id, "space"), Values{});
        EXPECT_EQ(values(id, "discipline"), Values{"architecture"});
    }
}

TEST_F(IfcProperties, APartInASpaceHasItsStoreyAndZone) {
    read("#200=IFCSPACE(" + root(200) + "$,$,$,'Kitchen',.ELEMENT.,$,$);\n" + //
             "#201=IFCRELAGGREGATES(" + root(201) + "#25,(#200));\n" +        //
             "#202=IFCRELCONTAINEDINSPATIALSTRUCTURE(" + root(202) + "(#38,#58),#200);\n" +
             "#203=IFCZONE('0ZoneOfTheTests0000001',$,'Flat 1',$,$,$);\n" +
             "#204=IFCRELASSIGNSTOGROUP(" + root(204) + "(#200),$,#203);\n" +
             "#205=IFCBUILDINGSTOREY('0StoreyOfTheTests00005',$,'Upper',$,$,#24,$,$,.ELEMENT.,3.);"
             "\n" +
             "#206=IFCRELREFERENCEDINSPATIALSTRUCTURE(" + root(206) + "(#38),#205);\n",
         "house_4.ifc",
         {"#70=IFCRELCONTAINEDINSPATIALSTRUCTURE('0ContainmentOfTests004',$,$,$,"
          "(#38,#58,#66),#25);"});
    EXPECT_EQ(values(kTable, "space"), Values{"Kitchen"});
    EXPECT_EQ(values(kTable, "storey"), Values{"Ground"});
    EXPECT_EQ(values(kTable, "zone"), Values{"Flat 1"});
    // The wall also reaches into the upper storey.
    EXPECT_EQ(values(kWall, "storey"), (Values{"Ground", "Upper"}));
    EXPECT_EQ(values(kOther, "storey"), Values{});
}

TEST_F(IfcProperties, GroupsSystemsAndTheirDiscipline) {
    read("#200=IFCSYSTEM('0SystemOfTheTests00001',$,'Cold water',$,$);\n"
         "#201=IFCDISTRIBUTIONSYSTEM('0SystemOfTheTests00002',$,'Sprinklers',$,$,$,"
         ".FIREPROTECTION.);\n"
         "#202=IFCGROUP('0GroupOfTheTests000001',$,'Phase 1',$,$);\n"
         "#203=IFCRELASSIGNSTOGROUP(" +
         root(203) + "(#58),$,#200);\n" + "#204=IFCRELASSIGNSTOGROUP(" + root(204) +
         "(#58,#66),$,#201);\n" + "#205=IFCRELASSIGNSTOGROUP(" + root(205) + "(#201),$,#202);\n");
    EXPECT_EQ(values(kTable, "system"), (Values{"Cold water", "Sprinklers"}));
    EXPECT_EQ(values(kOther, "system"), Values{"Sprinklers"});
    EXPECT_EQ(values(kOther, "group"), Values{"Phase 1"});
    EXPECT_EQ(values(kOther, "discipline"), Values{"fire"});
    EXPECT_EQ(values(kWall, "group"), Values{});
}

TEST_F(IfcProperties, MaterialsAndClassifications) {
    read("#200=IFCMATERIAL('Brick',$,$);\n#201=IFCMATERIAL('Plaster',$,$);\n"
         "#202=IFCMATERIALLAYER(#200,100.,$,$,$,$,$);\n#203=IFCMATERIALLAYER(#201,10.,$,$,$,$,$);\n"
         "#204=IFCMATERIALLAYERSET((#203,#202,#203),'Set',$);\n"
         "#205=IFCMATERIALLAYERSETUSAGE(#204,.AXIS2.,.POSITIVE.,0.,$);\n"
         "#206=IFCRELASSOCIATESMATERIAL(" +
         root(206) + "(#38),#205);\n" +
         "#207=IFCMATERIALLIST((#200,#201));\n"
         "#208=IFCRELASSOCIATESMATERIAL(" +
         root(208) + "(#58),#207);\n" +
         "#209=IFCMATERIALCONSTITUENT('Frame',$,#201,$,$);\n"
         "#210=IFCMATERIALCONSTITUENTSET($,$,(#209));\n"
         "#211=IFCRELASSOCIATESMATERIAL(" +
         root(211) + "(#220),#210);\n" +
         "#220=IFCFURNITURETYPE('0TypeOfTheTests0000001',$,'Oak table',$,$,$,$,$,$,$,.TABLE.);\n"
         "#221=IFCRELDEFINESBYTYPE(" +
         root(221) + "(#58,#66),#220);\n" +
         "#230=IFCCLASSIFICATION($,$,$,'Uniclass',$,$,$);\n"
         "#231=IFCCLASSIFICATIONREFERENCE($,'EF_25_10','Walls',#230,$,$);\n"
         "#232=IFCRELASSOCIATESCLASSIFICATION(" +
         root(232) + "(#38),#231);\n");
    EXPECT_EQ(values(kWall, "material"), (Values{"Plaster", "Brick"}));
    EXPECT_EQ(values(kTable, "material"), (Values{"Brick", "Plaster"}));
    // Without a material of its own, a part has that of its type.
    EXPECT_EQ(values(kOther, "material"), Values{"Plaster"});
    EXPECT_EQ(values(kOther, "type_object"), Values{"Oak table"});
    EXPECT_EQ(values(kOther, "predefined_type"), Values{"TABLE"});
    EXPECT_EQ(values(kWall, "classification"), Values{"EF_25_10"});
}

TEST_F(IfcProperties, SetsOfAPartOverrideThoseOfItsType) {
    read("#200=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F60'),$);\n"
         "#201=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);\n"
         "#202=IFCPROPERTYSET('0SetOfTheTests00000001',$,'Pset_Furniture',$,(#200,#201));\n"
         "#203=IFCFURNITURETYPE('0TypeOfTheTests0000001',$,'Oak "
         "table',$,$,(#202),$,$,$,.TABLE.,$);\n"
         "#204=IFCRELDEFINESBYTYPE(" +
         root(204) + "(#58,#66),#203);\n" +
         "#205=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F90'),$);\n"
         "#206=IFCPROPERTYSET('0SetOfTheTests00000002',$,'Pset_Furniture',$,(#205));\n"
         "#207=IFCRELDEFINESBYPROPERTIES(" +
         root(207) + "(#58),#206);\n" +
         "#208=IFCPROPERTYSET('0SetOfTheTests00000003',$,'A',$,(#200));\n"
         "#209=IFCPROPERTYSET('0SetOfTheTests00000004',$,'B',$,(#205));\n"
         "#210=IFCRELDEFINESBYPROPERTIES(" +
         root(210) + "(#38),IFCPROPERTYSETDEFINITIONSET((#208,#209)));\n");
    EXPECT_EQ(values(kTable, "Pset_Furniture.FireRating"), Values{"F90"});
    EXPECT_EQ(values(kOther, "Pset_Furniture.FireRating"), Values{"F60"});
    EXPECT_EQ(values(kTable, "Pset_Furniture.IsExternal"), Values{"true"});
    EXPECT_EQ(values(kWall, "A.FireRating"), Values{"F60"});
    EXPECT_EQ(values(kWall, "B.FireRating"), Values{"F90"});
}

TEST_F(IfcProperties, ValuesKeepTheirDigitsAndText) {
    const std::vector<std::pair<std::string, Values>> cases{
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCREAL(0.1234567890123456789),$)",
         {"0.1234567890123456789"}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCREAL(-7.),$)", {"-7"}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCREAL(1.E-3),$)", {"1E-3"}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCINTEGER(-12345678901),$)", {"-12345678901"}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCLABEL('7.'),$)", {"7."}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCLOGICAL(.U.),$)", {"unknown"}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCTEXT('It''s \\X2\\00E4\\X0\\; \\X\\E9'),$)",
         {"It's ä; é"}},
        {"IFCPROPERTYSINGLEVALUE('X',$,$,$)", {}},
        {"IFCPROPERTYSINGLEVALUE('X',$,IFCLABEL(''),$)", {}},
        {"IFCPROPERTYENUMERATEDVALUE('X',$,(IFCLABEL('A'),IFCLABEL('B')),$)", {"A", "B"}},
        {"IFCPROPERTYLISTVALUE('X',$,(IFCINTEGER(2),IFCINTEGER(1)),$)", {"2", "1"}},
        {"IFCPROPERTYBOUNDEDVALUE('X',$,IFCREAL(2.),IFCREAL(0.5),$,IFCREAL(1.))",
         {"0.5", "1", "2"}},
        {"IFCQUANTITYAREA('X',$,$,12.5,$)", {"12.5"}},
    };
    for (const auto& [line, expected] : cases) {
        SCOPED_TRACE(line);
        const bool is_quantity = line.starts_with("IFCQUANTITY");
        read("#200=" + line +
             ";\n#201=" + (is_quantity ? "IFCELEMENTQUANTITY(" : "IFCPROPERTYSET(") +
             "'0SetOfTheTests00000001',$,'S',$," + (is_quantity ? "$," : "") + "(#200));\n" +
             "#202=IFCRELDEFINESBYPROPERTIES(" + root(202) + "(#38),#201);\n");
        EXPECT_EQ(values(kWall, "S.X"), expected);
    }
}

TEST_F(IfcProperties, AWindowFillsItsWall) {
    // The tables stand for a window and for a part of it. A second part fills nothing.
    read("#200=IFCOPENINGELEMENT('0OpeningOfTheTests0001',$,$,$,$,#37,$,$,.OPENING.);\n"
         "#201=IFCRELVOIDSELEMENT(" +
         root(201) + "#38,#200);\n" + "#202=IFCRELFILLSELEMENT(" + root(202) + "#200,#58);\n" +
         "#203=IFCRELAGGREGATES(" + root(203) + "#58,(#66));\n");
    EXPECT_EQ(relations(), (std::set<Named>{{kTable, "fills", kWall},
                                            {kOther, "fills", kWall},
                                            {kOther, "part_of", kTable}}));
    EXPECT_EQ(values(kOther, "assembly"), Values{kTable});
    EXPECT_EQ(values(kTable, "assembly"), Values{});
}

TEST_F(IfcProperties, AWindowWithoutAStoreyHasThatOfItsWall) {
    read("#200=IFCOPENINGELEMENT('0OpeningOfTheTests0001',$,$,$,$,#37,$,$,.OPENING.);\n"
         "#201=IFCRELVOIDSELEMENT(" +
             root(201) + "#38,#200);\n" + "#202=IFCRELFILLSELEMENT(" + root(202) + "#200,#58);\n" +
             "#203=IFCRELCONTAINEDINSPATIALSTRUCTURE(" + root(203) + "(#38),#25);\n",
         "house_4.ifc",
         {"#70=IFCRELCONTAINEDINSPATIALSTRUCTURE('0ContainmentOfTests004',$,$,$,"
          "(#38,#58,#66),#25);"});
    EXPECT_EQ(values(kTable, "storey"), Values{"Ground"});
    EXPECT_EQ(values(kOther, "storey"), Values{});
}

TEST_F(IfcProperties, PartsOfAnAssemblyWithoutGeometry) {
    read("#200=IFCCURTAINWALL('0CurtainWallOfTests001',$,'Front',$,$,$,$,$,$);\n"
         "#201=IFCRELAGGREGATES(" +
             root(201) + "#200,(#58,#66));\n" + "#202=IFCRELCONTAINEDINSPATIALSTRUCTURE(" +
             root(202) + "(#200),#25);\n" + "#203=IFCRELCONNECTSELEMENTS(" + root(203) +
             "$,#200,#38);\n",
         "house_4.ifc",
         {"#70=IFCRELCONTAINEDINSPATIALSTRUCTURE('0ContainmentOfTests004',$,$,$,"
          "(#38,#58,#66),#25);"});
    EXPECT_EQ(values(kTable, "assembly"), Values{"0CurtainWallOfTests001"});
    EXPECT_EQ(values(kTable, "storey"), Values{"Ground"});
    EXPECT_EQ(values(kTable, "discipline"), Values{"architecture"});
    // A relation of the whole holds for its parts.
    EXPECT_EQ(relations(),
              (std::set<Named>{{kWall, "connected", kTable}, {kWall, "connected", kOther}}));
}

TEST_F(IfcProperties, PortsConnectionsAndCoverings) {
    read("#200=IFCDISTRIBUTIONPORT('0PortOfTheTests0000001',$,$,$,$,$,$,.SOURCE.,$,$);\n"
         "#201=IFCDISTRIBUTIONPORT('0PortOfTheTests0000002',$,$,$,$,$,$,.SINK.,$,$);\n"
         "#202=IFCRELNESTS(" +
         root(202) + "#58,(#200));\n" + // IFC 4
         "#203=IFCRELCONNECTSPORTTOELEMENT(" + root(203) + "#201,#66);\n" +
         "#204=IFCRELCONNECTSPORTS(" + root(204) + "#200,#201,$);\n" +
         "#205=IFCRELCONNECTSPATHELEMENTS(" + root(205) + "$,#38,#58,(),(),.ATEND.,.ATSTART.);\n" +
         "#206=IFCRELCOVERSBLDGELEMENTS(" + root(206) + "#38,(#66));\n");
    EXPECT_EQ(relations(), (std::set<Named>{{kTable, "connected", kOther},
                                            {kWall, "connected", kTable},
                                            {kOther, "covers", kWall}}));
    EXPECT_EQ(values(kTable, "assembly"), Values{});
}

TEST_F(IfcProperties, ClassesOfIfc2x3) {
    read("#200=IFCPROPERTYSINGLEVALUE('LoadBearing',$,IFCBOOLEAN(.F.),$);\n"
         "#201=IFCPROPERTYSET('0SetOfTheTests00000001',$,'Pset_WallCommon',$,(#200));\n"
         "#202=IFCRELDEFINESBYPROPERTIES(" +
             root(202) + "(#38,#93),#201);\n" +
             "#203=IFCCLASSIFICATIONREFERENCE('http://x','21.22','Outer walls',$);\n"
             "#204=IFCRELASSOCIATESCLASSIFICATION(" +
             root(204) + "(#38),#203);\n" + "#205=IFCRELCONNECTSPATHELEMENTS(" + root(205) +
             "$,#38,#87,(),(),.ATEND.,.ATSTART.);\n",
         "house_2x3.ifc");
    EXPECT_EQ(values("1WallOfTheTests0000003", "Pset_WallCommon.LoadBearing"), Values{"false"});
    EXPECT_EQ(values("1WallOfTheTests0000001", "classification"), Values{"21.22"});
    EXPECT_EQ(relations(),
              (std::set<Named>{{"1WallOfTheTests0000001", "connected", "1WallOfTheTests0000002"}}));
}

TEST_F(IfcProperties, DisciplinesComeFromClassTypeOrFile) {
    const auto discipline = [&](const std::string& lines) {
        read(lines);
        return std::pair(scene_.properties.value(part(kWall), "discipline"),
                         scene_.properties.value(part(kOther), "discipline"));
    };
    using Pair = std::pair<std::string_view, std::string_view>;
    const std::string typed = "#201=IFCRELDEFINESBYTYPE(" + root(201) + "(#66,#58),#200);\n";
    const std::string start = "('0TypeOfTheTests0000001',$,'T',$,$,$,$,$,$,";
    EXPECT_EQ(discipline("#200=IFCBEAMTYPE" + start + ".BEAM.);\n" + typed),
              Pair("structure", "structure"));
    EXPECT_EQ(discipline("#200=IFCDUCTSEGMENTTYPE" + start + ".RIGIDSEGMENT.);\n" + typed),
              Pair("hvac", "hvac"));
    EXPECT_EQ(discipline("#200=IFCPIPESEGMENTTYPE" + start + ".RIGIDSEGMENT.);\n" + typed),
              Pair("architecture", "architecture")); // the class of the part is more than its type
}

TEST_F(IfcProperties, DamagedRelationsGiveNoValue) {
    // Cycles, lines that do not exist, lines of other classes, a set in itself.
    read("#200=IFCRELAGGREGATES(" + root(200) + "#38,(#58));\n" + "#201=IFCRELAGGREGATES(" +
         root(201) + "#58,(#66));\n" + "#202=IFCRELAGGREGATES(" + root(202) + "#66,(#38));\n" +
         "#203=IFCRELAGGREGATES(" + root(203) + "#25,(#25,#999));\n" +
         "#204=IFCGROUP('0GroupOfTheTests000001',$,'G',$,$);\n"
         "#205=IFCRELASSIGNSTOGROUP(" +
         root(205) + "(#204,#38,#999),$,#204);\n" + "#206=IFCRELDEFINESBYPROPERTIES(" + root(206) +
         "(#38),#999);\n" + "#207=IFCRELDEFINESBYPROPERTIES(" + root(207) + "(#38),#38);\n" +
         "#208=IFCPROPERTYSET('0SetOfTheTests00000001',$,'P',$,(#209,#999,#208,#10));\n"
         "#209=IFCCOMPLEXPROPERTY('C',$,'u',(#209,#210));\n"
         "#210=IFCPROPERTYSINGLEVALUE('V',$,IFCINTEGER(99999999999999999999999),$);\n"
         "#211=IFCRELDEFINESBYPROPERTIES(" +
         root(211) + "(#38),#208);\n" + "#212=IFCRELDEFINESBYTYPE(" + root(212) + "(#38),#999);\n" +
         "#213=IFCRELASSOCIATESMATERIAL(" + root(213) + "(#38),#214);\n" +
         "#214=IFCMATERIALLAYERSET((#999),$,$);\n"
         "#215=IFCRELFILLSELEMENT(" +
         root(215) + "#999,#58);\n" + "#216=IFCRELCONNECTSELEMENTS(" + root(216) + "$,#38,#38);\n");
    EXPECT_EQ(values(kWall, "group"), Values{"G"});
    EXPECT_EQ(values(kWall, "material"), Values{});
    EXPECT_EQ(values(kWall, "assembly"), (Values{kOther, kTable}));
    EXPECT_EQ(values(kWall, "storey"), Values{"Ground"});
    EXPECT_EQ(relations().size(), 6U) << "each is a part of the two others";
}

TEST_F(IfcProperties, HostileTextsAreKeptAsTheyAre) {
    using namespace std::string_literals;
    const std::string longest(60000, 'x');
    read("#200=IFCPROPERTYSINGLEVALUE('''); DROP TABLE part; --',$,IFCLABEL('a\\X\\00b'),$);\n"
         "#201=IFCPROPERTYSINGLEVALUE('Long',$,IFCTEXT('" +
         longest + "'),$);\n" +
         "#202=IFCPROPERTYSET('0SetOfTheTests00000001',$,'<script>',$,(#200,#201));\n"
         "#203=IFCRELDEFINESBYPROPERTIES(" +
         root(203) + "(#38),#202);\n");
    EXPECT_EQ(values(kWall, "<script>.'); DROP TABLE part; --"), Values{"a\0b"s});
    EXPECT_TRUE(values(kWall, "<script>.Long") == Values{longest});
}

TEST_F(IfcProperties, AMapIsToldWhetherItIsAppliedOrNot) {
    std::string text = read_bytes(kFolder + "house_4.ifc");
    text.insert(text.rfind("ENDSEC;"),
                "#80=IFCPROJECTEDCRS('EPSG:28992',$,$,$,$,$,#81);\n"
                "#81=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"
                "#82=IFCMAPCONVERSION(#14,#80,155000.,463000.,12.,0.,1.,0.001);\n");
    const std::string file = folder_.file("map.ifc", text);
    const Scene on_map = read_scene(file);
    const Scene plain = read_scene(file, {.map = false});
    EXPECT_EQ(on_map.map_from_project, plain.map_from_project);
    EXPECT_EQ(on_map.map_from_project, Transform({0, 1, 0, -1, 0, 0, 0, 0, 1, 155000, 463000, 12}));
}

TEST_F(IfcProperties, GlbKeepsThem) {
    read("#200=IFCSYSTEM('0SystemOfTheTests00001',$,'A',$,$);\n"
         "#201=IFCSYSTEM('0SystemOfTheTests00002',$,'B',$,$);\n"
         "#202=IFCRELASSIGNSTOGROUP(" +
         root(202) + "(#58),$,#201);\n" + "#203=IFCRELASSIGNSTOGROUP(" + root(203) +
         "(#58),$,#200);\n" +
         "#204=IFCPROPERTYSINGLEVALUE('A.B \"C\"',$,IFCREAL(0.10),$);\n"
         "#205=IFCPROPERTYSET('0SetOfTheTests00000001',$,'P',$,(#204));\n"
         "#206=IFCRELDEFINESBYPROPERTIES(" +
         root(206) + "(#38),#205);\n");
    EXPECT_EQ(values(kWall, "P.A.B \"C\""), Values{"0.10"});
    const std::string path = folder_.path("house.glb");
    write_glb(scene_, path);
    const Scene again = read_scene(path);
    ASSERT_EQ(again.parts.size(), scene_.parts.size());
    for (std::uint32_t i = 0; i < again.parts.size(); ++i) {
        const auto pairs = [](const Scene& scene, std::uint32_t part) {
            std::vector<std::pair<std::string, std::string>> result;
            for (const auto& [name, value] : scene.properties.of(part))
                result.emplace_back(scene.properties.names[name], scene.properties.values[value]);
            return result;
        };
        EXPECT_EQ(again.parts[i].id, scene_.parts[i].id);
        EXPECT_EQ(pairs(again, i), pairs(scene_, i));
    }
}

/// web-ifc keeps the length of a text in 16 bits.
TEST_F(IfcProperties, TextsOfAnyLengthAreWhole) {
    const auto times = [](int count, const std::string& text) {
        std::string result;
        for (int i = 0; i < count; ++i)
            result += text;
        return result;
    };
    const std::string unit = R"(a''b\\c\S\i\S\'\X\E9\X2\00E903B1\X0\(#38);)";
    const Values texts{R"(\S\' 60)", // its quote does not end the text
                       times(2000, unit),
                       R"(\X2\)" + times(20000, "D83DDE00") + R"(\X0\)",
                       std::string(65535, 'x'),
                       std::string(65536, 'y'),
                       times(40000, "''")};
    std::string lines = "/* A comment's quote ' */", list;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const std::string number = std::string("#").append(std::to_string(300 + i));
        lines += number + "=IFCPROPERTYSINGLEVALUE('P" + std::to_string(i) + "',$,IFCTEXT('" +
                 texts[i] + "'),$);\n";
        list += (i > 0 ? "," : "") + number;
    }
    const std::string long_name = std::string(70000, 'n');
    read(lines + "#400=IFCPROPERTYSET('0SetOfTheTests00000001',$,'Set',$,(" + list + "));\n" +
         "#401=IFCRELDEFINESBYPROPERTIES(" + root(401) + "(#58),#400);\n" +
         "#402=IFCRELASSOCIATESMATERIAL(" + root(402) + "(#58),#403);\n#403=IFCMATERIAL('" +
         long_name + "',$,$);\n");
    EXPECT_EQ(values(kTable, "Set.P0"), Values{"\u00A7 60"});
    EXPECT_EQ(values(kTable, "Set.P1"),
              Values{times(2000, "a'b\\c\u00E9\u00A7\u00E9\u00E9\u03B1(#38);")});
    EXPECT_EQ(values(kTable, "Set.P2"), Values{times(20000, "\U0001F600")});
    EXPECT_EQ(values(kTable, "Set.P3"), Values{texts[3]});
    EXPECT_EQ(values(kTable, "Set.P4"), Values{texts[4]});
    EXPECT_EQ(values(kTable, "Set.P5"), Values{std::string(40000, '\'')});
    EXPECT_EQ(values(kTable, "material"), Values{long_name});
    EXPECT_EQ(values(kWall, "storey"), Values{"Ground"});
}

} // namespace
} // namespace abut::test
