/// Groups and topics in abut clash and abut review.
#include <abut/clash_review.h>
#include <abut/store.h>
#include <abut/topics.h>

#include "store/database/sqlite.h"
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/shapes.h"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace abut::test {
namespace {

using Json = nlohmann::json;

/// A slab that `pipes` pipes go through, and two walls that meet far away. Pipe i stands at x = i,
/// plus `shift` for pipe 0.
Scene slab_and_pipes(int pipes, double shift = 0) {
    Scene scene;
    scene.meshes = {box_mesh({-5, -5, 0}, {50, 5, 1}), box_mesh({-0.1, -0.1, -3}, {0.1, 0.1, 3}),
                    box_mesh({100, 0, 0}, {101, 1, 1})};
    scene.parts.push_back(part("slab", "Slab", 0, placed(0, 0, 0)));
    for (int i = 0; i < pipes; ++i)
        scene.parts.push_back(
            part(fmt::format("pipe{}", i), "Pipe", 1, placed(i + (i == 0 ? shift : 0), 0, 0)));
    scene.parts.push_back(part("wall0", "Wall", 2, placed(0, 0, 0)));
    scene.parts.push_back(part("wall1", "Wall", 2, placed(0.5, 0.5, 0.5)));
    return scene;
}

class Groups : public testing::Test {
protected:
    void import(const Scene& scene) {
        write_glb(scene, model_);
        const Outcome outcome = run_abut({"import", model_, store_, "--quiet"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    [[nodiscard]] static Json report(const std::string& of, std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"clash", of, "--json"});
        const Outcome outcome = run_abut(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }
    [[nodiscard]] Outcome review(std::vector<std::string> options) const {
        options.insert(options.begin(), {"review", store_});
        return run_abut(options);
    }
    /// The groups of a report by id: name, change and size.
    static std::map<std::string, std::string> by_id(const Json& report) {
        std::map<std::string, std::string> groups;
        for (const auto& group : report["groups"])
            groups[group["id"]] = fmt::format("{} {} {}", group["name"].get<std::string>(),
                                              group.value("change", "-"), group["size"].get<int>());
        return groups;
    }
    [[nodiscard]] std::map<std::string, std::uint64_t>
    changes(const std::string& since = "") const {
        std::vector<std::string> options{"--groups", "--json"};
        if (!since.empty())
            options.insert(options.end(), {"--since", since});
        return review(options).json()["groupings"][0]["changes"];
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / "site.glb", store_ = folder_ / "site.abut";
};

TEST_F(Groups, OfModelsAreInEveryReport) {
    write_glb(slab_and_pipes(6), model_);
    const Json found = report(model_);
    EXPECT_EQ(found["grouping"], "part,place");
    ASSERT_EQ(found["groups"].size(), 2U);
    EXPECT_EQ(found["groups"][0]["name"], "slab");
    EXPECT_EQ(found["groups"][0]["what"], "6 Pipe");
    EXPECT_EQ(found["groups"][0]["part"]["id"], "slab");
    EXPECT_EQ(found["groups"][1]["kind"], "place");
    std::map<std::string, std::string> group_of;
    for (const auto& group : found["groups"])
        for (const auto& clash : group["clashes"])
            group_of[clash] = group["id"];
    for (const auto& clash : found["clashes"])
        EXPECT_EQ(clash["group"], group_of.at(clash["id"]));
    const std::string text = run_abut({"clash", model_}).out;
    EXPECT_NE(text.find("7 clashes in 2 groups, by part,place\n        6  slab: 6 Pipe\n"),
              std::string::npos)
        << text;
    ASSERT_EQ(run_abut({"clash", model_, "--quiet", "--out", folder_ / "out"}).status, 0);
    const std::string csv = read_file(folder_ / "out/report.csv");
    EXPECT_NE(csv.find(",group,group_name\r\n"), std::string::npos);
    EXPECT_NE(csv.find(found["groups"][0]["id"].get<std::string>() + ",slab\r\n"),
              std::string::npos);
    EXPECT_EQ(report(model_, {"--group", "none"}).count("groups"), 0U);
    const Json nested = report(model_, {"--group", "types,part"});
    EXPECT_EQ(nested["groups"].size(), 2U);
    EXPECT_EQ(nested["groups"][0]["groups"][0]["name"], "slab");
    expect_refused(run_abut({"clash", model_, "--group", "floor"}), {"floor", "storey"});
    expect_refused(run_abut({"clash", model_, "--group", "part,part"}), {"twice"});
    expect_refused(run_abut({"clash", model_, "--group-reach", "0"}), {"reach"});
}

TEST_F(Groups, LastFromJobToJob) {
    import(slab_and_pipes(5));
    const Json first = report(store_);
    const std::string slab = first["groups"][0]["id"], walls = first["groups"][1]["id"];
    EXPECT_EQ(by_id(first)[slab], "slab new 5");
    EXPECT_EQ(by_id(report(store_)), by_id(first)) << "the same job is the same job";
    EXPECT_EQ(changes()["new"], 2U);

    import(slab_and_pipes(8)); // more members
    const Json second = report(store_);
    EXPECT_EQ(by_id(second)[slab], "slab active 8");
    EXPECT_EQ(second["history"].size(), 2U);
    EXPECT_EQ(second["history"][1]["groups"]["active"], 2);
    EXPECT_EQ(changes()["active"], 2U);
    EXPECT_EQ(changes("2020-01-01")["new"], 2U) << "all groups are new since then";

    import(slab_and_pipes(8, 0.3)); // a pipe has moved, but not out of the slab
    EXPECT_EQ(by_id(report(store_))[slab], "slab moved 8");

    Scene gone = slab_and_pipes(8, 0.3);
    gone.parts.erase(gone.parts.begin());
    import(gone);
    EXPECT_EQ(by_id(report(store_)).count(slab), 0U);
    EXPECT_EQ(changes()["resolved"], 1U);
    EXPECT_EQ(changes()["active"], 1U);

    import(slab_and_pipes(2)); // too few for a group, but the group was there before
    EXPECT_EQ(by_id(report(store_))[slab], "slab reopened 2");
    EXPECT_EQ(changes()["reopened"], 1U);
    EXPECT_NE(review({"--groups"}).out.find(slab + "  reopened      2  slab"), std::string::npos)
        << review({"--groups"}).out;
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
    expect_refused(review({"--since", "monday"}), {"--since", "monday"});

    // Another grouping has a memory of its own.
    EXPECT_EQ(report(store_, {"--group", "types"})["groups"].size(), 2U);
    EXPECT_EQ(review({"--json"}).json()["groupings"].size(), 2U);
    EXPECT_FALSE(walls.empty());
}

TEST_F(Groups, TopicsAreKeptAndMarkClashes) {
    import(slab_and_pipes(5));
    const std::string slab = report(store_)["groups"][0]["id"];
    const Outcome assigned =
        review({"--topic", slab, "--assign", "Hydra", "--due", "2026-12-01", "--comment",
                "Sleeves, please", "--label", "openings", "--by", "A. Smith", "--json"});
    ASSERT_EQ(assigned.status, 0) << assigned.err;
    EXPECT_EQ(assigned.json()["added"].size(), 1U);
    const Json found = report(store_);
    ASSERT_EQ(found["topics"].size(), 1U);
    const Json topic = found["topics"][0];
    EXPECT_EQ(topic["guid"], group_topic_guid(slab));
    EXPECT_EQ(topic["assignee"], "Hydra");
    EXPECT_EQ(topic["comments"][0]["author"], "A. Smith");
    EXPECT_EQ(found["revision"], 1);
    const std::string list = review({"--groups"}).out;
    EXPECT_NE(list.find("open, Hydra, due 2026-12-01 #openings, 1 comment: A. Smith: \"Sleeves"),
              std::string::npos)
        << list;
    const Json approved =
        review({"--topic", topic["guid"], "--set-status", "approved", "--json"}).json();
    EXPECT_EQ(approved["marked"], 5);
    EXPECT_EQ(report(store_)["statuses"]["approved"], 5);
    EXPECT_EQ(run_abut({"clash", store_, "--quiet", "--fail-on", "hard"}).status, 1) << "walls";
    // The marks of a renamed topic are still its marks.
    EXPECT_EQ(review({"--topic", slab, "--title", "Sleeves", "--json"}).json()["marked"], 0);
    EXPECT_EQ(report(store_)["statuses"]["approved"], 5);
    EXPECT_EQ(report(store_)["topics"][0]["modified_by"], "") << "nobody was named";
    EXPECT_EQ(review({"--topic", slab, "--set-status", "open", "--json"}).json()["marked"], 5);
    EXPECT_EQ(report(store_)["statuses"]["approved"], 0);
    (void)review({"--topic", slab, "--label", "\xff"}); // not UTF-8
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
    expect_refused(review({"--groups", "--since", "2026-02-30"}), {"--since"});
    expect_refused(review({"--topic", "0123456789abcdef", "--assign", "x"}),
                   {"--topic", "0123456789abcdef"});
    expect_refused(review({"--assign", "x"}), {"--topic"});
    expect_refused(review({"--topic", slab}), {"--topic", "--assign"});
    expect_refused(review({"--topic", slab, "--due", "soon"}), {"due"});
    expect_refused(review({"--topic", slab, "--assign", "x", "--approve", slab}), {"marks"});
}

TEST_F(Groups, EditsOfTheSameRevisionAreMerged) {
    import(slab_and_pipes(5));
    const Json found = report(store_);
    const std::string slab = found["groups"][0]["id"];
    const auto apply = [&](const Json& topic, const Json& revision) {
        const std::string path = folder_ / "edits.json";
        std::ofstream(path) << Json{{"abut_review", 1},
                                    {"author", "B. Jones"},
                                    {"revision", revision},
                                    {"topics", Json::array({topic})}};
        return review({"--apply", path, "--json"});
    };
    ASSERT_EQ(review({"--topic", slab, "--assign", "Hydra", "--label", "one"}).status, 0);
    const Json base = report(store_)["revision"];
    // Two people begin with the same revision.
    EXPECT_EQ(apply({{"group", slab}, {"assignee", "Steel"}, {"labels", {"one", "two"}}}, base)
                  .json()["conflicts"]
                  .size(),
              0U);
    const Json merged = apply({{"group", slab},
                               {"assignee", "Walls & Co"},
                               {"labels", {"three"}},
                               {"priority", "high"},
                               {"comments", Json::array({{{"text", "I do it"}}})}},
                              base)
                            .json();
    ASSERT_EQ(merged["conflicts"].size(), 1U);
    EXPECT_EQ(merged["conflicts"][0]["field"], "assignee");
    EXPECT_EQ(merged["conflicts"][0]["stored"], "Steel");
    EXPECT_EQ(merged["conflicts"][0]["edited"], "Walls & Co");
    const Json topic = report(store_)["topics"][0];
    EXPECT_EQ(topic["assignee"], "Steel");
    EXPECT_EQ(topic["priority"], "high");
    EXPECT_EQ(topic["labels"], Json::parse(R"(["two", "three"])"));
    ASSERT_EQ(topic["comments"].size(), 2U);
    std::set<std::string> texts;
    for (const auto& comment : topic["comments"])
        texts.insert(comment["text"]);
    EXPECT_TRUE(texts.contains("I do it"));
    EXPECT_TRUE(texts.contains("Conflict: assignee stays \"Steel\"; not taken: \"Walls & Co\""));
    EXPECT_EQ(apply({{"group", slab}, {"priority", "high"}}, nullptr).status, 2);
    // Nothing happens if a part of the file is wrong.
    expect_refused(apply({{"group", slab}, {"colour", "red"}}, base), {"topics[0]", "colour"});
    expect_refused(apply({{"group", slab}, {"due", "soon"}}, base), {"topics[0]", "due"});
    expect_refused(apply({{"group", slab}}, 99), {store_, "99"});
    expect_refused(apply(Json{{"title", "x"}}, base), {"topics[0]", "guid"});
    EXPECT_EQ(report(store_)["topics"][0], topic);
}

TEST_F(Groups, CanFailARun) {
    const auto status = [](const std::string& of, const std::string& condition) {
        const Outcome outcome = run_abut({"clash", of, "--quiet", "--fail-on", condition});
        EXPECT_LE(outcome.status, 2) << outcome.err;
        return outcome.status;
    };
    import(slab_and_pipes(5));
    const std::string slab = report(store_)["groups"][0]["id"];
    EXPECT_EQ(status(model_, "group = slab"), 1);
    EXPECT_EQ(status(model_, "group = floor*"), 0);
    EXPECT_EQ(status(model_, "group.id = " + slab), 1);
    EXPECT_EQ(status(model_, "group.size >= 5"), 1);
    EXPECT_EQ(status(model_, "group.size > 5"), 0);
    EXPECT_EQ(status(model_, "group.hard = 5 and name = pipe3"), 1);
    EXPECT_EQ(status(model_, "group.touch > 0"), 0);
    EXPECT_EQ(status(store_, "group.change = new"), 1);
    EXPECT_EQ(status(store_, "topic.status = *"), 0);

    import(slab_and_pipes(5, 0.3)); // one clash of the slab has moved
    EXPECT_EQ(status(store_, "group.change = new, reopened"), 0);
    EXPECT_EQ(status(store_, "group.change = moved"), 1);
    ASSERT_EQ(
        review({"--topic", slab, "--assign", "Hydra", "--due", "2026-11-20", "--label", "openings"})
            .status,
        0);
    EXPECT_EQ(status(store_, "topic.assignee = Hydra and topic.due < 2026-11-23"), 1);
    EXPECT_EQ(status(store_, "topic.due < 2026-11-20"), 0);
    EXPECT_EQ(status(store_, "topic.label = openings and topic.status = open"), 1);
    EXPECT_EQ(status(store_, "not topic.status = * and group.size > 1"), 0);
    ASSERT_EQ(review({"--topic", slab, "--set-status", "approved"}).status, 0);
    EXPECT_EQ(status(store_, "group = slab"), 0) << "approved clashes pass";
    EXPECT_EQ(status(store_, "group = slab and approved"), 1);

    // The names of all groups around a clash count.
    const Outcome nested = run_abut({"clash", store_, "--group", "types,part", "--fail-on",
                                     "group = *Wall* and group = wall0"});
    EXPECT_EQ(nested.status, 1) << nested.out << nested.err;
    EXPECT_NE(nested.out.find("fails       1 clash that --fail-on names, in 1 group\n"),
              std::string::npos)
        << nested.out;
    EXPECT_NE(run_abut({"clash", store_, "--fail-on", "group = none"})
                  .out.find("fails       no clash that --fail-on names\n"),
              std::string::npos);
    // A topic about one clash.
    const Json found = report(store_);
    for (const Json& clash : found["clashes"]) {
        if (clash["a"] == "wall0" || clash["b"] == "wall0") {
            ASSERT_EQ(review({"--topic", clash["id"], "--comment", "Why?"}).status, 0);
        }
    }
    EXPECT_EQ(status(store_, "topic.title ~ wall and name = wall0"), 1);
    EXPECT_EQ(status(store_, "topic.title ~ wall and name = pipe1"), 0);

    const auto refused = [](const std::string& of, const std::string& condition,
                            const std::vector<std::string>& words,
                            const std::string& grouping = "part,place") {
        expect_refused(run_abut({"clash", of, "--group", grouping, "--fail-on", condition}), words);
    };
    refused(model_, "group.change = new", {"--fail-on", "group.change", "store"});
    refused(model_, "topic.status = open", {"--fail-on", "topic.status", "store"});
    refused(store_, "group.size > 3", {"--fail-on", "--group none"}, "none");
    refused(store_, "group.colour = red", {"--fail-on", "group.colour", "group.size"});
}

TEST_F(Groups, ResolvedOnesCanHaveTopics) {
    import(slab_and_pipes(5));
    const std::string slab = report(store_)["groups"][0]["id"];
    import(slab_and_pipes(0));
    const Json after = report(store_);
    EXPECT_EQ(after["groups"].size(), 1U);
    EXPECT_FALSE(report(store_, {"--clearance", "1mm"}).empty()) << "another question";
    ASSERT_EQ(review({"--topic", slab, "--comment", "Drawn anew"}).status, 0);
    const Json topic = report(store_)["topics"][0];
    EXPECT_EQ(topic["group"], slab);
    EXPECT_EQ(topic["title"], "slab");
    EXPECT_EQ(topic["description"], "5 Pipe");
    expect_refused(review({"--topic", "0123456789abcdef", "--comment", "?"}), {"0123456789abcdef"});
}

TEST_F(Groups, GuidsInEditsAreChecked) {
    import(slab_and_pipes(5));
    const std::string slab = report(store_)["groups"][0]["id"];
    const std::string edits = folder_ / "edits.json";
    const auto apply = [&](const std::string& topics) {
        std::ofstream(edits) << R"({"abut_review": 1, "topics": )" << topics << "}";
        return review({"--apply", edits, "--json"});
    };
    const std::string guid = "ABCDEF01-8f4e-4f0a-9f5e-0123456789ab";
    expect_refused(apply(R"([{"guid": ")" + guid + R"("}, {"guid": "../../x", "title": "a"}])"),
                   {edits, "topics[1]", "'guid'", "UUID", "../../x"});
    expect_refused(apply(R"([{"group": "slab", "title": "a"}])"),
                   {edits, "topics[0]", "'group'", "16"});
    expect_refused(apply(R"([{"guid": ")" + guid + R"(", "comments": [{"text": "a"},
                             {"guid": "b", "text": "c"}]}])"),
                   {edits, "topics[0]", "comments[1]", "'guid'"});
    expect_refused(apply(R"([{"guid": ")" + guid + R"(",
                             "comments": [{"text": "a", "viewpoint": "b"}]}])"),
                   {edits, "topics[0]", "comments[0]", "'viewpoint'"});
    ASSERT_EQ(apply(R"([{"guid": ")" + guid + R"(", "title": "Stairs"}])").status, 0);
    // GUIDs are the same in upper and lower case.
    const Json again =
        apply(R"([{"guid": "abcdef01-8F4E-4f0a-9f5e-0123456789ab", "status": "closed"}])").json();
    EXPECT_EQ(again["changed"], Json::array({"abcdef01-8f4e-4f0a-9f5e-0123456789ab"}));
    EXPECT_EQ(again["warnings"], Json::array());
    EXPECT_EQ(report(store_)["topics"].size(), 1U);
}

TEST_F(Groups, DamageIsNoticed) {
    import(slab_and_pipes(5));
    const std::string slab = report(store_)["groups"][0]["id"];
    ASSERT_EQ(review({"--topic", slab, "--assign", "Hydra", "--comment", "a"}).status, 0);
    const std::string whole = read_file(store_);
    for (const char* const damage :
         {"UPDATE clash_group SET name = 'x'", "DELETE FROM clash_group_member WHERE gone = 0",
          "UPDATE clash_grouping SET new = 0", "DELETE FROM clash_grouping",
          "UPDATE topic SET assignee = ''", "DELETE FROM topic_comment",
          "UPDATE topic_revision SET document = '{}'", "UPDATE job_counts SET hard = 0",
          "DELETE FROM topic"}) {
        {
            std::ofstream out(store_, std::ios::binary);
            out << whole;
        }
        {
            Database database(store_, OpenMode::read_write);
            database.run(damage);
        }
        const Outcome outcome = run_abut({"info", store_, "--verify", "--quiet"});
        EXPECT_EQ(outcome.status, 2) << damage;
        EXPECT_NE(outcome.err.find("damaged"), std::string::npos) << damage << outcome.err;
    }
}

} // namespace
} // namespace abut::test
