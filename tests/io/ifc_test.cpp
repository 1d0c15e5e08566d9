// IFC 2x3 and 4 through web-ifc. Skipped without Node.js or web-ifc.

#include "tests/io/ifc_folder.h"
#include "tests/io/support.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace abut::test {
namespace {

std::vector<std::array<Vec3, 3>> triangles_of(const Scene& scene, const Part& part) {
    Scene alone;
    alone.meshes = scene.meshes;
    alone.parts = {part};
    return world_triangles(alone);
}

/// The volume enclosed by closed triangles: a sixth of the sum of their triple products.
double volume_of(const Scene& scene, const Part& part) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles_of(scene, part))
        sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
               a.z * (b.x * c.y - b.y * c.x);
    return sum / 6;
}

/// The bounding box of a part.
Box3 bounds_of(const Scene& scene, const Part& part) {
    Box3 box;
    for (const auto& triangle : triangles_of(scene, part))
        for (const Vec3& p : triangle) {
            box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                         std::min(box.lower.z, p.z)};
            box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                         std::max(box.upper.z, p.z)};
        }
    return box;
}

/// web-ifc keeps geometry as floats around its centre, with errors of about 1e-7 of its size.
void expect_box(const Box3& box, const Vec3& lower, const Vec3& upper) {
    constexpr double kAccuracy = 5e-7;
    EXPECT_NEAR(box.lower.x, lower.x, kAccuracy);
    EXPECT_NEAR(box.lower.y, lower.y, kAccuracy);
    EXPECT_NEAR(box.lower.z, lower.z, kAccuracy);
    EXPECT_NEAR(box.upper.x, upper.x, kAccuracy);
    EXPECT_NEAR(box.upper.y, upper.y, kAccuracy);
    EXPECT_NEAR(box.upper.z, upper.z, kAccuracy);
}

class Ifc : public testing::Test {
protected:
    void SetUp() override {
        try {
            (void)read_scene(kFolder + "house_2x3.ifc");
        } catch (const Error& error) {
            if (error.code() == ErrorCode::unsupported)
                GTEST_SKIP() << error.what();
        }
    }
    static std::map<std::string, Part> by_id(const Scene& scene) {
        std::map<std::string, Part> parts;
        for (const Part& part : scene.parts)
            parts.emplace(part.id, part);
        return parts;
    }
    TemporaryFolder folder_;
};

TEST_F(Ifc, House2x3) {
    const Scene scene = read_scene(kFolder + "house_2x3.ifc");
    ASSERT_EQ(scene.parts.size(), 5U);
    EXPECT_EQ(scene.meshes.size(), 3U);
    const auto parts = by_id(scene);
    const Part& wall = parts.at("1WallOfTheTests0000001");
    EXPECT_EQ(wall.name, "South wall");
    EXPECT_EQ(wall.type, "IfcWallStandardCase");
    EXPECT_EQ(scene.meshes[wall.mesh].triangles.size(), 12U);
    EXPECT_EQ(scene.meshes[wall.mesh].positions.size(), 8U); // each vertex is stored once
    EXPECT_EQ(scene.up, UpAxis::z);
    EXPECT_EQ(scene.unit, 1);
    EXPECT_TRUE(scene.notes.empty());
    expect_box(bounds_of(scene, wall), {0, 0, 0}, {4, 0.2, 3});
    // A wall of the same shape shares the mesh; one with a hole does not.
    const Part& plain = parts.at("1WallOfTheTests0000002");
    EXPECT_EQ(plain.mesh, wall.mesh);
    expect_box(bounds_of(scene, plain), {0, 5, 0}, {4, 5.2, 3});
    const Part& holed = parts.at("1WallOfTheTests0000003");
    EXPECT_NE(holed.mesh, wall.mesh);
    EXPECT_GE(scene.meshes[holed.mesh].triangles.size(), 28U);
    expect_box(bounds_of(scene, holed), {0, 10, 0}, {4, 10.2, 3});
    EXPECT_NEAR(volume_of(scene, wall), 4 * 0.2 * 3, 1e-6);
    EXPECT_NEAR(volume_of(scene, holed), 4 * 0.2 * 3 - 0.2, 1e-6);

    const Part& one = parts.at("1BlockOfTheTests000001");
    const Part& two = parts.at("1BlockOfTheTests000002");
    EXPECT_EQ(one.name, "Block one");
    EXPECT_EQ(two.name, "Block two");
    EXPECT_EQ(two.type, "IfcFurnishingElement");
    EXPECT_EQ(one.mesh, two.mesh);
    expect_box(bounds_of(scene, one), {1, 2, 0}, {1.5, 2.25, 1});
    // Rotated by a quarter turn about its origin at (3, 2, 0.5): x to y, y to -x.
    expect_box(bounds_of(scene, two), {2.75, 2, 0.5}, {3, 2.5, 1.5});
}

TEST_F(Ifc, House4InMillimetresWithPartsOfTwoSolids) {
    const Scene scene = read_scene(kFolder + "house_4.ifc");
    ASSERT_EQ(scene.parts.size(), 3U);
    EXPECT_EQ(scene.meshes.size(), 2U);
    const auto parts = by_id(scene);
    const Part& wall = parts.at("4WallOfTheTests0000001");
    EXPECT_EQ(wall.name, "Wänd");
    EXPECT_EQ(wall.type, "IfcWall");
    expect_box(bounds_of(scene, wall), {0, 0, 0}, {4, 0.2, 3});
    const Part& one = parts.at("4TableOfTheTests000001");
    const Part& two = parts.at("4TableOfTheTests000002");
    EXPECT_EQ(one.type, "IfcFurniture");
    EXPECT_EQ(one.mesh, two.mesh);
    EXPECT_EQ(scene.meshes[one.mesh].triangles.size(), 24U);
    expect_box(bounds_of(scene, one), {0.5, 1.7, 0}, {1.5, 2.3, 0.75});
    expect_box(bounds_of(scene, two), {2.7, 1.5, 1}, {3.3, 2.5, 1.75});
}

TEST_F(Ifc, PartsHaveTheColourOfTheirStyle) {
    // Items 34: the wall; 43 and 47: leg and top of the tables, of equal numbers of triangles.
    const auto colours = [&](const std::vector<std::array<std::string, 3>>& styles) {
        std::string lines;
        int line = 80;
        for (const auto& [item, rgb, transparency] : styles) {
            lines += fmt::format("#{}=IFCCOLOURRGB($,{});\n"
                                 "#{}=IFCSURFACESTYLERENDERING(#{},{},$,$,$,$,$,$,.FLAT.);\n"
                                 "#{}=IFCSURFACESTYLE($,.BOTH.,(#{}));\n",
                                 line, rgb, line + 1, line, transparency, line + 2, line + 1);
            if (!item.empty())
                lines += fmt::format("#{}=IFCSTYLEDITEM(#{},(#{}),$);\n", line + 3, item, line + 2);
            line += 4;
        }
        std::string text = read_bytes(kFolder + "house_4.ifc");
        text.insert(text.rfind("ENDSEC;"), lines);
        const auto parts = by_id(read_scene(folder_.file("styled.ifc", text)));
        std::vector<std::string> result;
        for (const char* const id : {"4WallOfTheTests0000001", "4TableOfTheTests000001"}) {
            const auto& colour = parts.at(id).colour;
            result.push_back(colour ? to_string(*colour) : "none");
        }
        return result;
    };
    using Texts = std::vector<std::string>;
    EXPECT_EQ(colours({}), (Texts{"none", "none"}));
    EXPECT_EQ(colours({{"34", "0.2,0.4,0.6", "0.5"}}), (Texts{"#33669980", "none"}));
    EXPECT_EQ(
        colours({{"34", "0.2,0.4,0.6", "$"}, {"43", "1.,0.,0.", "0."}, {"47", "0.,1.,0.", "0."}}),
        (Texts{"#336699", "#ff0000"}));
    EXPECT_EQ(colours({{"34", "1.,1.,1.", "0."}, {"43", "0.,0.,0.", "0."}})[0], "#ffffff");
    EXPECT_EQ(colours({{"34", "-1.,2.,0.6", "7."}})[0], "#00ff9900");
}

TEST_F(Ifc, OnlyAPathOverridesUnitAndAxes) {
    const char* const wall = "1WallOfTheTests0000001";
    ReadOptions options;
    options.unit = 1000;
    options.up = UpAxis::x;
    const Scene plain = read_scene(kFolder + "house_2x3.ifc", options);
    EXPECT_EQ(plain.up, UpAxis::z);
    EXPECT_NEAR(bounds_of(plain, by_id(plain).at(wall)).upper.x, 4, 1e-6);
    const Scene scene = read_scene(ModelPath{kFolder + "house_2x3.ifc", 1000, UpAxis::y}, options);
    EXPECT_EQ(scene.up, UpAxis::y);
    EXPECT_EQ(scene.unit, 1000);
    EXPECT_NEAR(bounds_of(scene, by_id(scene).at(wall)).upper.x, 4000, 1e-3);
    EXPECT_NEAR(bounds_of(scene, by_id(scene).at(wall)).upper.z, 3000, 1e-3);
    // The file is in millimetres; taken as metres everything is 1000 times as large.
    const Scene large = read_scene(ModelPath{kFolder + "house_4.ifc", 1});
    EXPECT_NEAR(bounds_of(large, by_id(large).at("4WallOfTheTests0000001")).upper.x, 4000, 1e-3);
}

/// The text of a file with replacements.
std::string changed(const std::string& file,
                    const std::vector<std::pair<std::string, std::string>>& replacements) {
    std::string text = read_bytes(kFolder + file);
    for (const auto& [from, to] : replacements) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        if (at != std::string::npos)
            text.replace(at, from.size(), to);
    }
    return text;
}

TEST_F(Ifc, AProductThatItsOpeningCutsAwayHasANote) {
    // The opening of 1 x 1 becomes 9 x 9, from below the wall on.
    const Scene scene = read_scene(folder_.file(
        "gone.ifc", changed("house_2x3.ifc", {{"#101,1.,1.)", "#101,9.,9.)"},
                                              {"#103=IFCCARTESIANPOINT((0.,0.,1.))",
                                               "#103=IFCCARTESIANPOINT((0.,0.,-1.))"},
                                              {"(#102,#104,#11,1.)", "(#102,#104,#11,9.)"}})));
    EXPECT_EQ(scene.parts.size(), 4U);
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_EQ(scene.notes[0].kind, NoteKind::cut_away);
    EXPECT_EQ(scene.notes[0].id, "1WallOfTheTests0000003");
    EXPECT_EQ(scene.notes[0].name, "Wall with hole");
    EXPECT_EQ(scene.notes[0].type, "IfcWallStandardCase");
    EXPECT_FALSE(scene.notes[0].text.empty());
}

TEST_F(Ifc, AProductThatCannotBeBuiltHasANote) {
    // The south wall's profile, which two other walls share, gets zero size.
    const Scene scene = read_scene(
        folder_.file("flat.ifc", changed("house_2x3.ifc", {{"#32,4.,0.2)", "#32,0.,0.)"}})));
    EXPECT_EQ(scene.parts.size(), 2U);
    std::map<std::string, NoteKind> notes;
    for (const SceneNote& note : scene.notes)
        notes.emplace(note.id, note.kind);
    EXPECT_EQ(notes.size(), 3U);
    EXPECT_EQ(notes.at("1WallOfTheTests0000001"), NoteKind::not_built);
    EXPECT_EQ(notes.at("1WallOfTheTests0000002"), NoteKind::not_built);
}

TEST_F(Ifc, APartThatLacksOneOfItsShapesHasANote) {
    // The table's top gets zero size.
    const Scene scene = read_scene(
        folder_.file("legs.ifc", changed("house_4.ifc", {{"#41,1000.,600.)", "#41,0.,0.)"}})));
    EXPECT_EQ(scene.parts.size(), 3U);
    ASSERT_EQ(scene.notes.size(), 2U);
    for (const SceneNote& note : scene.notes) {
        EXPECT_EQ(note.kind, NoteKind::not_built);
        EXPECT_EQ(note.type, "IfcFurniture");
        EXPECT_TRUE(contains(note.text, "of its 2 shapes 1 ")) << note.text;
    }
}

TEST_F(Ifc, SpacesAndZonesAreLeftOutUnlessAskedFor) {
    const std::string file = folder_.file(
        "spaces.ifc",
        changed("house_4.ifc",
                {{"#58=IFCFURNITURE('4TableOfTheTests000001',$,'Table one',$,$,#57,#54,$,$)",
                  "#58=IFCSPACE('4TableOfTheTests000001',$,'Room',$,$,#57,#54,$,"
                  ".ELEMENT.,.INTERNAL.,$)"},
                 {"#66=IFCFURNITURE('4TableOfTheTests000002',$,'Table two',$,$,#65,#62,$,$)",
                  "#66=IFCSPATIALZONE('4TableOfTheTests000002',$,'Zone',$,$,#65,#62,"
                  "$,.CONSTRUCTION.)"}}));
    const Scene scene = read_scene(file);
    ASSERT_EQ(scene.parts.size(), 1U);
    ASSERT_EQ(scene.notes.size(), 2U);
    for (const SceneNote& note : scene.notes)
        EXPECT_EQ(note.kind, NoteKind::space) << note.id;
    ReadOptions options;
    options.spaces = true;
    const Scene all = read_scene(file, options);
    EXPECT_TRUE(all.notes.empty());
    const auto parts = by_id(all);
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_EQ(parts.at("4TableOfTheTests000001").type, "IfcSpace");
    EXPECT_EQ(parts.at("4TableOfTheTests000001").name, "Room");
    EXPECT_EQ(parts.at("4TableOfTheTests000002").type, "IfcSpatialZone");
    expect_box(bounds_of(all, parts.at("4TableOfTheTests000001")), {0.5, 1.7, 0}, {1.5, 2.3, 0.75});
}

TEST_F(Ifc, ZeroAreaTrianglesCloseSurfaces) {
    // A box of 2 x 1 x 1 m. Its lower front edge has a vertex (9) in the middle on one side only; a
    // zero-area triangle (1 9 2) closes the gap.
    const std::string set =
        "#34=IFCTRIANGULATEDFACESET(#900,$,.T.,((1,3,2),(1,4,3),(5,6,7),(5,7,8),(1,9,5),(9,6,5),"
        "(9,2,6),(1,2,9),(2,3,7),(2,7,6),(3,4,8),(3,8,7),(4,1,5),(4,5,8)),$);\n"
        "#900=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2000.,0.,0.),(2000.,1000.,0.),(0.,1000.,0.),"
        "(0.,0.,1000.),(2000.,0.,1000.),(2000.,1000.,1000.),(0.,1000.,1000.),(1000.,0.,0.)));";
    const Scene scene = read_scene(
        folder_.file("box.ifc", changed("house_4.ifc",
                                        {{"#34=IFCEXTRUDEDAREASOLID(#33,#13,#11,3000.);", set}})));
    const Part& wall = by_id(scene).at("4WallOfTheTests0000001");
    EXPECT_EQ(scene.meshes[wall.mesh].positions.size(), 9U);
    EXPECT_EQ(scene.meshes[wall.mesh].triangles.size(), 14U);
    const MeshReport report = inspect(scene.meshes[wall.mesh]);
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.degenerate_triangles, 1U);
    EXPECT_EQ(report.flipped_edges, 0U);
    EXPECT_TRUE(scene.notes.empty());
}

TEST_F(Ifc, ASolidWhoseSurfaceIsOpenHasANote) {
    const std::string set =
        "#34=IFCTRIANGULATEDFACESET(#900,$,.T.,((1,3,2),(1,2,4),(2,3,4)),$);\n"
        "#900=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2000.,0.,0.),(2000.,1000.,0.),"
        "(0.,0.,1000.)));";
    const Scene scene = read_scene(
        folder_.file("open.ifc", changed("house_4.ifc",
                                         {{"#34=IFCEXTRUDEDAREASOLID(#33,#13,#11,3000.);", set}})));
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_EQ(scene.notes[0].kind, NoteKind::open);
    EXPECT_EQ(scene.notes[0].id, "4WallOfTheTests0000001");
    EXPECT_TRUE(contains(scene.notes[0].text, "3 edges")) << scene.notes[0].text;
}

TEST_F(Ifc, ASiteFarFromTheOriginKeepsItsPrecision) {
    // In millimetres: the site lies at (155,000.1234, 463,000.5678, 12.5) m.
    const Scene scene = read_scene(folder_.file(
        "far.ifc",
        changed("house_4.ifc", {{"#20=IFCLOCALPLACEMENT($,#13);",
                                 "#900=IFCCARTESIANPOINT((155000123.4,463000567.8,12500.));\n"
                                 "#901=IFCAXIS2PLACEMENT3D(#900,#11,#12);\n"
                                 "#20=IFCLOCALPLACEMENT($,#901);"}})));
    const auto parts = by_id(scene);
    const Vec3 at{155000.1234, 463000.5678, 12.5};
    expect_box(bounds_of(scene, parts.at("4WallOfTheTests0000001")), at,
               {at.x + 4, at.y + 0.2, at.z + 3});
    expect_box(bounds_of(scene, parts.at("4TableOfTheTests000002")),
               {at.x + 2.7, at.y + 1.5, at.z + 1}, {at.x + 3.3, at.y + 2.5, at.z + 1.75});
}

TEST_F(Ifc, ThePrecisionIsInTheUnitOfTheFile) {
    const auto stated = [&](const std::string& precision) {
        const std::string contexts =
            "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3," + precision + ",#13,$)";
        return read_scene(
                   folder_.file("p.ifc", changed("house_4.ifc",
                                                 {{"IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,"
                                                   "1.E-05,#13,$)",
                                                   contexts}})))
            .precision.stated;
    };
    EXPECT_DOUBLE_EQ(stated("0.01"), 1e-5);
    EXPECT_DOUBLE_EQ(stated("1.E-05"), 1e-8);
    EXPECT_DOUBLE_EQ(stated("1."), 1e-3);
    // None, or one that cannot be meant in this unit: a precision of 2 mm, or of nothing.
    for (const char* const none : {"$", "0.", "-1.", "2."})
        EXPECT_EQ(stated(none), 1e-5) << none;
    const ModelPrecision of_metres = read_scene(kFolder + "house_2x3.ifc").precision;
    EXPECT_TRUE(of_metres.single_meshes);
    EXPECT_FALSE(of_metres.single_transforms);
    // A unit that is given instead of the file's applies to the precision, too.
    const Scene scaled = read_scene(ModelPath{kFolder + "house_4.ifc", 1.0});
    EXPECT_DOUBLE_EQ(scaled.precision.stated, 1e-5);
    // The largest of the contexts for shapes in space.
    const Scene several = read_scene(folder_.file(
        "s.ifc", changed("house_4.ifc", {{"#14=IFCGEOMETRICREPRESENTATIONCONTEXT",
                                          "#910=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Plan',2,0.5,"
                                          "#13,$);\n#911=IFCGEOMETRICREPRESENTATIONCONTEXT($,"
                                          "'Model',3,0.02,#13,$);\n"
                                          "#14=IFCGEOMETRICREPRESENTATIONCONTEXT"}})));
    EXPECT_DOUBLE_EQ(several.precision.stated, 2e-5);
}

/// house_4.ifc, which is in millimetres, with a map conversion.
///
/// In          unit: unit of the map, as a STEP entity or $; numbers: arguments from Eastings on.
std::string on_map(const std::string& unit, const std::string& numbers) {
    const std::string reference = unit == "$" ? "$" : "#900";
    return changed("house_4.ifc",
                   {{"ENDSEC;\nEND", (unit == "$" ? "" : "#900=" + unit + ";\n") +
                                         "#901=IFCPROJECTEDCRS('EPSG:28992',$,$,$,$,$," +
                                         reference + ");\n#902=IFCMAPCONVERSION(#14,#901," +
                                         numbers + ");\nENDSEC;\nEND"}});
}

const std::string kMetre = "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)";
constexpr const char* kWallId = "4WallOfTheTests0000001"; // from (0, 0, 0) to (4, 0.2, 3) m

/// The corners of a box from (0, 0, 0) to `size`, rotated about z and moved.
std::vector<Vec3> placed_box(const Vec3& size, const Vec3& offset, double cosine, double sine) {
    std::vector<Vec3> corners;
    for (const double x : {0.0, size.x})
        for (const double y : {0.0, size.y})
            for (const double z : {0.0, size.z})
                corners.push_back({offset.x + cosine * x - sine * y,
                                   offset.y + sine * x + cosine * y, offset.z + z});
    return corners;
}

/// Expects each corner to be a vertex of the part, within a micrometre.
void expect_corners(const Scene& scene, const Part& part, const std::vector<Vec3>& corners) {
    for (const Vec3& corner : corners) {
        double nearest = 1e300;
        for (const auto& triangle : triangles_of(scene, part))
            for (const Vec3& p : triangle)
                nearest =
                    std::min(nearest, std::hypot(p.x - corner.x, p.y - corner.y, p.z - corner.z));
        EXPECT_LT(nearest, 1e-6) << corner.x << " " << corner.y << " " << corner.z;
    }
}

TEST_F(Ifc, AProjectLiesOnItsMap) {
    // Rotated by 30 degrees, 5,000 km from the map's origin.
    const std::string numbers = "155000.1234,5463000.5678,-1.5,0.8660254037844387,0.5,0.001";
    const std::string file = folder_.file("map.ifc", on_map(kMetre, numbers));
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.unit, 0.001);
    expect_corners(
        scene, by_id(scene).at(kWallId),
        placed_box({4, 0.2, 3}, {155000.1234, 5463000.5678, -1.5}, std::sqrt(0.75), 0.5));
    const auto parts = by_id(scene);
    EXPECT_EQ(parts.at("4TableOfTheTests000001").mesh, parts.at("4TableOfTheTests000002").mesh);
    ReadOptions options;
    options.map = false;
    const Scene plain = read_scene(file, options);
    expect_box(bounds_of(plain, by_id(plain).at(kWallId)), {0, 0, 0}, {4, 0.2, 3});
    // Only the transforms differ from the file without a map.
    ASSERT_EQ(plain.meshes.size(), scene.meshes.size());
    for (std::size_t i = 0; i < plain.meshes.size(); ++i)
        EXPECT_TRUE(std::equal(plain.meshes[i].positions.begin(), plain.meshes[i].positions.end(),
                               scene.meshes[i].positions.begin(), [](const Vec3& a, const Vec3& b) {
                                   return a.x == b.x && a.y == b.y && a.z == b.z;
                               }));
}

TEST_F(Ifc, UnitsAndScalesOfAMapAreApplied) {
    const std::string foot = "IFCCONVERSIONBASEDUNIT(#910,.LENGTHUNIT.,'FOOT',#911);\n"
                             "#910=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n"
                             "#911=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048),#912);\n#912=" +
                             kMetre;
    struct Case {
        std::string unit, numbers;
        double scale;
    };
    for (const Case& each : std::vector<Case>{
             {kMetre, "1000.,2000.,30.,$,$,0.001", 1},          // as IFC 4 has it
             {kMetre, "1000.,2000.,30.,$,$,0.0009996", 0.9996}, // with that of the projection
             {kMetre, "1000.,2000.,30.,$,$,$", 1},              // Revit
             {kMetre, "1000.,2000.,30.,1.,0.,1.", 1},           // the ratio of the units left out
             {"$", "1000000.,2000000.,30000.,$,$,$", 1},        // the project's unit
             {"$", "1000.,2000.,30.,$,$,0.001", 1},             // metres, by the scale
             {foot,
              "3280.8398950131236,6561.679790026247,98.4251968503937,$,$,0.0032808398950131233",
              1}}) {
        SCOPED_TRACE(each.unit + " " + each.numbers);
        const Scene scene = read_scene(folder_.file("map.ifc", on_map(each.unit, each.numbers)));
        expect_box(bounds_of(scene, by_id(scene).at(kWallId)), {1000, 2000, 30},
                   {1000 + 4 * each.scale, 2000 + 0.2 * each.scale, 30 + 3 * each.scale});
    }
}

TEST_F(Ifc, FilesWithDifferentMapConversionsMeet) {
    // The same wall in two projects: at the origin of one, and at (100, 50) m and rotated in the
    // other.
    const Scene one =
        read_scene(folder_.file("one.ifc", on_map(kMetre, "155000.,5463000.,12.,1.,0.,0.001")));
    std::string text = on_map(kMetre, "154950.,5463100.,2.,6.123233995736766E-17,-1.,0.001");
    const std::string placement = "#20=IFCLOCALPLACEMENT($,#13);";
    text.replace(text.find(placement), placement.size(),
                 "#920=IFCCARTESIANPOINT((100000.,50000.,10000.));\n"
                 "#921=IFCAXIS2PLACEMENT3D(#920,#11,#50);\n#20=IFCLOCALPLACEMENT($,#921);");
    const Scene other = read_scene(folder_.file("other.ifc", text));
    const auto others = by_id(other);
    const Part& part = others.at(kWallId);
    expect_box(bounds_of(other, part), {155000, 5463000, 12}, {155004, 5463000.2, 15});
    // A cosine of 6e-17 counts as zero.
    const auto parts = by_id(one);
    const auto& expected = parts.at(kWallId).world_from_mesh.m;
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(part.world_from_mesh.m.at(i), expected.at(i), 1e-15);
    for (std::size_t i = 9; i < 12; ++i)
        EXPECT_NEAR(part.world_from_mesh.m.at(i), expected.at(i), 4e-9); // rounding at 5,000 km
}

TEST_F(Ifc, TheMapOfIfc2x3IsInPropertySets) {
    const std::string end = "ENDSEC;\nEND";
    const std::string sets =
        "#900=IFCPROPERTYSINGLEVALUE('Eastings',$,IFCLENGTHMEASURE(155000.5),$);\n"
        "#901=IFCPROPERTYSINGLEVALUE('Northings',$,IFCLENGTHMEASURE(5463000.25),$);\n"
        "#902=IFCPROPERTYSINGLEVALUE('OrthogonalHeight',$,IFCLENGTHMEASURE(7.),$);\n"
        "#903=IFCPROPERTYSINGLEVALUE('XAxisAbscissa',$,IFCREAL(0.),$);\n"
        "#904=IFCPROPERTYSINGLEVALUE('XAxisOrdinate',$,IFCREAL(1.),$);\n"
        "#905=IFCPROPERTYSET('0SetOfTheTests00000001',$,'ePSet_MapConversion',$,"
        "(#900,#901,#902,#903,#904));\n"
        "#906=IFCPROPERTYSINGLEVALUE('MapUnit',$,IFCIDENTIFIER('METRE'),$);\n"
        "#907=IFCPROPERTYSET('0SetOfTheTests00000002',$,'ePSet_ProjectedCRS',$,(#906));\n";
    const Scene scene =
        read_scene(folder_.file("map.ifc", changed("house_2x3.ifc", {{end, sets + end}})));
    // x becomes y, and y becomes -x.
    expect_box(bounds_of(scene, by_id(scene).at("1WallOfTheTests0000001")),
               {155000.3, 5463000.25, 7}, {155000.5, 5463004.25, 10});
}

TEST_F(Ifc, AMapThatMakesNoSenseIsRefused) {
    for (const char* const numbers :
         {"0.,0.,0.,$,$,7.", "0.,0.,0.,$,$,-0.001", "0.,0.,0.,$,$,0.", "0.,0.,0.,0.,0.,0.001",
          "0.,0.,0.,$,$,0.001);\n#903=IFCMAPCONVERSION(#14,#901,1.,0.,0.,$,$,0.001"}) {
        const std::string file = folder_.file("map.ifc", on_map(kMetre, numbers));
        EXPECT_TRUE(contains(error_of(file, ErrorCode::malformed), "map conversion")) << numbers;
        ReadOptions options;
        options.map = false;
        EXPECT_EQ(read_scene(file, options).parts.size(), 3U);
    }
    // The same conversion twice is no contradiction. That of a 2D drawing context does not apply to
    // the project.
    EXPECT_EQ(read_scene(
                  folder_.file(
                      "map.ifc",
                      on_map(kMetre, "9.,0.,0.,$,$,0.001);\n#903="
                                     "IFCMAPCONVERSION(#14,#901,9.,0.,0.,$,$,0.001);\n"
                                     "#904=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Plan',2,$,#13,$);\n"
                                     "#905=IFCMAPCONVERSION(#904,#901,1.,0.,0.,$,$,0.001")))
                  .parts.size(),
              3U);
}

TEST_F(Ifc, AShapeFarFromItsOriginKeepsItsPrecision) {
    // A tetrahedron whose own coordinates are map coordinates in millimetres.
    const std::string set =
        "#34=IFCTRIANGULATEDFACESET(#900,$,.T.,((1,3,2),(1,2,4),(2,3,4),(3,1,4)),$);\n"
        "#900=IFCCARTESIANPOINTLIST3D(((155000000.123,463000000.456,12000.),(155002000.123,"
        "463000000.456,12000.),(155000000.123,463001000.456,12000.),(155000000.123,463000000.456,"
        "13000.)));";
    const Scene scene = read_scene(
        folder_.file("far.ifc", changed("house_4.ifc",
                                        {{"#34=IFCEXTRUDEDAREASOLID(#33,#13,#11,3000.);", set}})));
    expect_box(bounds_of(scene, by_id(scene).at("4WallOfTheTests0000001")),
               {155000.000123, 463000.000456, 12}, {155002.000123, 463001.000456, 13});
}

TEST_F(Ifc, ATruncatedFileIsRefused) {
    const std::string content = read_bytes(kFolder + "house_4.ifc");
    const std::size_t end = content.find_last_not_of(" \n") + 1;
    for (const std::size_t size : {std::size_t{5}, std::size_t{200}, end / 2, end - 30, end - 1})
        error_of(folder_.file("cut.ifc", content.substr(0, size)), ErrorCode::malformed);
}

TEST_F(Ifc, OtherContentIsRefused) {
    error_of(folder_.file("garbage.ifc", std::string(5000, 'x')), ErrorCode::malformed);
    const std::string frame = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('";
    const std::string rest = "'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
    error_of(folder_.file("empty.ifc", frame + "IFC4" + rest), ErrorCode::bad_mesh);
    error_of(folder_.file("machine.ifc", frame + "AP203" + rest), ErrorCode::unsupported);
}

TEST_F(Ifc, ItsReaderIsIsolatedToo) {
    const std::string file = kFolder + "house_4.ifc";
    {
        const Environment node("ABUT_NODE", folder_.script("node", "kill -SEGV $$\n"));
        EXPECT_TRUE(contains(error_of(file, ErrorCode::reader_failed), "crashed"));
    }
    {
        ReadOptions options;
        options.time_limit = 0.25;
        const Environment node("ABUT_NODE", folder_.script("node", "exec sleep 1000\n"));
        EXPECT_TRUE(contains(error_of(file, ErrorCode::reader_failed, options), "stopped"));
    }
    ReadOptions options;
    options.memory_limit = std::uint64_t{20} << 20; // less than Node.js itself needs
    EXPECT_TRUE(contains(error_of(file, ErrorCode::reader_failed, options), "memory"));
}

TEST(IfcConverter, AMissingConverterIsExplained) {
    const TemporaryFolder folder;
    const std::string file = kFolder + "house_4.ifc";
    std::filesystem::create_directories(folder.path("converter/node_modules/web-ifc"));
    (void)folder.file("converter/convert.mjs", "");
    const Environment converter("ABUT_IFC_CONVERTER", folder.path("converter"));
    {
        const Environment path("PATH", folder.path("empty"));
        const Environment node("ABUT_NODE", "");
        const std::string text = error_of(file, ErrorCode::unsupported);
        EXPECT_TRUE(contains(text, "apt-get install nodejs npm")) << text;
        EXPECT_TRUE(contains(text, "npm ci")) << text;
    }
    std::filesystem::remove_all(folder.path("converter/node_modules"));
    const Environment node("ABUT_NODE", folder.script("node", "exit 0\n"));
    const std::string text = error_of(file, ErrorCode::unsupported);
    EXPECT_TRUE(contains(text, "npm ci")) << text;
    EXPECT_TRUE(contains(text, folder.path("converter"))) << text;
}

} // namespace
} // namespace abut::test
