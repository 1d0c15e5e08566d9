/// ccd-query: queries written by hand, and files that must be refused.
#include "tests/command/run_command.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// A vertex that falls from z = 1 to z = `end` onto the right triangle in the plane z = 0.
std::string falling(const std::string& end, const std::string& truth = "") {
    const std::string face =
        "0,1,0,1,0,1" + truth + "\n1,1,0,1,0,1" + truth + "\n0,1,1,1,0,1" + truth + "\n";
    return "1,4,1,4,1,1" + truth + "\n" + face + "1,4,1,4," + end + truth + "\n" + face;
}

class CcdQueryCommand : public ::testing::Test {
protected:
    TemporaryFolder folder_;

    void expect_file_refused(const std::string& text, const std::vector<std::string>& words) {
        SCOPED_TRACE(text);
        const std::string file = folder_.write("a-vertex-face.csv", text);
        std::vector<std::string> all{"a-vertex-face.csv"};
        all.insert(all.end(), words.begin(), words.end());
        expect_refused(run_abut({"ccd-query", file, "--json"}), all);
    }
};

TEST_F(CcdQueryCommand, CountsAnswersAgainstTheTruth) {
    // The vertex reaches z = -1/2, stops at 1/8, or touches at 0. The second file states the
    // opposite.
    const std::string good =
        folder_.write("one-vertex-face-0.csv",
                      falling("-1,2", ",1") + falling("1,8", ",0") + falling("0,1", ",1"));
    const std::string wrong =
        folder_.write("two_vf.csv", falling("-1,2", ",0") + falling("1,8", ",1"));
    const Outcome outcome = run_abut({"ccd-query", good, wrong, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answer = outcome.json();
    ASSERT_EQ(answer["files"].size(), 2U);
    EXPECT_EQ(answer["files"][0]["file"], good);
    EXPECT_EQ(answer["files"][0]["queries"], 3);
    EXPECT_EQ(answer["files"][0]["positives"], 2);
    EXPECT_EQ(answer["files"][0]["false_negatives"], 0);
    EXPECT_EQ(answer["files"][0]["false_positives"], 0);
    const auto& total = answer["total"];
    EXPECT_EQ(total["queries"], 5);
    EXPECT_EQ(total["positives"], 3);
    EXPECT_EQ(total["false_negatives"], 1);
    EXPECT_EQ(total["false_positives"], 1);
    EXPECT_EQ(total["hits"], 3);
    EXPECT_GT(total["mean_ns"], 0);
    EXPECT_GT(total["median_ns"], 0);
    EXPECT_LE(total["median_ns"], total["p99_ns"]);
    const auto& by = total["decided_by"];
    EXPECT_EQ(by["filter"].get<int>() + by["interval"].get<int>() + by["exact"].get<int>(), 5);
    EXPECT_EQ(answer["mode"], "exact");

    const Outcome table = run_abut({"ccd-query", good, wrong});
    EXPECT_NE(table.out.find("one-vertex-face-0.csv"), std::string::npos);
    EXPECT_NE(table.out.find("total"), std::string::npos);
}

TEST_F(CcdQueryCommand, TruthInAFileOfItsOwn) {
    const std::string queries = folder_.write("plain.csv", falling("-1,2") + falling("1,8"));
    const std::string truth = folder_.write("truth.json", "[true, 0]");
    const std::vector<std::string> arguments{"ccd-query", queries,   "--kind", "vertex-face",
                                             "--json",    "--truth", truth};
    const Outcome outcome = run_abut(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["total"]["positives"], 1);
    EXPECT_EQ(outcome.json()["total"]["false_negatives"], 0);
    const Outcome without = run_abut({"ccd-query", queries, "--kind", "vertex-face", "--json"});
    ASSERT_EQ(without.status, 0) << without.err;
    EXPECT_TRUE(without.json()["total"]["positives"].is_null());
    EXPECT_EQ(without.json()["total"]["hits"], 1);

    static_cast<void>(folder_.write("truth.json", "[true]"));
    expect_refused(run_abut(arguments), {"truth.json", "1 values for 2"});
    static_cast<void>(folder_.write("truth.json", "[true, 2]"));
    expect_refused(run_abut(arguments), {"truth.json", "[1]"});
    static_cast<void>(folder_.write("truth.json", "{"));
    expect_refused(run_abut(arguments), {"truth.json"});
}

TEST_F(CcdQueryCommand, ConservativeModeReportsNearPairs) {
    // The end of an edge passes another edge at a distance of about 2^-60.
    const std::string moving = "1,1152921504606846976,0,1,HEIGHT,1\n1,1,3,1,HEIGHT,1\n",
                      fixed = "-3,1,1,1,0,1\n3,1,-1,1,0,1\n";
    const auto at = [&](const std::string& height) {
        std::string text = moving;
        for (std::size_t i = 0; (i = text.find("HEIGHT")) != std::string::npos;)
            text.replace(i, 6, height);
        return text + fixed;
    };
    const std::string near = folder_.write("ee.csv", at("1") + at("-1"));
    EXPECT_EQ(run_abut({"ccd-query", near, "--json"}).json()["total"]["hits"], 0);
    const auto conservative =
        run_abut({"ccd-query", near, "--mode", "conservative", "--delta", "1e-9", "--json"});
    ASSERT_EQ(conservative.status, 0) << conservative.err;
    EXPECT_EQ(conservative.json()["total"]["hits"], 1);
    EXPECT_EQ(conservative.json()["delta"], 1e-9);
}

TEST_F(CcdQueryCommand, AThicknessReplacesTheTruth) {
    const std::string queries =
        folder_.write("vf.csv", falling("1,8", ",0") + falling("1,2", ",0"));
    const auto thick = run_abut({"ccd-query", queries, "--thickness", "0.25", "--json"});
    ASSERT_EQ(thick.status, 0) << thick.err;
    const auto answer = thick.json();
    EXPECT_EQ(answer["thickness"], 0.25);
    EXPECT_EQ(answer["total"]["hits"], 1);
    EXPECT_TRUE(answer["total"]["positives"].is_null());
    EXPECT_TRUE(answer["total"]["false_positives"].is_null());
    EXPECT_EQ(run_abut({"ccd-query", queries, "--json"}).json()["thickness"], 0);
    expect_refused(run_abut({"ccd-query", queries, "--thickness", "-1"}), {"--thickness"});
    const std::string truth = folder_.write("truth.json", "[0, 0]");
    expect_refused(run_abut({"ccd-query", queries, "--thickness", "1", "--truth", truth}),
                   {"--truth"});
}

TEST_F(CcdQueryCommand, BadFilesAreRefusedByLine) {
    const std::string good = falling("-1,2", ",1");
    expect_file_refused("", {"is empty"});
    expect_file_refused(good.substr(0, good.size() - 14), {"line 7", "7 of 8 rows"});
    expect_file_refused(good.substr(0, good.size() - 5), {"line 8", "columns"});
    expect_file_refused(falling("-1,0", ",1"), {"line 5", "denominator"});
    expect_file_refused(falling("nan,1", ",1"), {"line 5", "'nan'"});
    expect_file_refused(falling("-1.5,1", ",1"), {"line 5", "'-1.5'"});
    expect_file_refused(falling(",1", ",1"), {"line 5"});
    expect_file_refused(falling("1,3", ",1"), {"line 5", "1/3"});
    expect_file_refused(falling("9007199254740993,1", ",1"), {"line 5", "not exactly a double"});
    expect_file_refused(falling("1" + std::string(400, '0') + ",1", ",1"),
                        {"line 5", "not exactly a double"});
    expect_file_refused(falling("-1,2", ",2"), {"line 1", "truth"});
    expect_file_refused(falling("-1,2", ",1") + falling("1,1"), {"line 9", "columns"});
    std::string differs = good;
    differs[differs.size() - 2] = '0';
    expect_file_refused(differs, {"line 8", "truth"});
    expect_refused(run_abut({"ccd-query", folder_ / "none-ee.csv"}), {"none-ee.csv"});
    expect_refused(run_abut({"ccd-query", folder_.write("sheep.csv", good)}),
                   {"sheep.csv", "kind"});
    expect_refused(run_abut({"ccd-query", folder_.write("x-vf.csv", good), "--delta", "1"}),
                   {"--delta"});
}

TEST_F(CcdQueryCommand, RationalsThatAreDoublesAreTaken) {
    // 3/6 and -2/-8 reduce; also +0 and -0, Windows line ends, spaces and an empty line.
    std::string text = falling("-3,6", ",1") + falling("-2,-8", ",0");
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
    text += "\r\n";
    text.replace(text.find("1,4"), 3, "1 , 4");
    const Outcome outcome = run_abut({"ccd-query", folder_.write("q-vf.csv", text), "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["total"]["queries"], 2);
    EXPECT_EQ(outcome.json()["total"]["false_positives"], 0);
    EXPECT_EQ(outcome.json()["total"]["false_negatives"], 0);
}

} // namespace
} // namespace abut::test
