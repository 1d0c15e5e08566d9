// Clashes as topics of BCF.
#include <abut/clash_bcf.h>
#include <abut/error.h>

#include "bcf/archive.h"
#include "clash/bcf/topic_fields.h"
#include "clash/bcf/topic_viewpoint.h"
#include "math/vector.h"
#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr const char* kGlobalId = "1jQQiGIAnFzxOUzrdmJYDS";

Scene scene_of(const std::string& file, const std::string& id, const Mesh& mesh, UpAxis up) {
    Scene scene;
    scene.file = file;
    scene.up = up;
    scene.meshes.push_back(mesh);
    scene.parts.push_back({id, "name of " + id, "Thing", 0, {}, {}});
    return scene;
}

std::vector<Scene> two_pipes(UpAxis up = UpAxis::z) {
    return {scene_of("folder/a.ifc", kGlobalId, box_mesh({10, 20, 30}, {14, 20.1, 30.1}), up),
            scene_of("b.glb", "pipe", box_mesh({11, 19, 30.02}, {11.1, 21, 30.08}), up)};
}

ClashBcfOptions at_noon() {
    ClashBcfOptions options;
    options.time = 1'772'352'000; // 2026-03-01T08:00:00Z
    return options;
}

TEST(ClashBcf, HasATopicForEachClash) {
    const std::vector<Scene> models = two_pipes();
    const ClashReport report = find_clashes(models, {});
    ASSERT_EQ(report.clashes.size(), 1U);
    ClashBcfOptions options = at_noon();
    options.snapshot = [](const ClashViewpoint&) { return std::string("png"); };
    const BcfFile file = clash_bcf(report, models, options);
    ASSERT_EQ(file.topics.size(), 1U);
    const BcfTopic& topic = file.topics[0];
    EXPECT_EQ(topic.title, std::string("name of ") + kGlobalId + " \u00D7 name of pipe");
    EXPECT_EQ(topic.status, "Open");
    EXPECT_EQ(topic.creation_date, "2026-03-01T08:00:00Z");
    EXPECT_EQ(topic.labels, std::vector<std::string>{"kind: hard"});
    ASSERT_EQ(topic.files.size(), 2U);
    EXPECT_EQ(topic.files[0].filename, "a.ifc");
    EXPECT_EQ(topic.files[0].reference, "folder/a.ifc");
    ASSERT_EQ(topic.viewpoints.size(), 1U);
    const BcfViewpoint& view = topic.viewpoints[0];
    EXPECT_EQ(view.snapshot, "png");
    ASSERT_EQ(view.selection.size(), 2U);
    EXPECT_EQ(view.selection[0], (BcfComponent{kGlobalId, "", ""}));
    EXPECT_EQ(view.selection[1], (BcfComponent{"", "b.glb", "pipe"}));
    ASSERT_EQ(view.colouring.size(), 2U);
    ASSERT_TRUE(view.perspective);
    EXPECT_EQ(view.perspective->size, 45);
    ASSERT_EQ(view.clipping_planes.size(), 6U);
    // The clash is in front of the camera and on the side of each plane that stays.
    const Vec3 point = report.clashes[0].point_a;
    EXPECT_GT(dot(point - view.perspective->view_point, view.perspective->direction), 0);
    for (const BcfClippingPlane& plane : view.clipping_planes)
        EXPECT_LT(dot(point - plane.location, plane.direction), 0);
    for (const BcfVersion version : {BcfVersion::v2_1, BcfVersion::v3_0}) {
        const std::string bytes = bcf_bytes(file, version);
        EXPECT_EQ(bcf_bytes(parse_bcf(bytes, "again"), version), bytes);
    }
}

TEST(ClashBcf, HasATopicForEachGroup) {
    std::vector<Scene> models = two_pipes();
    for (int i = 1; i < 5; ++i) {
        models[1].parts.push_back(models[1].parts[0]);
        models[1].parts.back().id += std::to_string(i);
        models[1].parts.back().world_from_mesh.m[9] = 0.5 * i;
    }
    ClashReport report = find_clashes(models, {});
    ASSERT_EQ(report.clashes.size(), 5U);
    for (Clash& clash : report.clashes)
        clash.severity = "high";
    report.grouping = {GroupBy::part};
    report.groups = group_clashes(report, models, {.by = report.grouping});
    const BcfFile file = clash_bcf(report, models, at_noon());
    ASSERT_EQ(file.topics.size(), 1U);
    const BcfTopic& topic = file.topics[0];
    EXPECT_EQ(topic.guid, group_topic_guid(report.groups[0].id));
    EXPECT_EQ(topic.title, report.groups[0].name);
    EXPECT_EQ(topic.viewpoints.at(0).selection.size(), 6U);
    EXPECT_EQ(topic.priority, "high");
    EXPECT_EQ(derived_priority(topic.description), "high");
    EXPECT_EQ(without_derived_line(topic.description), "");
    // A topic that a store has is what people say of the group.
    Topic said = topics_of_groups(report).at(0);
    said.status = "assigned";
    said.stage = "Tender";
    said.due = "2026-12-01";
    said.priority = "low";
    said.description = "Move them";
    said.created = 1'772'352'000;
    said.modified = said.created + 60;
    said.comments = {{"11111111-8f4e-4f0a-9f5e-0123456789ab", "me", "now", said.created, {}}};
    report.topics = {said};
    const BcfTopic stored = clash_bcf(report, models, at_noon()).topics.at(0);
    EXPECT_EQ(stored.status, "Assigned");
    EXPECT_EQ(stored.stage, "Tender");
    EXPECT_EQ(stored.due_date, "2026-12-01T00:00:00Z");
    EXPECT_EQ(stored.priority, "low");
    EXPECT_EQ(derived_priority(stored.description), "");
    EXPECT_EQ(without_derived_line(stored.description), "Move them");
    EXPECT_EQ(stored.modified_date, "2026-03-01T08:01:00Z");
    EXPECT_EQ(stored.comments.at(0).text, "now");
    // The store's change is later than the file's.
    EXPECT_EQ(update_bcf(file, clash_bcf(report, models, at_noon())).topics.at(0).status,
              "Assigned");
}

TEST(ClashBcf, HasZUpWhateverTheAxesOfTheModels) {
    const ClashReport upright = find_clashes(two_pipes(), {});
    const BcfFile expected = clash_bcf(upright, two_pipes(), at_noon());
    for (const UpAxis up : {UpAxis::x, UpAxis::y}) {
        std::vector<Scene> models = two_pipes();
        for (Scene& scene : models)
            turn_up(scene, up);
        const BcfFile file = clash_bcf(find_clashes(models, {}), models, at_noon());
        const BcfViewpoint &a = expected.topics[0].viewpoints[0], &b = file.topics[0].viewpoints[0];
        EXPECT_LT(length(a.perspective->view_point - b.perspective->view_point), 30);
        EXPECT_GT(b.perspective->up.z, 0.5);
        for (const BcfClippingPlane& plane : a.clipping_planes)
            EXPECT_TRUE(std::ranges::any_of(b.clipping_planes, [&](const BcfClippingPlane& other) {
                return length(plane.location - other.location) < 1e-9 &&
                       plane.direction == other.direction;
            }));
    }
}

TEST(ClashBcf, OfAStoreIsThatOfItsModels) {
    const Folder folder;
    const std::vector<std::string> files{folder / "a.glb", folder / "b.glb"};
    const std::vector<Scene> scenes = two_pipes(UpAxis::y);
    for (std::size_t i = 0; i < 2; ++i)
        write_glb(scenes[i], files[i]);
    const std::vector<Scene> models = read_scenes(files);
    const std::string path = folder / "site.abut";
    import_models(files, path);
    const Store store = open_store(path);
    BcfFile file = clash_bcf(find_clashes(store, {}), store, at_noon());
    EXPECT_EQ(bcf_revision(file), 0);
    file.entries.clear(); // the revision
    EXPECT_EQ(bcf_bytes(file, BcfVersion::v2_1),
              bcf_bytes(clash_bcf(find_clashes(models, {}), models, at_noon()), BcfVersion::v2_1));
}

TEST(ClashBcf, UpdatesWhatPeopleHaveChanged) {
    const std::vector<Scene> models = two_pipes();
    const ClashReport report = find_clashes(models, {});
    BcfFile edited = clash_bcf(report, models, at_noon());
    edited.topics.push_back({});
    edited.topics.back().guid = edited.topics.back().folder =
        "22222222-8f4e-4f0a-9f5e-0123456789ab";
    BcfTopic& topic = edited.topics[0];
    topic.status = "Closed";
    topic.assigned_to = "pipes@example.com";
    topic.labels.emplace_back("meeting 3");
    topic.comments.push_back({"11111111-8f4e-4f0a-9f5e-0123456789ab",
                              "2026-03-02T08:00:00Z",
                              "me",
                              "sleeve",
                              topic.viewpoints[0].guid,
                              {},
                              {},
                              {}});
    edited.entries.push_back({"notes.txt", "of another program"});
    ClashBcfOptions later = at_noon();
    later.time += 86400;
    later.snapshot = [](const ClashViewpoint&) { return std::string("new"); };
    const BcfFile file = update_bcf(edited, clash_bcf(report, models, later));
    ASSERT_EQ(file.topics.size(), 2U);
    const auto found = std::ranges::find(file.topics, topic.guid, &BcfTopic::guid);
    ASSERT_NE(found, file.topics.end());
    EXPECT_EQ(found->status, "Closed");
    EXPECT_EQ(found->assigned_to, "pipes@example.com");
    EXPECT_EQ(found->creation_date, "2026-03-01T08:00:00Z");
    EXPECT_EQ(found->comments, topic.comments);
    EXPECT_EQ(found->labels, (std::vector<std::string>{"kind: hard", "meeting 3"}));
    ASSERT_EQ(found->viewpoints.size(), 1U);
    EXPECT_EQ(found->viewpoints[0].snapshot, "new");
    EXPECT_EQ(file.entries.size(), 1U);
    // The same export again changes nothing.
    EXPECT_EQ(bcf_bytes(update_bcf(file, clash_bcf(report, models, later)), BcfVersion::v2_1),
              bcf_bytes(file, BcfVersion::v2_1));
}

TEST(ClashBcf, ReadsTimes) {
    EXPECT_EQ(bcf_time(0), "1970-01-01T00:00:00Z");
    EXPECT_EQ(parse_bcf_time("1970-01-02T00:00:00Z"), 86400);
    EXPECT_EQ(parse_bcf_time("2015-03-04T17:04:15+01:00"), 1425485055);
    EXPECT_EQ(parse_bcf_time("2015-04-01T06:28:17.6140576Z"), 1427869697);
    for (const char* text : {"", "2015", "2015-13-01", "2015-02-30T00:00:00Z",
                             "2015-01-01T25:00:00", "2015-01-01T00:00:00+99:00", "today"})
        EXPECT_FALSE(parse_bcf_time(text)) << text;
    EXPECT_EQ(without_derived_line("a\nFound by Abut: 1 hard\nb"), "a\nb");
    EXPECT_EQ(without_derived_line("Found by Abut: 1 hard"), "");
    EXPECT_EQ(without_derived_line("mine"), "mine");
}

} // namespace
} // namespace abut::test
