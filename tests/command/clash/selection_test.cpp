// Conditions, rules, the clash matrix, known neighbours and --fail-on of abut clash.

#include <abut/clash.h>
#include <abut/part_query.h>

#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace abut::test {
namespace {

using nlohmann::json;
using Texts = std::vector<std::string>;

class SelectionTest : public ::testing::Test {
protected:
    TemporaryFolder folder_;
    std::string file_ = folder_ / "site.glb";
    std::string store_ = folder_ / "site.abut";

    SelectionTest() {
        write_glb(one_of_each_kind(), file_);
        EXPECT_EQ(run_abut({"import", file_, store_}).status, 0);
    }

    /// Runs the command on the model and on its store, and expects the same answer.
    json clash(Texts options) {
        options.insert(options.end(), {"--clearance", "0.05", "--json"});
        json answers[2];
        for (int i = 0; i < 2; ++i) {
            Texts all{"clash", i == 0 ? file_ : store_};
            all.insert(all.end(), options.begin(), options.end());
            const Outcome outcome = run_abut(all);
            EXPECT_EQ(outcome.status, 0) << outcome.err;
            if (outcome.status != 0)
                return {};
            answers[i] = outcome.json();
        }
        for (json& clash : answers[1]["clashes"])
            clash.erase("status");
        for (const char* key :
             {"counts", "left_out", "neighbours", "candidates", "warnings", "clashes"})
            EXPECT_EQ(answers[0][key], answers[1][key]) << key;
        EXPECT_EQ(answers[0].value("matrix", json()), answers[1].value("matrix", json()));
        return answers[0];
    }
    static Texts kinds(const json& report) {
        Texts list;
        for (const json& clash : report["clashes"])
            list.push_back(clash["kind"]);
        return list;
    }
    Outcome refused(Texts options) {
        options.insert(options.begin(), {"clash", file_});
        Outcome outcome = run_abut(options);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        return outcome;
    }
};

TEST_F(SelectionTest, ConditionsSelectPairs) {
    EXPECT_EQ(clash({})["left_out"]["not_selected"], 0);
    const json only = clash({"--only", "id = h*, t1, d?"});
    EXPECT_EQ(kinds(only), (Texts{"hard", "duplicate"}));
    EXPECT_EQ(only["left_out"]["not_selected"], 3);
    EXPECT_EQ(kinds(clash({"--a", "id = t1", "--b", "id = t2"})), Texts{"touch"});
    EXPECT_EQ(kinds(clash({"--a", "id = t2", "--b", "id = t1"})), Texts{"touch"});
    EXPECT_EQ(kinds(clash({"--a", "id = t1", "--b", "id = t1"})), Texts{});
    EXPECT_EQ(kinds(clash({"--a", "file = site.glb and not id = h1, t1, d1, n1"})),
              (Texts{"hard", "touch", "contained", "duplicate", "clearance"}));
}

TEST_F(SelectionTest, WhatNothingHasIsAnError) {
    const auto error_of = [&](const Texts& options) {
        Texts errors;
        for (const std::string& model : {file_, store_}) {
            Texts all{"clash", model};
            all.insert(all.end(), options.begin(), options.end());
            const Outcome outcome = run_abut(all);
            EXPECT_EQ(outcome.status, 2) << outcome.out;
            errors.push_back(outcome.err);
        }
        EXPECT_EQ(errors[0], errors[1]);
        return errors[0];
    };
    const auto says = [&](const Texts& options, const std::string& text) {
        EXPECT_NE(error_of(options).find(text), std::string::npos) << error_of(options);
    };
    says({"--only", "stroey = L2"}, "--only: no part has the property \"stroey\"");
    says({"--only", "nmae = x"}, "no part has the property \"nmae\"; the nearest are name");
    says({"--fail-on", "hard and a.stroey = L2"}, "--fail-on: no part has the property \"stroey\"");
    says({"--only", "type = Pype"}, "--only: no part has the type \"Pype\"; the nearest");
    says({"--a", "id = h1, h1x"}, "--a: no part has the id \"h1x\"; the nearest are h1");
    says({"--b", "id = zz* or id = h1"}, "--b: no part has the id \"zz*\"");
    says({"--fail-on", "not type != Pype"}, "--fail-on: no part has the type \"Pype\"");
    says({"--fail-on", "kind = hrad"}, "no clash has the kind \"hrad\"; the nearest are hard");
    says({"--fail-on", "severity = high"}, "no clash has the severity \"high\"");
    // Not asked for: what a part must not be, and one glob of several.
    EXPECT_EQ(kinds(clash({"--only", "not type = Space and id = h*, zz*"})), Texts{"hard"});
    // An order of numbers or texts needs no part that is equal.
    EXPECT_EQ(kinds(clash({"--only", "id >= h and id < i and type != Duct"})), Texts{"hard"});
}

TEST_F(SelectionTest, ASyntaxErrorSaysWhere) {
    EXPECT_NE(refused({"--only", "type IfcWall"}).err.find("--only: at character 6: expected an "),
              std::string::npos);
    EXPECT_NE(refused({"--fail-on", "hard and"}).err.find("--fail-on: at character 9"),
              std::string::npos);
    EXPECT_NE(refused({"--preset", "none"}).err.find("--preset"), std::string::npos);
    EXPECT_NE(refused({"--leave-out", "friends"}).err.find("--leave-out"), std::string::npos);
    const std::string rules = folder_.write("r.toml", "[[rules]]\nname = \"x\"\na = \"type =\"\n");
    EXPECT_NE(refused({"--rules", rules})
                  .err.find("r.toml: rules[0].a at character 7: expected a "
                            "value, found the end"),
              std::string::npos);
    const std::string toml = folder_.write("bad.toml", "[[rules]]\nname = \n");
    EXPECT_NE(refused({"--rules", toml}).err.find("is not TOML (line 2"), std::string::npos);
}

TEST_F(SelectionTest, RulesAreTomlOrJson) {
    const std::string toml = folder_.write("rules.toml", R"(
[[rules]]
name = "hard ones"
a = "id = h1"
severity = "high"
[[rules]]
name = "depth"
a = { name = "t*" }
b = "id = t?"
tolerate = 0
[[rules]]
name = "duplicates are known"
a = "id = d1"
kinds = ["hard", "touch"]
[[rules]]
name = "rest"
clearance = 0.01
ignore = { same_name_prefix = 1 }
)");
    const json report = clash({"--rules", toml});
    ASSERT_EQ(kinds(report), (Texts{"hard"})) << report["clashes"];
    EXPECT_EQ(report["clashes"][0]["severity"], "high");
    EXPECT_EQ(report["clashes"][0]["rule"], "hard ones");
    EXPECT_EQ(report["left_out"]["tolerated"], 1);
    EXPECT_EQ(report["left_out"]["other_kind"], 1);
    EXPECT_EQ(report["left_out"]["ignored"], 1); // the contained pair; the clearance is too large
    const std::string same =
        folder_.write("rules.json",
                      R"({"rules": [{"name": "hard ones", "a": "id = h1", "severity": "high"},
                      {"name": "depth", "a": {"name": "t*"}, "b": "id = t?", "tolerate": 0},
                      {"name": "duplicates are known", "a": "id = d1", "kinds": ["hard", "touch"]},
                      {"name": "rest", "clearance": 0.01, "ignore": {"same_name_prefix": 1}}]})");
    EXPECT_EQ(clash({"--rules", same})["clashes"], report["clashes"]);
}

TEST_F(SelectionTest, AToleratedDepthIsDecidedAsTheTouchTolerance) {
    const auto left = [&](double depth) {
        const std::string rules =
            folder_.write("rules.json", R"({"rules": [{"name": "x", "a": "id = h1", "tolerate": )" +
                                            std::to_string(depth) + "}]}");
        return clash({"--rules", rules})["left_out"]["tolerated"].get<int>();
    };
    EXPECT_EQ(left(0.099), 0); // the pair is 0.1 deep
    EXPECT_EQ(left(0.101), 1);
}

TEST_F(SelectionTest, TheMatrixCountsByCell) {
    const std::string matrix = folder_.write("matrix.toml", R"(
[[groups]]
name = "ones"
select = "id = ?1"
[[groups]]
name = "twos"
select = "id = ?2"
[[cells]]
a = ["ones", "twos"]
b = "ones"
clearance = 0.05
severity = "low"
[[cells]]
a = "*"
b = "*"
on = false
)");
    const json report = clash({"--matrix", matrix});
    EXPECT_EQ(report["clashes"].size(), 5U);
    EXPECT_EQ(report["matrix"]["groups"], json({"ones", "twos"}));
    std::set<std::string> seen;
    for (const json& cell : report["matrix"]["cells"]) {
        seen.insert(cell["a"].get<std::string>() + " " + cell["b"].get<std::string>());
        const bool is_mixed = cell["a"] != cell["b"];
        EXPECT_EQ(cell["counts"]["hard"], is_mixed ? 1 : 0);
        EXPECT_EQ(cell["on"], cell["b"] != "twos" || is_mixed);
    }
    EXPECT_EQ(seen, (std::set<std::string>{"ones ones", "ones twos", "twos twos"}));
    const Outcome drawn = run_abut({"clash", file_, "--matrix", matrix});
    EXPECT_NE(drawn.out.find("clash matrix\n"), std::string::npos) << drawn.out;
    EXPECT_NE(drawn.out.find("  twos          5        off\n"), std::string::npos) << drawn.out;
    EXPECT_NE(refused({"--matrix", matrix, "--preset", "clearances"}).err.find("--preset"),
              std::string::npos);
}

TEST_F(SelectionTest, PresetsAreReadAndEqualTheirFiles) {
    for (const std::string_view name : kMatrixPresets) {
        std::ifstream in(std::string(ABUT_SOURCE_DIR) + "/docs/schema/" + std::string(name) +
                         ".toml");
        std::ostringstream text;
        text << in.rdbuf();
        EXPECT_EQ(text.str(), matrix_preset_text(name)) << name;
        const Outcome outcome = run_abut({"clash", file_, "--preset", std::string(name), "--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
}

TEST_F(SelectionTest, VolumesRankTheWorstFirst) {
    const json report = clash({"--sort", "volume"});
    EXPECT_EQ(kinds(report), (Texts{"hard", "contained", "duplicate", "touch", "clearance"}));
    EXPECT_NEAR(report["clashes"][0]["volume"].get<double>(), 0.05625, 1e-6);
    EXPECT_LT(report["clashes"][0]["volume_error"].get<double>(), 1e-9);
    EXPECT_FALSE(report["clashes"][3].contains("volume"));
}

TEST_F(SelectionTest, FailOnTakesAConditionOnClashesAndParts) {
    const auto status = [&](const std::string& condition) {
        return run_abut({"clash", file_, "--quiet", "--clearance", "0.05", "--fail-on", condition})
            .status;
    };
    EXPECT_EQ(status("hard and id = h1"), 1);
    EXPECT_EQ(status("hard and id = t1"), 0);
    EXPECT_EQ(status("hard and (a.id = h1 and b.id = h2 or a.id = h2 and b.id = h1)"), 1);
    EXPECT_EQ(status("depth > 0.05 and kind = hard"), 1);
    EXPECT_EQ(status("depth > 0.2 and kind = hard"), 0);
    EXPECT_EQ(status("gap < 0.04"), 1);
    EXPECT_EQ(status("gap < 0.02"), 0);
    EXPECT_EQ(status("volume >= 0.05 and hard"), 1);
    EXPECT_EQ(status("severity = high"), 2); // no rule gives it
    EXPECT_EQ(status("not any"), 0);
    EXPECT_EQ(status("status = new"), 2);
    EXPECT_EQ(status("new or hard"), 2);
    EXPECT_EQ(run_abut({"clash", store_, "--quiet", "--fail-on", "new and hard"}).status, 1);
    EXPECT_EQ(run_abut({"clash", store_, "--quiet", "--fail-on", "approved and hard"}).status, 0);
}

} // namespace
} // namespace abut::test
