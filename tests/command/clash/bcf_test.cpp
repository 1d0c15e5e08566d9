/// BCF files of abut clash and abut review.
#include <abut/bcf.h>
#include <abut/topics.h>

#include "store/database/sqlite.h"
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Json = nlohmann::json;

/// A slab that `pipes` pipes go through, and two walls that meet far away.
Scene pipes_through_slab(int pipes) {
    Scene scene;
    scene.meshes = {box_mesh({-5, -5, 0}, {50, 5, 1}), box_mesh({-0.1, -0.1, -3}, {0.1, 0.1, 3}),
                    box_mesh({100, 0, 0}, {101, 1, 1})};
    scene.parts.push_back(part("slab", "Slab", 0, placed(0, 0, 0)));
    for (int i = 0; i < pipes; ++i)
        scene.parts.push_back(part(fmt::format("pipe{}", i), "Pipe", 1, placed(i, 0, 0)));
    scene.parts.push_back(part("wall0", "Wall", 2, placed(0, 0, 0)));
    scene.parts.push_back(part("wall1", "Wall", 2, placed(0.5, 0.5, 0.5)));
    return scene;
}

class BcfFiles : public testing::Test {
protected:
    void import(const Scene& scene) {
        write_glb(scene, model_);
        const Outcome outcome = run_abut({"import", model_, store_, "--quiet"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    static Json clash(const std::string& of, std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"clash", of, "--json"});
        const Outcome outcome = run_abut(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }
    [[nodiscard]] Outcome review(std::vector<std::string> options) const {
        options.insert(options.begin(), {"review", store_});
        return run_abut(options);
    }
    Json read_in() const { // NOLINT: its effect may be all
        const Outcome outcome = review({"--bcf-in", bcf_, "--by", "A. Smith", "--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }
    void write_out() const {
        const Outcome outcome = review({"--bcf-out", bcf_, "--no-snapshots"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    static BcfTopic& topic_of(BcfFile& file, const std::string& group) {
        return *std::ranges::find(file.topics, group_topic_guid(group), &BcfTopic::guid);
    }
    static BcfComment comment(const std::string& guid, const std::string& text) {
        BcfComment comment;
        comment.guid = guid;
        comment.date = "2026-03-02T08:00:00Z";
        comment.author = "Hydra";
        comment.text = text;
        return comment;
    }
    [[nodiscard]] Json stored(const std::string& guid) const {
        const Json found = clash(store_);
        for (const Json& topic : found["topics"])
            if (topic["guid"] == guid)
                return topic;
        return {};
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / "site.glb", store_ = folder_ / "site.abut",
                bcf_ = folder_ / "site.bcf";
};

TEST_F(BcfFiles, HaveATopicForEachGroup) {
    write_glb(pipes_through_slab(6), model_);
    for (const std::string version : {"2.1", "3.0"}) {
        const std::string path = folder_ / ("models" + version + ".bcf");
        const Json found = clash(model_, {"--bcf", path, "--no-snapshots", "--bcf-version", version,
                                          "--bcf-project", "Hall"});
        BcfFile file = read_bcf(path);
        EXPECT_EQ(to_string(file.version), version);
        EXPECT_EQ(file.project_name, "Hall");
        EXPECT_TRUE(file.warnings.empty());
        ASSERT_EQ(file.topics.size(), 2U);
        const BcfTopic& slab = topic_of(file, found["groups"][0]["id"]);
        EXPECT_EQ(slab.title, "slab");
        EXPECT_EQ(slab.status, "Open");
        EXPECT_EQ(slab.description, "Found by Abut: 6 hard; at most 0.500 m deep; 6 Pipe");
        ASSERT_EQ(slab.viewpoints.size(), 1U);
        EXPECT_EQ(slab.viewpoints[0].selection.size(), 7U);
    }
    const Outcome told = run_abut({"clash", model_, "--bcf", bcf_, "--no-snapshots"});
    EXPECT_NE(told.out.find("bcf         " + bcf_ + ": 2 topics\n"), std::string::npos) << told.out;
    std::filesystem::remove(bcf_);
    clash(model_, {"--bcf", bcf_, "--no-snapshots", "--group", "none"});
    EXPECT_EQ(read_bcf(bcf_).topics.size(), 7U);
    expect_refused(run_abut({"clash", model_, "--bcf", bcf_, "--bcf-version", "2.0"}),
                   {"--bcf-version", "2.0"});
    expect_refused(run_abut({"clash", model_, "--bcf", model_}), {model_});
}

TEST_F(BcfFiles, KeepWhatPeopleWroteInThem) {
    write_glb(pipes_through_slab(5), model_);
    const Json found = clash(model_, {"--bcf", bcf_, "--no-snapshots"});
    BcfFile file = read_bcf(bcf_);
    BcfTopic& slab = topic_of(file, found["groups"][0]["id"]);
    slab.status = "Resolved";
    slab.description = "Move them\n" + slab.description;
    write_bcf(file, bcf_);
    write_glb(pipes_through_slab(7), model_);
    clash(model_, {"--bcf", bcf_, "--no-snapshots"});
    file = read_bcf(bcf_);
    const BcfTopic& again = topic_of(file, found["groups"][0]["id"]);
    EXPECT_EQ(again.status, "Resolved");
    EXPECT_EQ(again.description, "Move them\nFound by Abut: 7 hard; at most 0.500 m deep; 7 Pipe");
    EXPECT_EQ(again.viewpoints.size(), 1U);
}

TEST_F(BcfFiles, ComeBackIntoTheStore) {
    import(pipes_through_slab(5));
    const Json found = clash(store_, {"--bcf", bcf_, "--no-snapshots"});
    const std::string slab = found["groups"][0]["id"];
    const Json nothing = read_in();
    EXPECT_EQ(nothing["added"].size() + nothing["changed"].size(), 0U) << nothing;

    BcfFile file = read_bcf(bcf_);
    BcfTopic& topic = topic_of(file, slab);
    topic.status = "Approved";
    topic.assigned_to = "Hydra";
    topic.stage = "Tender";
    topic.due_date = "2026-12-01T12:00:00Z";
    topic.labels.emplace_back("openings");
    topic.comments.push_back(
        comment("11111111-8f4e-4f0a-9f5e-0123456789ab", "<script>sleeves</script>"));
    BcfTopic fresh;
    fresh.guid = fresh.folder = "22222222-8f4e-4f0a-9f5e-0123456789ab";
    fresh.title = "Stairs are missing";
    fresh.status = "Open";
    file.topics.push_back(fresh);
    write_bcf(file, bcf_, BcfVersion::v3_0);
    const Json merge = read_in();
    EXPECT_EQ(merge["added"].size(), 2U) << merge;
    EXPECT_EQ(merge["comments"], 1);
    EXPECT_EQ(merge["marked"], 5);
    EXPECT_EQ(merge["conflicts"].size(), 0U);

    // What was read stays when the model has changed.
    import(pipes_through_slab(8));
    const Json after = clash(store_);
    EXPECT_EQ(after["statuses"]["approved"], 5);
    EXPECT_EQ(after["groups"][0]["size"], 8);
    const Json kept = stored(group_topic_guid(slab));
    EXPECT_EQ(kept["status"], "approved");
    EXPECT_EQ(kept["assignee"], "Hydra");
    EXPECT_EQ(kept["stage"], "Tender");
    EXPECT_EQ(kept["due"], "2026-12-01");
    EXPECT_EQ(kept["labels"], Json::array({"openings"}));
    EXPECT_EQ(kept["comments"][0]["text"], "<script>sleeves</script>");
    EXPECT_EQ(stored(fresh.guid)["title"], "Stairs are missing");
    write_out();
    file = read_bcf(bcf_);
    ASSERT_EQ(file.topics.size(), 3U);
    EXPECT_EQ(topic_of(file, slab).status, "Approved");
    EXPECT_EQ(topic_of(file, slab).viewpoints[0].selection.size(), 9U);
    const Json again = read_in();
    EXPECT_EQ(again["added"].size() + again["changed"].size(), 0U) << again;
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
}

TEST_F(BcfFiles, TellConflicts) {
    import(pipes_through_slab(5));
    const std::string slab = clash(store_)["groups"][0]["id"];
    write_out();
    ASSERT_EQ(review({"--topic", slab, "--assign", "Steel", "--comment", "ours"}).status, 0);
    BcfFile file = read_bcf(bcf_);
    topic_of(file, slab).assigned_to = "Hydra";
    topic_of(file, slab).priority = "High";
    write_bcf(file, bcf_);
    const Json merge = read_in();
    ASSERT_EQ(merge["conflicts"].size(), 1U) << merge;
    EXPECT_EQ(merge["conflicts"][0]["field"], "assignee");
    EXPECT_EQ(merge["conflicts"][0]["edited"], "Hydra");
    const Json topic = stored(group_topic_guid(slab));
    EXPECT_EQ(topic["assignee"], "Steel");
    EXPECT_EQ(topic["priority"], "High");
    EXPECT_EQ(topic["comments"].size(), 2U) << topic;
}

/// Some programs drop files that they do not know, and so the revision.
TEST_F(BcfFiles, WithoutARevisionLoseNoComment) {
    import(pipes_through_slab(5));
    const std::string slab = clash(store_)["groups"][0]["id"];
    write_out();
    ASSERT_EQ(review({"--topic", slab, "--assign", "Steel", "--comment", "ours"}).status, 0);
    BcfFile file = read_bcf(bcf_);
    file.entries.clear();
    BcfTopic& topic = topic_of(file, slab);
    topic.creation_date = "2026-01-01T00:00:00Z"; // not changed since then
    topic.comments.push_back(comment("11111111-8f4e-4f0a-9f5e-0123456789ab", "theirs"));
    write_bcf(file, bcf_);
    read_in();
    Json stored_topic = stored(group_topic_guid(slab));
    EXPECT_EQ(stored_topic["assignee"], "Steel");
    EXPECT_EQ(stored_topic["comments"].size(), 2U);
    file.topics[0].modified_date = file.topics[1].modified_date = "2100-01-01T00:00:00Z";
    topic_of(file, slab).assigned_to = "Hydra";
    write_bcf(file, bcf_);
    read_in();
    stored_topic = stored(group_topic_guid(slab));
    EXPECT_EQ(stored_topic["assignee"], "Hydra");
    EXPECT_EQ(stored_topic["comments"].size(), 2U);
}

/// Every option of a question that a store keeps.
TEST_F(BcfFiles, AreWrittenAfterAJobWithRules) {
    import(pipes_through_slab(5));
    const std::string rules = folder_ / "rules.toml", matrix = folder_ / "matrix.toml";
    std::ofstream(rules) << R"(
[[rules]]
name = "walls"
a = { name = "wall*", type = ["Wall"], file = "*" }
b = "type = Wall and not name = \"a b\""
clearance = 0.1
touch = 0.001
tolerate = 0.002
kinds = ["hard", "clearance"]
severity = "low"
ignore = { same_name_prefix = 40, neighbours = ["fills"] }
)";
    std::ofstream(matrix) << R"(
[[groups]]
name = "slabs"
select = "type = Slab"
[[groups]]
name = "pipes"
select = "type = Pipe"
[[cells]]
a = "slabs"
b = "pipes"
severity = "high"
[[cells]]
a = "pipes"
b = "pipes"
on = false
)";
    const std::vector<std::string> options{
        "--rules",          rules,         "--matrix",         matrix,    "--only",
        "not name = pipe4", "--leave-out", "covers,connected", "--touch", "2mm",
        "--group",          "types"};
    const Json found = clash(store_, options);
    ASSERT_EQ(found["groups"].size(), 2U) << found["groups"];
    write_out();
    BcfFile file = read_bcf(bcf_);
    ASSERT_EQ(file.topics.size(), 2U);
    for (const Json& group : found["groups"])
        EXPECT_EQ(topic_of(file, group["id"]).priority, group["size"] == 4 ? "high" : "low");
    // The same question: no clash becomes active.
    EXPECT_EQ(clash(store_, options)["statuses"]["new"], 5);
    // A job that was asked later counts, and another order of clashes is not another question.
    clash(store_, {"--only", "type = Wall", "--sort", "volume"});
    std::filesystem::remove(bcf_);
    write_out();
    EXPECT_EQ(read_bcf(bcf_).topics.size(), 1U);
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);

    {
        Database database(store_, OpenMode::read_write);
        database.run("UPDATE question_terms SET terms = replace(terms, 'Wall', 'Pipe')");
    }
    expect_refused(review({"--bcf-out", bcf_}), {store_, "question"});
    expect_refused(run_abut({"info", store_, "--verify", "--quiet"}), {store_, "question"});
    {
        Database database(store_, OpenMode::read_write);
        database.run("DELETE FROM question_terms");
    }
    expect_refused(review({"--bcf-out", bcf_}), {store_, "rules"});

    // A condition that is longer as it is written than may be read is not kept.
    std::string types = "type = Wall";
    for (int i = 0; i < 20000; ++i)
        types += ",x*";
    clash(store_, {"--only", types});
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
    expect_refused(review({"--bcf-out", bcf_}), {store_, "rules"});
}

TEST_F(BcfFiles, TellTheirWarningsInJsonToo) {
    import(pipes_through_slab(5));
    const std::string slab = clash(store_)["groups"][0]["id"];
    write_out();
    BcfFile file = read_bcf(bcf_);
    for (const char* const text : {"one", "two"}) // the second gets a GUID, which is a warning
        topic_of(file, slab)
            .comments.push_back(comment("11111111-8f4e-4f0a-9f5e-0123456789ab", text));
    write_bcf(file, bcf_);
    const Json in = read_in();
    ASSERT_EQ(in["warnings"].size(), 1U) << in;
    const Json both =
        review({"--bcf-in", bcf_, "--bcf-out", folder_ / "out.bcf", "--no-snapshots", "--json"})
            .json();
    EXPECT_EQ(both["topics"], 2);
    EXPECT_EQ(both["bcf"], folder_ / "out.bcf");
    EXPECT_EQ(both["warnings"].size(), 1U) << both;
    EXPECT_TRUE(both.contains("revision"));
}

TEST_F(BcfFiles, AreRefusedWithAReason) {
    import(pipes_through_slab(5));
    expect_refused(review({"--bcf-out", bcf_}), {"no clash job"});
    clash(store_);
    expect_refused(review({"--bcf-in", bcf_}), {bcf_});
    std::ofstream(bcf_) << "PK but no archive";
    expect_refused(review({"--bcf-in", bcf_}), {bcf_});
    expect_refused(review({"--bcf-out", bcf_, "--forget-resolved"}), {"BCF"});
}

} // namespace
} // namespace abut::test
