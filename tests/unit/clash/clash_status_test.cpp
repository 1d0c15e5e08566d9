/// Ids of clashes, statuses in reports, and stores whose job tables were made by another version.
#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/store_clash.h>

#include "clash/clash_identity.h"
#include "clash/classify_pair.h"
#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"
#include "store/database/sqlite.h"
#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

namespace abut::test {
namespace {

TEST(ClashIdentity, DependsOnFilesPartsAndKindInAnyOrder) {
    const auto id = [](const char* file_a, const char* part_a, const char* file_b,
                       const char* part_b, ClashKind kind = ClashKind::hard) {
        return clash_identity(file_a, part_a, file_b, part_b, kind);
    };
    EXPECT_EQ(id("a.glb", "p", "b.glb", "q"), id("b.glb", "q", "a.glb", "p"));
    EXPECT_EQ(id("x/a.glb", "p", "b.glb", "q"), id("y/b.glb", "q", "a.glb", "p"));
    EXPECT_EQ(id("a.glb", "p", "a.glb", "q"), id("a.glb", "q", "a.glb", "p"));
    // Two model files of the same name: p in the first and q in the second differ from q and p.
    EXPECT_NE(id("x/a.glb", "p", "y/a.glb", "q"), id("x/a.glb", "q", "y/a.glb", "p"));
    const std::set<std::uint64_t> all{
        id("a.glb", "p", "b.glb", "q"), id("a.glb", "q", "b.glb", "p"),
        id("a.glb", "p", "b.glb", "q", ClashKind::touch), id("a.glb", "p", "a.glb", "q"),
        id("a.glb", "pq", "b.glb", "")};
    EXPECT_EQ(all.size(), 5U);
}

TEST(ClashIdentity, ReadsItsOwnText) {
    EXPECT_EQ(clash_id_text(0xABC), "0000000000000abc");
    EXPECT_EQ(parse_clash_id("0000000000000abc"), 0xABCU);
    EXPECT_EQ(parse_clash_id("ffffffffffffffff"), ~std::uint64_t{0});
    for (const char* const text : {"", "abc", "0000000000000ABC", "0x00000000000abc",
                                   "00000000000000abc", "-000000000000abc", "0000000000000abc "})
        EXPECT_FALSE(parse_clash_id(text)) << text;
}

TEST(ClassifyById, TheOrderOfThePartsChangesOnlySides) {
    const Model box(box_mesh({0, 0, 0}, {1, 1, 1})), ball(sphere_mesh(0.6, 16, 9));
    const Transform at_box, at_ball = Pose{.translation = {1.1, 0.4, 0.55}};
    const Box3 box_bounds{{0, 0, 0}, {1, 1, 1}}, ball_bounds{{0.5, -0.2, -0.05}, {1.7, 1.0, 1.15}};
    const ClashPart a{&box, nullptr, at_box, box_bounds}, b{&ball, nullptr, at_ball, ball_bounds};
    const auto one = classify_by_id(a, "box", b, "ball", 0, 0);
    auto other = classify_by_id(b, "ball", a, "box", 0, 0);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->kind, ClashKind::hard);
    EXPECT_EQ(one->point_a, other->point_b);
    EXPECT_EQ(one->distance, other->distance);
    exchange_sides(*other);
    EXPECT_EQ(one->point_a, other->point_a);
    EXPECT_EQ(one->direction, other->direction);
    EXPECT_NE(one->direction, (Vec3{0, 0, 0}));
}

TEST(ClashReports, HaveStatusesWhereAStoreKnowsThem) {
    const Folder folder;
    std::vector<Scene> models(1);
    models[0].file = "site.glb";
    models[0].parts = {{"p", "Pipe", "IfcPipe", 0, {}}, {"w", "Wall", "", 0, {}}};
    ClashReport report;
    Clash clash;
    clash.part = {0, 1};
    clash.status = ClashStatus::approved;
    clash.note = "so <it> is";
    report.clashes = {clash};
    report.statuses = {0, 0, 0, 1, 1};
    ListedClash gone;
    gone.id = 7;
    gone.status = ClashStatus::resolved;
    gone.part = {"p", "x"};
    gone.name = {"Pipe", "Door"};
    gone.file = {"site.glb", "old.glb"};
    gone.resolved = 1'000'000'000;
    report.resolved = {gone};
    const auto root = nlohmann::json::parse(to_json(report, models));
    EXPECT_EQ(root["statuses"], nlohmann::json::parse(R"({"new": 0, "active": 0, "reviewed": 0,
                                                          "approved": 1, "resolved": 1})"));
    EXPECT_EQ(root["clashes"][0]["status"], "approved");
    EXPECT_EQ(root["clashes"][0]["note"], "so <it> is");
    EXPECT_EQ(root["resolved"], nlohmann::json::parse(R"([{"id": "0000000000000007", "kind": "hard",
                  "status": "resolved", "a": "p", "b": "x", "a_name": "Pipe", "b_name": "Door",
                  "a_type": "", "b_type": "", "a_file": "site.glb", "b_file": "old.glb",
                  "distance": 0, "resolved": "2001-09-09T01:46:40Z"}])"));
    write_clash_html(report, models, folder / "report.html");
    std::ifstream file(folder / "report.html");
    const std::string html{std::istreambuf_iterator<char>(file), {}};
    const std::size_t start = html.find("<script type=\"application/json\" id=\"data\">");
    ASSERT_NE(start, std::string::npos);
    const std::size_t data = html.find('{', start);
    const auto page = nlohmann::json::parse(html.substr(data, html.find("</script>", data) - data));
    EXPECT_EQ(page["status"], nlohmann::json::array({3}));
    EXPECT_EQ(page["notes"][page["note"][0].get<std::size_t>()], "so <it> is");
    EXPECT_EQ(page["resolved"], root["resolved"]);
}

class JobTables : public testing::Test {
protected:
    void SetUp() override {
        Scene scene;
        scene.meshes = {box_mesh({0, 0, 0}, {1, 1, 1})};
        scene.parts = {{"a", "a", "", 0, {}},
                       {"b", "b", "", 0, Pose{.translation = {0.9, 0.2, 0.3}}},
                       {"c", "c", "", 0, Pose{.translation = {0.2, 0.9, -0.3}}}};
        write_glb(scene, folder_ / "a.glb");
        (void)import_models({folder_ / "a.glb"}, store_);
    }
    [[nodiscard]] StoreClashReport ask() const { return find_clashes(open_store(store_), {}); }

    Folder folder_;
    std::string store_ = folder_ / "a.abut";
};

TEST_F(JobTables, JsonOfAStoreIsThatOfItsReportAndReviews) {
    const StoreClashReport found = ask();
    auto root = nlohmann::ordered_json::parse(to_json(found));
    EXPECT_EQ(std::prev(root.end()).key(), "out_of_core");
    EXPECT_EQ(root["out_of_core"]["processes"].size(), found.counters.workers.size());
    EXPECT_EQ(root["out_of_core"]["kept"], true);
    root.erase("out_of_core");
    EXPECT_EQ(root, nlohmann::ordered_json::parse(to_json(found.report, found.models)));

    const std::vector<ClashReview> reviews = review_clashes(open_store(store_));
    ASSERT_EQ(reviews.size(), 1U);
    ASSERT_FALSE(reviews[0].clashes.empty());
    const auto list = nlohmann::ordered_json::parse(to_json(reviews, "a \"<store>\""));
    EXPECT_EQ(list["store"], "a \"<store>\"");
    ASSERT_EQ(list["questions"].size(), 1U);
    EXPECT_EQ(list["questions"][0], nlohmann::ordered_json::parse(to_json(reviews[0])));
}

/// The tables that the first version of jobs made: none for questions, statuses and row sums.
constexpr const char* kFirstTables = R"(
CREATE TABLE job(job INTEGER PRIMARY KEY AUTOINCREMENT, key BLOB NOT NULL UNIQUE,
  question BLOB NOT NULL, clearance REAL NOT NULL, touch REAL NOT NULL, self INTEGER NOT NULL,
  rules INTEGER NOT NULL, candidates INTEGER NOT NULL, run INTEGER NOT NULL,
  planned INTEGER NOT NULL, finished INTEGER NOT NULL);
CREATE TABLE job_unit(job INTEGER NOT NULL REFERENCES job, unit INTEGER NOT NULL,
  checksum INTEGER NOT NULL, pairs BLOB NOT NULL, PRIMARY KEY(job, unit));
CREATE TABLE clash(clash INTEGER PRIMARY KEY, job INTEGER NOT NULL REFERENCES job,
  id TEXT NOT NULL, exact BLOB NOT NULL, checksum INTEGER NOT NULL);
CREATE INDEX clash_by_job ON clash(job);
INSERT INTO job VALUES (9, x'00', x'01', 0, 0, 0, 0, 3, 1, 1, 1);
INSERT INTO clash VALUES (1, 9, 'an id', x'02', 5);)";

TEST_F(JobTables, TablesOfAnEarlierVersionAreReplaced) {
    Database(store_, OpenMode::read_write).run(kFirstTables);
    EXPECT_TRUE(review_clashes(open_store(store_)).empty());
    verify_jobs(open_store(store_));
    EXPECT_EQ(find_clashes(open_store(store_), {}, {.keep = false}).report.clashes.size(), 3U);
    const StoreClashReport found = ask();
    EXPECT_TRUE(found.counters.kept);
    EXPECT_EQ(found.counters.recalled_pairs, 0U);
    EXPECT_EQ(found.report.clashes.size(), 3U);
    EXPECT_EQ(ask().counters.recalled_pairs, 3U);
    verify_jobs(open_store(store_));
    verify(open_store(store_));
}

TEST_F(JobTables, TablesOfAnotherVersionAreReplacedAndMarksStay) {
    const StoreClashReport before = ask();
    const std::uint64_t id = before.report.clashes.at(1).id;
    mark_clashes(open_store(store_, {.read_only = false}), {{}, {id}, {}, "stays"});
    Database(store_, OpenMode::read_write)
        .run("DROP VIEW clash_status; DROP TABLE job; DROP TABLE job_unit; DROP TABLE clash");
    Database(store_, OpenMode::read_write).run(kFirstTables);
    const StoreClashReport after = ask();
    EXPECT_EQ(after.counters.recalled_pairs, 0U);
    ASSERT_EQ(after.report.clashes.size(), 3U);
    EXPECT_EQ(after.report.clashes[0].status, ClashStatus::active);
    EXPECT_EQ(after.report.clashes[1].status, ClashStatus::approved);
    EXPECT_EQ(after.report.clashes[1].note, "stays");
    verify_jobs(open_store(store_));
}

/// A store that a newer Abut is asked about tests all pairs again.
TEST_F(JobTables, AnswersOfAnotherVersionAreNotTakenOver) {
    const StoreClashReport before = ask();
    mark_clashes(open_store(store_, {.read_only = false}),
                 {{before.report.clashes.at(1).id}, {}, {}, {}});
    {
        Database database(store_, OpenMode::read_write);
        std::vector<JobRow> jobs = read_jobs(database);
        ASSERT_EQ(jobs.size(), 1U);
        jobs[0].answers = kAnswersVersion - 1;
        jobs[0].key = {1, 2}; // that of another version
        put_job(database, jobs[0]);
    }
    verify_jobs(open_store(store_));
    EXPECT_EQ(review_clashes(open_store(store_)).at(0).clashes.size(), 3U);
    const StoreClashReport after = ask();
    EXPECT_EQ(after.counters.recalled_pairs, 0U);
    ASSERT_EQ(after.report.clashes.size(), 3U);
    EXPECT_EQ(after.report.clashes[0].status, ClashStatus::active);
    EXPECT_EQ(after.report.clashes[1].status, ClashStatus::reviewed);
    EXPECT_EQ(ask().counters.recalled_pairs, 3U);
    verify_jobs(open_store(store_));
}

/// Each list notices rows that were deleted from it.
TEST_F(JobTables, MissingRowsAreErrors) {
    const StoreClashReport found = ask();
    mark_clashes(open_store(store_, {.read_only = false}),
                 {{found.report.clashes.at(0).id}, {}, {}, {}});
    for (const char* const table : {"job", "clash", "clash_history", "clash_mark"}) {
        std::filesystem::copy_file(store_, folder_ / "copy.abut",
                                   std::filesystem::copy_options::overwrite_existing);
        Database(folder_ / "copy.abut", OpenMode::read_write)
            .run((std::string("DELETE FROM ") + table).c_str());
        EXPECT_THROW(verify_jobs(open_store(folder_ / "copy.abut")), Error) << table;
        EXPECT_THROW((void)find_clashes(open_store(folder_ / "copy.abut"), {}), Error) << table;
    }
}

} // namespace
} // namespace abut::test
