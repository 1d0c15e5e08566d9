#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/error.h>
#include <abut/topics.h>

#include "clash/groups/group_facts.h"
#include "clash/report/group_json.h"
#include "massive/coordination/topic_merge.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Two models: a slab and a wall, and six pipes. `clashes` are pairs of a slab (0) or wall (1) and a
/// pipe.
struct Site {
    std::vector<Scene> models{2};
    ClashReport report;

    Site() {
        models[0].file = "a/structure.ifc";
        models[0].parts = {{"s", "Floor 1", "IfcSlab", 0, {}, {}}, {"w", "", "IfcWall", 0, {}, {}}};
        models[1].file = "b/pipes.ifc";
        for (int i = 0; i < 6; ++i)
            models[1].parts.push_back({"p" + std::to_string(i),
                                       "Pipe",
                                       i < 4 ? "IfcPipeSegment" : "IfcValve",
                                       0,
                                       {},
                                       {}});
        report.frame.up = UpAxis::z;
    }
    void add(std::uint32_t a, std::uint32_t pipe, const Vec3& at, double distance = -0.1) {
        Clash clash;
        clash.id = 100 + report.clashes.size();
        clash.model = {0, 1};
        clash.part = {a, pipe};
        clash.point_a = clash.point_b = at;
        clash.distance = distance;
        report.clashes.push_back(clash);
    }
};

TEST(ClashGroups, OfASharedPartAndOfPlaces) {
    Site site;
    for (std::uint32_t i = 0; i < 5; ++i)
        site.add(0, i, {double(i), 0, 3}, -0.01 * (i + 1));
    site.add(1, 5, {50, 20, 3});
    const auto groups = group_clashes(site.report, site.models);
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[0].name, "Floor 1");
    EXPECT_EQ(groups[0].what, "4 IfcPipeSegment, 1 IfcValve");
    EXPECT_EQ(groups[0].key, "structure.ifc/s");
    EXPECT_EQ(groups[0].kind, GroupKind::part);
    EXPECT_EQ(groups[0].part, (std::array<std::uint32_t, 2>{0, 0}));
    EXPECT_EQ(groups[0].clashes, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(groups[0].counts[0], 5U);
    EXPECT_EQ(groups[0].deepest, -0.05);
    EXPECT_EQ(groups[0].bounds.upper.x, 4);
    EXPECT_EQ(groups[1].kind, GroupKind::place);
    EXPECT_EQ(groups[1].name, "IfcValve \u00D7 IfcWall near 50.0, 20.0, height 3.0 m");
    // Ids are the same in every version: topics rest on them.
    EXPECT_EQ(groups[0].id, "77231720a131ac5e");
    EXPECT_EQ(group_topic_guid(groups[0].id), "4862589a-187e-5f35-b7f6-86192461bfe6");
}

TEST(ClashGroups, NamesOfTheSameKindAreToldApart) {
    Site site;
    for (std::uint32_t i = 0; i < 6; ++i)
        site.add(i % 2, i, {30.0 * i, 0, 0});
    site.models[0].parts[1].name = "Floor 1";
    const auto groups = group_clashes(site.report, site.models, {.by = {GroupBy::part}});
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_NE(groups[0].name, groups[1].name);
    EXPECT_TRUE(groups[0].name.starts_with("Floor 1 ["));
}

TEST(ClashGroups, PropertiesAreThoseOfBothParts) {
    Site site;
    site.add(0, 0, {});
    site.add(1, 5, {});
    const auto storeys = group_clashes(site.report, site.models, {.by = {GroupBy::storey}});
    ASSERT_EQ(storeys.size(), 1U);
    EXPECT_EQ(storeys[0].name, "no storey");
    PropertiesBuilder first, second;
    first.add("storey", "Level 10");
    site.models[0].properties = first.finish(2);
    second.add("storey", "Level 2");
    site.models[1].properties = second.finish(6);
    const auto levels =
        group_clashes(site.report, site.models, {.by = {GroupBy::storey, GroupBy::discipline}});
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].name, "no storey");
    EXPECT_EQ(levels[1].name, "Level 2");
    EXPECT_EQ(levels[1].groups.at(0).name, "pipes \u00D7 structure");
}

TEST(ClashGroups, NaturalOrder) {
    EXPECT_TRUE(natural_less("Level 2", "Level 10"));
    EXPECT_FALSE(natural_less("Level 10", "Level 2"));
    EXPECT_TRUE(natural_less("Level 02", "Level 3"));
    EXPECT_TRUE(natural_less("", "a"));
    EXPECT_TRUE(natural_less("a2", "a2b"));
    EXPECT_FALSE(natural_less("a", "a"));
    EXPECT_NE(natural_less("a01", "a1"), natural_less("a1", "a01"));
}

TEST(ClashGroups, RefusesWhatIsNoGrouping) {
    EXPECT_THROW((void)parse_grouping(""), Error);
    EXPECT_THROW((void)parse_grouping("part,"), Error);
    EXPECT_EQ(to_string(parse_grouping("storey,part")), "storey,part");
    const Site site;
    EXPECT_THROW((void)group_clashes(site.report, site.models, {.by = {}}), Error);
    EXPECT_THROW((void)group_clashes(site.report, site.models, {.reach = -1}), Error);
    EXPECT_TRUE(group_clashes(site.report, site.models).empty());
}

TEST(Topics, TimesAreParsed) {
    EXPECT_EQ(parse_time("1970-01-02"), 86400);
    EXPECT_EQ(parse_time("2026-11-22T10:00:00Z"), parse_time("2026-11-22T11:00:00.123+01:00"));
    EXPECT_EQ(time_text(parse_time("2026-11-22T10:00:05Z").value()), "2026-11-22T10:00:05Z");
    EXPECT_EQ(parse_time("2026-11-22T10:00Z"), parse_time("2026-11-22T10:00:00Z"));
    for (const char* const text : {"", "2026", "2026-13-01", "2026-02-30", "2026-01-01Tx", "today",
                                   "2026-01-01T10", "2026-01-01T10:00:00+x", "2026-01-01T25:00Z",
                                   "2026-01-01T10:00:00X01:00", "9999-12-31T23:00-02:00"})
        EXPECT_FALSE(parse_time(text)) << text;
}

TEST(Topics, FieldsAreMergedOneByOne) {
    Topic base;
    base.guid = "g";
    base.title = "Floor";
    base.status = "open";
    base.labels = {"a", "b"};
    base.comments = {{"c1", "A", "one", 1, ""}, {"c2", "A", "two", 2, ""}};
    Topic stored = base, edited = base;
    stored.assignee = "Hydra";
    stored.status = "assigned";
    stored.labels = {"a", "b", "c"};
    stored.comments[1].text = "two, changed";
    edited.status = "closed";
    edited.priority = "high";
    edited.labels = {"b", "d"};
    edited.comments = {{"c3", "B", "three", 3, ""}};
    std::vector<TopicConflict> conflicts;
    const Topic merged = merge_topic(base, stored, edited, conflicts);
    EXPECT_EQ(merged.assignee, "Hydra");
    EXPECT_EQ(merged.priority, "high");
    EXPECT_EQ(merged.status, "assigned");
    EXPECT_EQ(merged.labels, (std::vector<std::string>{"b", "c", "d"}));
    // The first comment was removed; the second was changed meanwhile, so it stays.
    ASSERT_EQ(merged.comments.size(), 2U);
    EXPECT_EQ(merged.comments[0].text, "two, changed");
    EXPECT_EQ(merged.comments[1].text, "three");
    ASSERT_EQ(conflicts.size(), 1U);
    EXPECT_EQ(conflicts[0].field, "status");
    EXPECT_EQ(conflicts[0].stored, "assigned");
    EXPECT_EQ(conflicts[0].edited, "closed");
    // Merging again changes nothing.
    conflicts.clear();
    EXPECT_EQ(merge_topic(base, merged, merged, conflicts), merged);
    EXPECT_TRUE(conflicts.empty());
}

} // namespace
} // namespace abut::test
