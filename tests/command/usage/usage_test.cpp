/// The command line and its output: order of options, lengths with units, mistyped names, number
/// formats.
#include "tests/command/box_test.h"
#include "tests/support/paths.h"

#include <cmath>
#include <gtest/gtest.h>
#include <regex>

namespace abut::test {
namespace {

class Usage : public TwoBoxesTest {};

TEST_F(Usage, OptionsMayStandBeforeTheVerb) {
    const auto answer = [](const std::vector<std::string>& arguments) {
        const Outcome outcome = run_abut(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        auto json = outcome.json();
        json.erase("seconds");
        return json;
    };
    const auto after = answer({"within", box_, box_, "--json", "--tolerance", "0.5"});
    EXPECT_EQ(answer({"--json", "within", box_, box_, "--tolerance", "0.5"}), after);
    EXPECT_EQ(answer({"--json", "--tolerance", "0.5", "--threads=1", "within", box_, box_}), after);
    EXPECT_EQ(answer({"--threads", "1", "--json", "within", "--tolerance", "0.5", box_, box_}),
              after);
    EXPECT_EQ(run_abut({"--help", "collide"}).out, run_abut({"collide", "--help"}).out);
    EXPECT_EQ(answer({"--json", "info", box_})["files"][0]["parts"], 1);
}

TEST_F(Usage, AValueThatIsAVerbIsAValue) {
    const Outcome outcome = run_abut({"--out", folder_ / "clash", "--quiet", "clash", box_});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "clash/report.json"));
    const Outcome relative = run_program(
        {"sh", "-c", "cd " + (folder_ / "") + " && " + ABUT_COMMAND + " --out info clash box.obj"});
    EXPECT_EQ(relative.status, 0) << relative.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "info/report.json"));
    // A file with the name of a verb.
    EXPECT_EQ(run_program({"sh", "-c",
                           "cd " + (folder_ / "") + " && cp box.obj ray && " + ABUT_COMMAND +
                               " contains box.obj --points ray --quiet"})
                  .status,
              2); // the file is read, and has no points
}

TEST_F(Usage, MistypedNamesGetSuggestions) {
    struct Case {
        std::vector<std::string> arguments;
        std::string meant;
    };
    const std::vector<Case> cases{
        {{"colide", box_, box_}, "'colide' (did you mean collide?)"},
        {{"clsah", box_}, "(did you mean clash?)"},
        {{"penetrate", box_, box_}, "(did you mean penetration?)"},
        {{"Info", box_}, "(did you mean info?)"},
        {{"--json", "inof", box_}, "'inof' (did you mean info?)"},
        {{"clash", box_, "--cleerance", "1"}, "'--cleerance' (did you mean --clearance?)"},
        {{"clash", box_, "--cleerance=1"}, "'--cleerance' (did you mean --clearance?)"},
        {{"clash", box_, "--clearence", "1"}, "(did you mean --clearance?)"},
        {{"clash", box_, "-json"}, "(did you mean --json?)"},
        {{"clash", box_, "--output", "x"}, "(did you mean --out?)"},
        {{"--jsno", "clash", box_}, "(did you mean --json?)"},
        {{"collide", box_, box_, "--posse-b", "1"}, "(did you mean --pose-b?)"},
        {{"clash", box_, "--csv", "x"}, "(did you mean --out? Folder for report.html"},
        {{"clash", box_, "--clearance", "50", "mm"}, "--clearance: write 50mm without a space"},
        {{"collide", box_, box_, "--zzzzzzzz"}, "(see abut collide --help)"},
        {{"zzzzzzzz"}, "(see abut --help)"},
    };
    for (const Case& each : cases) {
        SCOPED_TRACE(::testing::PrintToString(each.arguments));
        expect_refused(run_abut(each.arguments), {each.meant});
    }
}

TEST_F(Usage, LengthsTakeAUnit) {
    const std::string two_apart = "3,0,0,1,0,0,0";
    for (const auto& [length, is_within] :
         std::vector<std::pair<std::string, bool>>{{"2", true},
                                                   {"2m", true},
                                                   {"200cm", true},
                                                   {"2000mm", true},
                                                   {"2 m", true},
                                                   {"1999.999mm", false},
                                                   {"7ft", true},
                                                   {"6.5ft", false},
                                                   {"78.8in", true},
                                                   {"78.7in", false},
                                                   {"2e3mm", true},
                                                   {"2mm", false}}) {
        const Outcome outcome =
            ask("within", {"--pose-b", two_apart, "--json", "--tolerance", length});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.json()["within"], is_within) << length;
    }
    // Rounded once, so that the double equals that of the number in metres.
    for (const auto& [length, value] : std::vector<std::pair<std::string, double>>{
             {"50mm", 0.05}, {"5cm", 0.05}, {"2in", 0.0508}, {"3ft", 0.9144}, {"7mm", 0.007}})
        EXPECT_EQ(ask("within", {"--json", "--tolerance", length}).json()["tolerance"], value)
            << length;
    for (const char* bad :
         {"mm", "5 parsecs", "-5mm", "1e308ft", "nanmm", "5mm5", "m5", "5mmm", ""})
        expect_refused(ask("within", {"--tolerance", bad}), {"--tolerance"});
}

TEST_F(Usage, EveryLengthOptionTakesAUnit) {
    const std::string moved = "1500mm,0,0,1,0,0,0";
    EXPECT_EQ(ask("distance", {"--pose-b", moved, "--json"}).json()["distance"], 0.5);
    EXPECT_EQ(ask("distance", {"--pose-b", moved, "--upper-bound", "10cm"}).out,
              "distance at least 0.1 m\n");
    EXPECT_EQ(ask("distance", {"--absolute-error", "1mm", "--quiet"}).status, 0);
    EXPECT_EQ(ask("time-of-impact", {"--tolerance", "1mm", "--quiet"}).status, 0);
    const std::vector<std::vector<std::string>> all{
        {"clash", box_, "--clearance", "5cm", "--touch", "1mm"},
        {"scene", "plant", "--triangles", "10000", "--clashes", "1", "--clearance", "5cm", "--out",
         folder_ / "plant.glb"},
        {"nearest", box_, "--point", "1in,2ft,30mm"},
        {"ray", box_, "--origin", "50cm,50cm,9m", "--direction", "0,0,-1"},
        {"overlap", box_, "--sphere", "0,0,0,50mm"},
        {"overlap", box_, "--box", "0,0,0,50mm,50mm,50mm", "--box-pose", "1cm,0,0,1,0,0,0"},
        {"overlap", box_, "--segment", "0,0,0,50mm,50mm,50mm"}};
    for (const auto& arguments : all) {
        const Outcome outcome = run_abut(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
    EXPECT_EQ(run_abut({"clash", box_, "--clearance", "50mm", "--json"}).json()["clearance"], 0.05);
    // A quaternion and a direction have no unit.
    expect_refused(ask("collide", {"--pose-b", "0,0,0,1m,0,0,0"}), {"1m"});
    expect_refused(run_abut({"ray", box_, "--origin", "0,0,0", "--direction", "1m,0,0"}), {"1m"});
}

/// All numbers in the text.
std::vector<std::string> numbers_of(const std::string& text) {
    const std::regex number(R"(-?\d+(\.\d+)?(e[-+]\d+)?)");
    return {std::sregex_token_iterator(text.begin(), text.end(), number),
            std::sregex_token_iterator()};
}

TEST_F(Usage, TextHasUnitsAndFewDigits) {
    const std::string odd = "-3.2345678901,-0.2,0.1,1,0,0,0";
    const std::string near = "0.7345678901,0.2,0.1,1,0.1,0,0";
    const std::string odd_a = "0,-0,0,0.98765432101,0.1,-0.2,0.3";
    struct Case {
        std::string verb;
        std::vector<std::string> options;
        std::string pose_b;
        std::size_t units; ///< how many lengths and points it says
    };
    const std::vector<Case> cases{
        {"distance", {}, odd, 3},
        {"distance", {"--convex"}, odd, 3},
        {"distance", {"--convex"}, near, 1},
        {"distance", {"--pieces"}, odd, 3},
        {"distance", {"--pieces"}, near, 1},
        {"distance", {"--absolute-error", "0.123456789"}, odd, 4},
        {"distance", {"--upper-bound", "0.0123456789"}, odd, 1},
        {"distance", {"--signed"}, near, 4},
        {"within", {"--tolerance", "0.0123456789"}, odd, 1},
        {"penetration", {}, near, 6}, // with its area
        {"penetration", {"--convex"}, near, 1},
        {"penetration", {"--pieces"}, near, 2},
        {"time-of-impact", {"--end-b", "0.1,0.2,0.3,1,0,0,0"}, odd, 3},
    };
    for (const Case& each : cases) {
        std::vector<std::string> options{"--pose-a", odd_a, "--pose-b", each.pose_b};
        options.insert(options.end(), each.options.begin(), each.options.end());
        const Outcome outcome = ask(each.verb, options);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        SCOPED_TRACE(outcome.out);
        const std::regex unit(R"([\d)] m\b)");
        const auto begin = std::sregex_iterator(outcome.out.begin(), outcome.out.end(), unit);
        EXPECT_EQ(static_cast<std::size_t>(std::distance(begin, std::sregex_iterator())),
                  each.units);
        for (const std::string& number : numbers_of(outcome.out)) {
            EXPECT_NE(number, "-0");
            std::string digits = number.substr(0, number.find('e'));
            std::erase_if(digits, [](char c) { return c == '.' || c == '-'; });
            digits.erase(0, digits.find_first_not_of('0'));
            EXPECT_LE(digits.size(), 6U) << number;
        }
    }
}

TEST_F(Usage, NoNegativeZero) {
    // The nearest point of a box below the origin has coordinates of -0.
    const std::string at = "-1,-1,-1,1,0,0,0";
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"nearest", box_, "--pose", at, "--point", "-0,-0,-0"},
             {"distance", box_, box_, "--pose-a", at, "--pose-b", at},
             {"ray", box_, "--origin", "0.5,-0.0,-2", "--direction", "-0.0,-0.0,1", "--all"},
             {"penetration", box_, box_},
             {"info", box_}}) {
        const Outcome outcome = run_abut(arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        // In file names, a letter may precede "-0".
        EXPECT_FALSE(std::regex_search(outcome.out, std::regex(R"((^|\W)-0(?![.\w]))")))
            << outcome.out;
    }
}

TEST_F(Usage, JsonGivesEveryDigit) {
    // The boxes are apart by the diagonal of a unit square.
    const auto answer = ask("distance", {"--pose-b", "2,2,0,1,0,0,0", "--json"});
    EXPECT_NE(answer.out.find("\"distance\":1.4142135623730951,"), std::string::npos) << answer.out;
    EXPECT_EQ(answer.json()["distance"].get<double>(), std::sqrt(2.0));
}

TEST_F(Usage, SegmentsAreInTheText) {
    const Outcome crossing =
        ask("collide", {"--pose-b", "0.5,0.21,0.34,1,0,0,0", "--all", "--segments"});
    ASSERT_EQ(crossing.status, 0) << crossing.err;
    const auto json =
        ask("collide", {"--pose-b", "0.5,0.21,0.34,1,0,0,0", "--all", "--segments", "--json"})
            .json();
    const std::regex segment(R"(\n\d+ \d+  segment \([-.\de, ]+\), \([-.\de, ]+\) m(?=\n))");
    const auto begin = std::sregex_iterator(crossing.out.begin(), crossing.out.end(), segment);
    EXPECT_EQ(static_cast<std::size_t>(std::distance(begin, std::sregex_iterator())),
              json["segments"].size())
        << crossing.out;
    EXPECT_GT(json["segments"].size(), 1U);
    // Coplanar faces share polygons, and corners share points.
    const Outcome touching = ask("collide", {"--pose-b", "1,1,1,1,0,0,0", "--all", "--segments"});
    EXPECT_NE(touching.out.find("  point (1, 1, 1) m\n"), std::string::npos) << touching.out;
    EXPECT_NE(ask("collide", {"--all", "--segments"}).out.find("  polygon ("), std::string::npos);
    EXPECT_NE(
        ask("collide", {"--pose-b", "0.5,0.2,0.3,1,0,0,0", "--segments"}).out.find(", segment ("),
        std::string::npos);
    EXPECT_EQ(ask("collide", {"--all"}).out.find('('), std::string::npos);
}

} // namespace
} // namespace abut::test
