/// collide, distance and within: two unit boxes under poses, answers by hand.
#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

class TwoModelsTest : public ::testing::Test {
protected:
    TemporaryFolder folder_;
    std::string box_ = folder_.write("box.obj", box_obj());

    Outcome ask(const std::string& verb, std::vector<std::string> options) {
        options.insert(options.begin(), {verb, box_, box_});
        return run_abut(options);
    }
};

TEST_F(TwoModelsTest, DistanceUnderATranslation) {
    const Outcome outcome = ask("distance", {"--pose-b", "3,0,0,1,0,0,0", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answer = outcome.json();
    EXPECT_EQ(answer["distance"], 2.0);
    EXPECT_EQ(answer["point_a"][0], 1.0);
    EXPECT_EQ(answer["point_b"][0], 3.0);
    EXPECT_EQ(answer["status"], "exact");
    EXPECT_EQ(answer["a"], box_);
    for (const char* key : {"triangle_a", "triangle_b", "counters", "seconds"})
        EXPECT_TRUE(answer.contains(key)) << key;
}

TEST_F(TwoModelsTest, DistanceUnderARotation) {
    // A quarter turn about z maps B to x in [-1, 0]; the quaternion is not of unit length. A starts
    // at x = 2.
    const Outcome outcome =
        ask("distance", {"--pose-a", "2,0,0,1,0,0,0", "--pose-b", "0,0,0,5,0,0,5", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NEAR(outcome.json()["distance"], 2.0, 1e-12);
}

TEST_F(TwoModelsTest, CollideSaysNoAndYes) {
    const Outcome apart = ask("collide", {"--pose-b", "1.5,0,0,1,0,0,0", "--json", "--all"});
    ASSERT_EQ(apart.status, 0) << apart.err;
    EXPECT_EQ(apart.json()["contact"], false);
    EXPECT_TRUE(apart.json()["triangle_pairs"].empty());

    const Outcome touching = ask("collide", {"--pose-b", "1,0,0,1,0,0,0", "--json"});
    ASSERT_EQ(touching.status, 0) << touching.err;
    EXPECT_EQ(touching.json()["contact"], true);
    EXPECT_EQ(touching.json()["triangle_pairs"].size(), 1U);

    const Outcome all = ask("collide", {"--pose-b", "0.5,0.25,0.25,1,0,0,0", "--json", "--all"});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_GT(all.json()["triangle_pairs"].size(), 1U);
}

TEST_F(TwoModelsTest, WithinIncludesItsBound) {
    for (const auto& [tolerance, near] : {std::pair{"0.499", false}, {"0.5", true}, {"2", true}}) {
        const Outcome outcome =
            ask("within", {"--pose-b", "1.5,0,0,1,0,0,0", "--tolerance", tolerance, "--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.json()["within"], near) << tolerance;
    }
}

TEST_F(TwoModelsTest, TheUnitScalesTheModelsAndNotThePoses) {
    const Outcome outcome =
        ask("distance", {"--pose-b", "3,0,0,1,0,0,0", "--unit", "0.5", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["distance"], 2.5);
}

TEST_F(TwoModelsTest, FailOnTurnsAYesIntoStatusOne) {
    EXPECT_EQ(ask("collide", {"--fail-on", "contact", "--quiet"}).status, 1);
    EXPECT_EQ(ask("collide", {"--quiet"}).status, 0);
    EXPECT_EQ(ask("collide", {"--fail-on", "contact", "--pose-b", "9,0,0,1,0,0,0"}).status, 0);
    EXPECT_EQ(ask("within", {"--fail-on", "within", "--tolerance", "0"}).status, 1);
    EXPECT_EQ(
        ask("within", {"--fail-on", "within", "--tolerance", "1", "--pose-b", "9,0,0,1,0,0,0"})
            .status,
        0);
}

TEST_F(TwoModelsTest, PeopleGetSentences) {
    EXPECT_EQ(ask("collide", {"--pose-b", "9,0,0,1,0,0,0"}).out, "no contact\n");
    EXPECT_EQ(ask("collide", {}).out.rfind("contact: triangle ", 0), 0U);
    EXPECT_EQ(ask("distance", {"--pose-b", "3,0,0,1,0,0,0"}).out.rfind("distance 2\n", 0), 0U);
    EXPECT_EQ(ask("within", {"--tolerance", "1"}).out, "within 1\n");
}

} // namespace
} // namespace abut::test
