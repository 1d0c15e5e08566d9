#include <abut/clash.h>
#include <abut/error.h>

#include "clash/report/clash_text.h"
#include "clash/report/json_lines.h"
#include "clash/report/report_page.h"
#include "tests/support/folder.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"

#include <bit>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

namespace abut {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Part make_part(const std::string& id, const std::string& name, const std::string& type) {
    Part part;
    part.id = id;
    part.name = name;
    part.type = type;
    return part;
}

/// Two model files with two parts each, and a clash of every kind.
struct Sample {
    std::vector<Scene> models;
    ClashReport report;

    Sample() {
        Scene structure;
        structure.file = "models/structure.glb";
        structure.parts = {make_part("0wall", "Wall 1", "IfcWall"),
                           make_part("1slab", "Slab 2", "IfcSlab")};
        Scene pipes;
        pipes.file = "models/pipes.glb";
        pipes.parts = {make_part("2pipe", "Pipe 3", "IfcFlowSegment"),
                       make_part("3bend", "3bend", "")};
        models = {structure, pipes};
        report.models = {{structure.file, 2, 24}, {pipes.file, 2, 1000}};
        report.models[1].unit = 0.001;
        report.models[1].up = UpAxis::z;
        report.models[1].notes = {{NoteKind::cut_away, "id \"3\"", "<wall>", "IfcWall", "is gone"}};
        report.frame = {UpAxis::z, structure.file};
        report.warnings = {"the boxes of a and b are 2 km apart"};
        report.clearance = 0.05;
        report.touch_tolerance = 1e-9;
        report.candidates = 17;
        report.seconds = {0.5, 0.25, 0.125, 0.0625, 1};
        report.peak_rss_mib = 123.4;
        for (const ClashKind kind : kClashKinds) {
            Clash clash;
            clash.id = 0xABCULL + static_cast<std::uint64_t>(kind);
            clash.kind = kind;
            clash.model = {0, 1};
            clash.part = {1, 0};
            clash.distance = -0.1 - 0.2;
            clash.point_a = {1.0 / 3, -2, 1e-300};
            clash.point_b = {4e20, 5.5, -0.0};
            clash.direction = {0, 0, 1};
            clash.triangle_pairs = 42;
            report.clashes.push_back(clash);
            ++report.counts[static_cast<std::size_t>(kind)];
        }
    }
};

/// A fixture with a folder that is removed when the test ends.
class ClashWriters : public testing::Test {
protected:
    [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string read(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }

    test::Folder folder_;
};

std::vector<std::string> keys(const ordered_json& object) {
    std::vector<std::string> names;
    for (const auto& item : object.items())
        names.push_back(item.key());
    return names;
}

/// Parses CSV strictly by RFC 4180. An empty result means a syntax error.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
    std::vector<std::vector<std::string>> rows(1, {""});
    for (std::size_t i = 0; i < text.size();) {
        std::string& cell = rows.back().back();
        if (text[i] == '"') {
            for (++i; i < text.size(); ++i) {
                if (text[i] == '"' && (i + 1 == text.size() || text[i + 1] != '"'))
                    break;
                if (text[i] == '"')
                    ++i;
                cell += text[i];
            }
            ++i;
        } else {
            while (i < text.size() && text.find_first_of("\",\r\n", i) != i)
                cell += text[i++];
        }
        if (text.compare(i, 2, "\r\n") == 0) {
            rows.push_back({""});
            i += 2;
        } else if (i < text.size() && text[i] == ',') {
            rows.back().emplace_back();
            ++i;
        } else {
            return {};
        }
    }
    rows.pop_back();
    return rows;
}

TEST_F(ClashWriters, KindsHaveTheirNames) {
    std::vector<std::string> names;
    names.reserve(kClashKinds.size());
    for (const ClashKind kind : kClashKinds)
        names.emplace_back(to_string(kind));
    EXPECT_EQ(names, (std::vector<std::string>{"hard", "touch", "contained", "duplicate",
                                               "clearance", "undecided"}));
}

TEST_F(ClashWriters, JsonHasTheKeysInOrder) {
    const Sample sample;
    const ordered_json root = ordered_json::parse(to_json(sample.report, sample.models));
    using Names = std::vector<std::string>;
    EXPECT_EQ(keys(root), (Names{"models", "frame", "warnings", "clearance", "touch", "touch_least",
                                 "touch_source", "touch_file", "candidates", "counts", "neighbours",
                                 "left_out", "surfaces", "clashes", "seconds", "peak_rss_mib"}));
    EXPECT_EQ(keys(root["models"][0]),
              (Names{"file", "parts", "triangles", "unit", "up", "precision", "rounding"}));
    EXPECT_EQ(keys(root["models"][1]), (Names{"file", "parts", "triangles", "unit", "up",
                                              "precision", "rounding", "notes"}));
    EXPECT_EQ(keys(root["models"][1]["notes"][0]), (Names{"kind", "id", "name", "type", "text"}));
    EXPECT_EQ(keys(root["frame"]), (Names{"up", "unit", "of"}));
    EXPECT_EQ(keys(root["counts"]),
              (Names{"hard", "touch", "contained", "duplicate", "clearance", "undecided"}));
    EXPECT_EQ(keys(root["seconds"]), (Names{"import", "build", "broad", "narrow", "total"}));
    EXPECT_EQ(keys(root["clashes"][0]),
              (Names{"id", "kind", "a", "b", "a_name", "b_name", "a_type", "b_type", "a_file",
                     "b_file", "distance", "point_a", "point_b", "direction", "triangle_pairs"}));
}

TEST_F(ClashWriters, JsonValuesReadBackAsTheyWere) {
    Sample sample;
    sample.report.clashes[1].rule = "pipes through slabs";
    const json root = json::parse(to_json(sample.report, sample.models));
    EXPECT_EQ(
        root["models"],
        json::parse(
            R"([{"file": "models/structure.glb", "parts": 2, "triangles": 24, "unit": 1, "up": "y", "precision": 0, "rounding": 0},
                              {"file": "models/pipes.glb", "parts": 2, "triangles": 1000, "unit": 0.001, "up": "z", "precision": 0, "rounding": 0,
                               "notes": [{"kind": "cut_away", "id": "id \"3\"", "name": "<wall>", "type": "IfcWall",
                                          "text": "is gone"}]}])"));
    EXPECT_EQ(root["frame"],
              json::parse(R"({"up": "z", "unit": "m", "of": "models/structure.glb"})"));
    EXPECT_EQ(root["warnings"], json::parse(R"(["the boxes of a and b are 2 km apart"])"));
    EXPECT_EQ(root["clearance"], 0.05);
    EXPECT_EQ(root["touch"], 1e-9);
    EXPECT_EQ(root["candidates"], 17);
    EXPECT_EQ(root["counts"]["duplicate"], 1);
    EXPECT_EQ(root["seconds"]["narrow"], 0.0625);
    EXPECT_EQ(root["peak_rss_mib"], 123.4);
    ASSERT_EQ(root["clashes"].size(), kClashKinds.size());
    const json& clash = root["clashes"][0];
    EXPECT_EQ(clash["id"], "0000000000000abc");
    EXPECT_EQ(clash["kind"], "hard");
    EXPECT_EQ(clash["a"], "1slab");
    EXPECT_EQ(clash["b"], "2pipe");
    EXPECT_EQ(clash["a_name"], "Slab 2");
    EXPECT_EQ(clash["b_type"], "IfcFlowSegment");
    EXPECT_EQ(clash["b_file"], "models/pipes.glb");
    EXPECT_EQ(clash["distance"].get<double>(), -0.1 - 0.2);
    EXPECT_EQ(clash["point_a"], (json{1.0 / 3, -2, 1e-300}));
    EXPECT_EQ(clash["point_b"][0].get<double>(), 4e20);
    EXPECT_TRUE(std::signbit(clash["point_b"][2].get<double>()));
    EXPECT_EQ(clash["triangle_pairs"], 42);
    EXPECT_FALSE(clash.contains("rule"));
    EXPECT_EQ(root["clashes"][1]["rule"], "pipes through slabs");
}

TEST_F(ClashWriters, NumbersAreTheShortestThatReadBack) {
    const std::vector<std::pair<double, std::string>> texts = {
        {0.05, "0.05"},
        {1, "1"},
        {0, "0"},
        {-0.0, "-0.0"},
        {-120, "-120"},
        {1e-9, "1e-09"},
        {1e-4, "0.0001"},
        {4e20, "4e+20"},
        {999999999999999, "999999999999999"},
        {-0.30000000000000004, "-0.30000000000000004"},
        {0x1.5bf0a8b145769p+1, "2.718281828459045"},
        {0x1.fffffffffffffp+1023, "1.7976931348623157e+308"},
        {kInfinity, "null"},
    };
    for (const auto& [value, text] : texts)
        EXPECT_EQ(json_number(value).dump(), text);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> coordinate(-1000, 1000);
    std::size_t finite = 0, longer = 0;
    for (int i = 0; i < 20000; ++i) {
        const double value = i % 2 == 0 ? std::bit_cast<double>(random()) : coordinate(random);
        const std::string text = json_number(value).dump();
        if (!std::isfinite(value)) {
            EXPECT_EQ(text, "null");
            continue;
        }
        ++finite;
        longer += text != fmt::format("{}", value) ? 1 : 0;
        ASSERT_EQ(json::parse(text).get<double>(), value) << "seed 4, number " << i;
    }
    std::cout << longer << " of " << finite << " differ from the shortest text\n";
    EXPECT_GT(finite, 19000U);
    EXPECT_LT(longer, finite / 100);
}

TEST_F(ClashWriters, NumbersThatAreNotFiniteAreNull) {
    Sample sample;
    sample.report.clashes[0].distance = std::numeric_limits<double>::quiet_NaN();
    sample.report.clashes[0].point_a.y = -kInfinity;
    const json clash = json::parse(to_json(sample.report, sample.models))["clashes"][0];
    EXPECT_TRUE(clash["distance"].is_null());
    EXPECT_TRUE(clash["point_a"][1].is_null());
}

/// valid_utf8 repairs the texts of CSV reports, nlohmann-json those of JSON; both must agree.
TEST_F(ClashWriters, TextIsEscapedAndRepairedAlikeByAllWriters) {
    std::mt19937 random(9);
    // Bytes at the limits of what UTF-8 allows, so that many sequences are almost valid.
    constexpr std::string_view kBytes(
        "\x00\x1F\x20\"\\</a\n\x7F\x80\x8F\x90\x9F\xA0\xBF\xC0\xC1\xC2\xDF\xE0"
        "\xE1\xED\xEE\xEF\xF0\xF1\xF4\xF5\xFF",
        29);
    int repaired = 0;
    constexpr int kRounds = 50000;
    for (int round = 0; round < kRounds; ++round) {
        std::string text;
        for (std::size_t length = random() % 7; length > 0; --length)
            text += kBytes[random() % kBytes.size()];
        JsonLines out;
        out.value(text);
        const std::string written = out.take();
        ASSERT_EQ(json::parse(written).get<std::string>(), valid_utf8(text))
            << "seed 9, round " << round;
        ASSERT_EQ(written.find('<'), std::string::npos);
        repaired += valid_utf8(text) != text ? 1 : 0;
    }
    EXPECT_GT(repaired, kRounds * 3 / 10);
    EXPECT_LT(repaired, kRounds * 9 / 10);
}

/// Line tools read reports: a member or a clash is a line.
TEST_F(ClashWriters, JsonHasAClashOnEachLine) {
    const Sample sample;
    std::istringstream text(to_json(sample.report, sample.models));
    std::size_t clashes = 0;
    for (std::string line; std::getline(text, line);)
        if (line.find("\"triangle_pairs\":") != std::string::npos) {
            line.resize(line.find_last_of('}') + 1);
            EXPECT_EQ(json::parse(line)["b"], "2pipe");
            ++clashes;
        }
    EXPECT_EQ(clashes, sample.report.clashes.size());
}

TEST_F(ClashWriters, JsonFileHoldsTheSameText) {
    const Sample sample;
    write_clash_json(sample.report, sample.models, path("report.json"));
    EXPECT_EQ(read("report.json"), to_json(sample.report, sample.models));
}

TEST_F(ClashWriters, AnEmptyReportIsWhole) {
    const ClashReport report;
    const json root = json::parse(to_json(report, {}));
    EXPECT_TRUE(root["clashes"].is_array());
    EXPECT_TRUE(root["models"].empty());
    write_clash_csv(report, {}, path("report.csv"));
    EXPECT_EQ(parse_csv(read("report.csv")).size(), 1U);
    write_clash_html(report, {}, path("report.html"));
    EXPECT_NE(read("report.html").find("</html>"), std::string::npos);
}

/// The columns from `distance` to `point_b_z`, and the volume.
std::vector<std::string> csv_lengths(const std::vector<std::string>& row) {
    std::vector<std::string> cells(row.begin() + 10, row.begin() + 17);
    cells.push_back(row.at(23));
    return cells;
}

TEST_F(ClashWriters, CsvHasNoDigitsThatRoundingMade) {
    Sample sample;
    using Row = std::vector<std::string>;
    Clash& doubles = sample.report.clashes[0];
    doubles.rounding = 1e-15;
    doubles.distance = -0.1 - 0.2;
    doubles.point_a = {1.2000000000000002, -7e-17, 1.0 / 3};
    doubles.point_b = {-0.0, 1234567.890123456, 2e-3};
    doubles.volume = 0.1 + 0.2, doubles.volume_error = 3e-9;
    Clash& singles = sample.report.clashes[1];
    singles.rounding = 8e-7;
    singles.point_a = {1.2000000476837158, -3e-8, 12345.678901};
    singles.point_b = {1e6 + 0.1234567, -5e-7, 100};
    singles.volume = 0;
    write_clash_csv(sample.report, sample.models, path("report.csv"));
    const auto rows = parse_csv(read("report.csv"));
    EXPECT_EQ(csv_lengths(rows.at(1)),
              (Row{"-0.3", "1.2", "0", "0.333333333", "0", "1234567.890123456", "0.002", "0.3"}));
    EXPECT_EQ(csv_lengths(rows.at(2)), (Row{"-0.3", "1.2", "0", "12345.678901", "1000000.1234567",
                                            "-0.0000005", "100", "0"}));
}

TEST_F(ClashWriters, CsvHasTheColumnsAndValues) {
    Sample sample;
    sample.report.clashes[0].rule = "a rule";
    sample.report.clashes[0].point_b.x = 4e5; // doubles there are rounded by 1e-10
    sample.report.clashes[4].distance = kInfinity;
    write_clash_csv(sample.report, sample.models, path("report.csv"));
    const auto rows = parse_csv(read("report.csv"));
    ASSERT_EQ(rows.size(), 1 + kClashKinds.size());
    using Row = std::vector<std::string>;
    EXPECT_EQ(rows[0], (Row{"id",
                            "kind",
                            "a",
                            "b",
                            "a_name",
                            "b_name",
                            "a_type",
                            "b_type",
                            "a_file",
                            "b_file",
                            "distance",
                            "point_a_x",
                            "point_a_y",
                            "point_a_z",
                            "point_b_x",
                            "point_b_y",
                            "point_b_z",
                            "direction_x",
                            "direction_y",
                            "direction_z",
                            "triangle_pairs",
                            "rule",
                            "severity",
                            "volume",
                            "volume_error",
                            "neighbours"}));
    EXPECT_EQ(rows[1], (Row{"0000000000000abc",
                            "hard",
                            "1slab",
                            "2pipe",
                            "Slab 2",
                            "Pipe 3",
                            "IfcSlab",
                            "IfcFlowSegment",
                            "models/structure.glb",
                            "models/pipes.glb",
                            "-0.3",
                            "0.3333333333",
                            "-2",
                            "0",
                            "400000",
                            "5.5",
                            "0",
                            "0",
                            "0",
                            "1",
                            "42",
                            "a rule",
                            "",
                            "0",
                            "0",
                            ""}));
    EXPECT_EQ(rows[5][1], "clearance");
    EXPECT_EQ(rows[5][10], "") << "a number that is not finite leaves its cell empty";
    EXPECT_EQ(rows[5][21], "");
}

TEST_F(ClashWriters, CsvQuotesAndDisarmsNames) {
    const std::vector<std::pair<std::string, std::string>> names = {
        {"plain", "plain"},
        {"comma, \"quote\"", "comma, \"quote\""},
        {"two\r\nlines\nthree", "two\r\nlines\nthree"},
        {"=1+1", "'=1+1"},
        {"+49 30", "'+49 30"},
        {"-1 Basement", "'-1 Basement"},
        {"@SUM(A1)", "'@SUM(A1)"},
        {"\t=1", "'\t=1"},
        {"\r=1", "'\r=1"},
        {"=a,\"b\"", "'=a,\"b\""},
        {"|calc", "'|calc"},
        {" =1+1", "' =1+1"},
        {" \t=1+1", "' \t=1+1"},
        {"\n=1", "'\n=1"},
        {"\x1b=1", "'\x1b=1"},
        {"\u00A0=1", "'\u00A0=1"},
        {"\uFEFF=1", "'\uFEFF=1"},
        {"\uFF1D1+1", "'\uFF1D1+1"},
        {"\u3000\uFF0B1", "'\u3000\uFF0B1"},
        {"\uFF0D1", "'\uFF0D1"},
        {"\uFF20SUM(A1)", "'\uFF20SUM(A1)"},
        {"\uFF5Ccalc", "'\uFF5Ccalc"},
        {" Wall", " Wall"},
        {" ", " "},
        {"\u3000", "\u3000"},
        {"1=1", "1=1"},
        {"Wall:3", "Wall:3"},
        {":3", ":3"},
        {"'quoted", "'quoted"},
        {"bad \xFF byte", "bad \xEF\xBF\xBD byte"},
        {"", ""},
    };
    for (const auto& [name, cell] : names) {
        Sample sample;
        sample.models[0].parts[1].name = name;
        write_clash_csv(sample.report, sample.models, path("report.csv"));
        const auto rows = parse_csv(read("report.csv"));
        ASSERT_EQ(rows.size(), 1 + kClashKinds.size()) << name;
        EXPECT_EQ(rows[1][4], cell);
        EXPECT_EQ(rows[1].size(), 26U);
    }
}

TEST_F(ClashWriters, HtmlHoldsTheClashesAndNothingFromOutside) {
    Sample sample;
    const std::string hostile = "</script><script>alert(1)</script><!-- @SCRIPT@ \xFF";
    sample.models[0].parts[1].name = hostile;
    sample.report.models[0].file = "@SCRIPT@</script>";
    sample.report.clashes[0].rule = "a rule";
    write_clash_html(sample.report, sample.models, path("report.html"));
    const std::string page = read("report.html");

    const std::string open = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(open) + open.size();
    ASSERT_GT(begin, open.size());
    const std::size_t end = page.find("</script>", begin);
    const json data = json::parse(page.substr(begin, end - begin));
    EXPECT_EQ(data["part_name"], (json{valid_utf8(hostile), "Pipe 3"}));
    EXPECT_EQ(data["models"][0]["file"], "@SCRIPT@</script>");
    EXPECT_EQ(data["kind"], (json{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(data["a"], (json{0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(data["b"], (json{1, 1, 1, 1, 1, 1}));
    EXPECT_EQ(data["rules"], (json{"a rule", ""}));
    EXPECT_EQ(data["rule"], (json{0, 1, 1, 1, 1, 1}));
    EXPECT_EQ(data["distance"][0].get<double>(), -0.3); // as report.csv has it
    EXPECT_EQ(data["counts"]["hard"], 1);

    std::size_t script_ends = 0;
    for (std::size_t at = 0; (at = page.find("</script", at)) != std::string::npos; ++at)
        ++script_ends;
    EXPECT_EQ(script_ends, 2U) << "of the data and of the page's own script";
    for (const char* outside : {"http://", "https://", "src=", "@import", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

/// The build embeds the page's sources unchanged.
TEST_F(ClashWriters, HtmlHoldsThePagesSources) {
    const Sample sample;
    write_clash_html(sample.report, sample.models, path("report.html"));
    const std::string page = read("report.html");
    for (const char* source : {"report.css", "data.js", "table.js", "page.js"}) {
        std::ifstream file(std::string(ABUT_SOURCE_DIR "/src/clash/report/page/") + source);
        std::ostringstream text;
        text << file.rdbuf();
        ASSERT_GT(text.str().size(), 1000U) << source;
        EXPECT_NE(page.find(text.str()), std::string::npos) << source;
    }
}

TEST_F(ClashWriters, AFolderThatIsNotThereIsNamed) {
    const Sample sample;
    using Writer = void (*)(const ClashReport&, const std::vector<Scene>&, const std::string&);
    for (const Writer writer :
         {Writer(write_clash_json), Writer(write_clash_csv), Writer(write_clash_html)}) {
        const std::string target = path("no such folder/report");
        try {
            writer(sample.report, sample.models, target);
            FAIL() << "wrote into a folder that is not there";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cannot_write);
            EXPECT_EQ(error.file(), target);
            EXPECT_EQ(std::string(error.what()).find(target + ": "), 0U) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}

TEST_F(ClashWriters, AFailureLeavesNothingBehind) {
    const Sample sample;
    // The last step fails for every user, because a file cannot replace a folder.
    fs::create_directory(folder_ / "report.json");
    EXPECT_THROW(write_clash_json(sample.report, sample.models, path("report.json")), Error);
    EXPECT_TRUE(fs::is_directory(folder_ / "report.json"));
    EXPECT_EQ(folder_.files(), 1U);
}

TEST_F(ClashWriters, APageHasTheViewOrSaysThatItsBuildHasNone) {
    Scene scene;
    scene.file = "boxes.glb";
    scene.meshes = {test::box_mesh({0, 0, 0}, {2, 2, 2})};
    scene.parts = {make_part("a", "a", ""), make_part("b", "b", "")};
    scene.parts[1].world_from_mesh.m[9] = 1;
    const std::vector<Scene> models{scene};
    const ClashReport report = find_clashes(models, {});
    ASSERT_EQ(report.clashes.size(), 1U);
    const auto has = [&](const ClashPageOptions& options, const std::string& id) {
        write_clash_html(report, models, path("report.html"), options);
        return read("report.html").find("id=\"" + id + "\"") != std::string::npos;
    };
    EXPECT_EQ(has({}, "no-view"), report_page::scene.empty());
    EXPECT_EQ(has({}, "building"), !report_page::scene.empty());
    // Who asks for a page without the view is told nothing.
    EXPECT_FALSE(has({.building_bytes = 0}, "no-view"));
    EXPECT_FALSE(has({.building_bytes = 0}, "building"));
}

TEST_F(ClashWriters, AClashWithoutItsPartIsAnError) {
    Sample sample;
    sample.report.clashes[2].part[1] = 9;
    try {
        write_clash_html(sample.report, sample.models, path("report.html"));
        FAIL() << "wrote a clash of a part that is not there";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
    }
    EXPECT_THROW(to_json(sample.report, sample.models), Error);
    EXPECT_THROW(write_clash_csv(sample.report, sample.models, path("report.csv")), Error);
    EXPECT_EQ(folder_.files(), 0U);
}

} // namespace
} // namespace abut
