// Paths of a carried part, against dense sampling with exact distances.

#include <abut/error.h>
#include <abut/maintenance_path.h>

#include "tests/support/rounds.h"
#include "tests/support/walk_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace abut::test {
namespace {

struct SampledPath {
    std::map<WalkPart, double> first; ///< time of the first sample that touches, in poses
    double least = HUGE_VAL;          ///< least distance from parts not touched at the start
};

SampledPath sample_path(const std::map<WalkPart, KnownPart>& known, const Probe& probe,
                        const std::vector<Pose>& poses, const Vec3& middle) {
    constexpr int kSamples = 25;
    SampledPath result;
    std::set<WalkPart> at_start;
    for (const auto& [number, part] : known)
        if (touches(part, probe, poses[0]))
            at_start.insert(number);
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const Motion motion = Motion::between(poses[i - 1], poses[i], middle);
        for (int k = 0; k <= kSamples; ++k) {
            const Transform world = at(motion, double(k) / kSamples);
            for (const auto& [number, part] : known) {
                if (at_start.contains(number))
                    continue;
                const double gap = gap_of(part, probe, world, Depths::no).distance;
                result.least = std::min(result.least, gap);
                if (gap <= 0)
                    result.first.try_emplace(number, double(i - 1) + double(k) / kSamples);
            }
        }
    }
    return result;
}

TEST(MaintenancePath, AgreesWithDenseSampling) {
    Random random(6521);
    int free = 0, met = 0, touched = 0, found = 0;
    for (int round = 0; round < many(5); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, false);
        Walk walk(open_store(path), {.prefetch = false});
        const auto known = parts_of(path);
        for (int i = 0; i < 6; ++i) {
            const SomeProbe probe = some_probe(random, {});
            const Box3& box = probe.probe.data().own_bounds();
            const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper;
            std::vector<Pose> poses;
            const double above = random.chance(0.6) ? 2 : 0.5;
            for (int k = random.integer(2, 4); k > 0; --k) {
                Pose pose = random.pose(0);
                pose.translation = {random.uniform(-3, 3), above + random.uniform(-0.5, 0.5),
                                    random.uniform(-3, 3)};
                poses.push_back(pose);
            }
            const PathOptions options{.largest_clearance = 1};
            const PathReport report = check_path(walk, probe.probe, poses, options);
            const SampledPath truth = sample_path(known, probe.probe, poses, middle);
            std::map<WalkPart, double> times;
            for (const PathContact& contact : report.contacts)
                times.emplace(contact.impact.part, contact.time);
            ASSERT_EQ(times.size(), report.contacts.size());
            for (const auto& [part, time] : truth.first) {
                ASSERT_TRUE(times.contains(part));
                ASSERT_LE(times.at(part), time);
            }
            touched += report.touched_at_start.empty() ? 0 : 1;
            if (!report.is_free()) {
                ++met;
                EXPECT_EQ(report.clearance.distance, 0);
                EXPECT_EQ(report.clearance.time, report.contacts.front().time);
                continue;
            }
            ++free;
            ASSERT_LE(report.clearance.at_least, truth.least);
            found += report.clearance.found ? 1 : 0;
            if (!report.clearance.found) {
                EXPECT_GE(report.clearance.at_least,
                          options.largest_clearance - options.clearance_error);
                continue;
            }
            // Attained, and no farther from the least than allowed.
            ASSERT_LE(report.clearance.distance, truth.least + options.clearance_error);
            EXPECT_GE(report.clearance.at_least,
                      report.clearance.distance - options.clearance_error);
            const auto segment =
                std::min(static_cast<std::size_t>(report.clearance.time), poses.size() - 2);
            const Motion motion = Motion::between(poses[segment], poses[segment + 1], middle);
            EXPECT_NEAR(gap_of(known.at(report.clearance.part), probe.probe,
                               at(motion, report.clearance.time - double(segment)), Depths::no)
                            .distance,
                        report.clearance.distance, 1e-9);
        }
    }
    std::cout << free << " free paths, " << met << " meet something, " << touched
              << " touch at the start\n";
    EXPECT_GT(free, 5);
    EXPECT_GT(found, 3);
    EXPECT_GT(met, 5);
    EXPECT_GT(touched, 0);
}

/// A pump on a base, a pipe planted above it, and a wall.
class PathByHand : public testing::Test {
protected:
    Store import_pump_room() {
        Scene scene;
        scene.meshes = {box_mesh({-5, -0.1, -5}, {5, 0, 5}),
                        box_mesh({-0.5, 0, -0.5}, {0.5, 1, 0.5}),
                        box_mesh({-5, 2, -0.1}, {5, 2.2, 0.1})};
        scene.parts = {{"base", "Base", "Slab", 0, {}},
                       {"pump", "Pump", "Pump", 1, translation(0, 0, 0)},
                       {"pipe", "Pipe", "Pipe", 2, {}}};
        write_glb(scene, folder_ / "room.glb");
        (void)import_models({folder_ / "room.glb"}, folder_ / "room.abut");
        return open_store(folder_ / "room.abut");
    }
    Folder folder_;
    Walk walk_{import_pump_room(), {.prefetch = false}};
    const WalkPart base_{1}, pump_{2}, pipe_{3};
};

TEST_F(PathByHand, ThePumpIsStoppedByThePipeAboveIt) {
    const Pose up{{0, 4, 0}};
    const PathReport blocked = check_path(walk_, pump_, std::vector{Pose{}, up});
    EXPECT_EQ(blocked.touched_at_start, std::vector{base_});
    ASSERT_EQ(blocked.contacts.size(), 1U);
    EXPECT_EQ(blocked.contacts[0].impact.part, pipe_);
    EXPECT_NEAR(blocked.contacts[0].time, 0.25, 1e-5);
    EXPECT_LE(blocked.contacts[0].time, 0.25);
    EXPECT_NEAR(blocked.contacts[0].impact.point_part.y, 2, 1e-5);

    const std::vector around{Pose{}, Pose{{0, 0.5, 0}}, Pose{{0, 0.5, 2}}, Pose{{0, 4, 2}}};
    const PathReport free = check_path(walk_, pump_, around);
    EXPECT_TRUE(free.is_free());
    EXPECT_NEAR(free.length, 6, 1e-12);
    ASSERT_TRUE(free.clearance.found);
    EXPECT_NEAR(free.clearance.distance, 0.5, 1e-3);
    EXPECT_EQ(free.clearance.part, pipe_);
    const auto json = nlohmann::json::parse(to_json(blocked, walk_));
    EXPECT_EQ(json.at("free"), false);
    EXPECT_EQ(json.at("contacts").at(0).at("name"), "Pipe");
    EXPECT_EQ(json.at("touched_at_start").at(0).at("id"), "base");
    EXPECT_THROW((void)check_path(walk_, pump_, std::vector<Pose>{}), Error);
    EXPECT_THROW((void)check_path(walk_, pump_, std::vector{Pose{{HUGE_VAL, 0, 0}}}), Error);
}

} // namespace
} // namespace abut::test
