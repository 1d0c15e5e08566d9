// Real robots: files as vendors publish them.

#include <abut/error.h>
#include <abut/robot.h>

#include "tests/support/folder.h"
#include "tests/support/paths.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace abut::test {
namespace {

struct RobotFiles {
    const char* name;
    const char* urdf;
    const char* srdf;
    std::size_t links, joints, variables, shapes;
    std::size_t allowed, warnings; ///< of the SRDF file: states name joints that the URDF lacks
};

const RobotFiles kRobots[]{
    {"panda", "moveit_resources_panda_description/urdf/panda.urdf",
     "moveit_resources_panda_moveit_config/config/panda.srdf", 12, 11, 8, 11, 34, 0},
    {"fanuc", "moveit_resources_fanuc_description/urdf/fanuc.urdf",
     "moveit_resources_fanuc_moveit_config/config/fanuc.srdf", 9, 8, 6, 7, 10, 0},
    {"ur5", "example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
     "example-robot-data/robots/ur_description/srdf/ur5.srdf", 11, 10, 6, 8, 10, 0},
    {"pr2", "example-robot-data/robots/pr2_description/urdf/pr2.urdf",
     "example-robot-data/robots/pr2_description/srdf/pr2.srdf", 82, 81, 20, 32, 1161, 0},
    {"talos", "example-robot-data/robots/talos_data/robots/talos_reduced.urdf",
     "example-robot-data/robots/talos_data/srdf/talos.srdf", 60, 59, 32, 52, 459, 1},
    {"icub", "example-robot-data/robots/icub_description/robots/icub.urdf",
     "example-robot-data/robots/icub_description/srdf/icub.srdf", 56, 55, 32, 28, 0, 1},
    {"hyq", "example-robot-data/robots/hyq_description/robots/hyq_no_sensors.urdf",
     "example-robot-data/robots/hyq_description/srdf/hyq.srdf", 19, 18, 12, 17, 42, 2},
    {"solo", "example-robot-data/robots/solo_description/robots/solo.urdf",
     "example-robot-data/robots/solo_description/srdf/solo.srdf", 13, 12, 8, 13, 4, 18},
};

class RealRobots : public testing::TestWithParam<RobotFiles> {};

TEST_P(RealRobots, AreReadAndChecked) {
    const RobotFiles& files = GetParam();
    const std::string folder = std::string(ABUT_SHARED_DATA) + "/robots/";
    if (!std::filesystem::exists(folder + files.urdf))
        GTEST_SKIP() << folder + files.urdf << " is not there";
    RobotDescription description = read_robot(folder + files.urdf);
    const RobotSemantics semantics = read_srdf(folder + files.srdf, description);
    std::size_t shapes = 0;
    for (const RobotLink& link : description.links)
        shapes += link.shapes.size();
    const Robot robot(description, {.allowed = semantics.allowed});
    EXPECT_EQ(description.links.size(), files.links);
    EXPECT_EQ(description.joints.size(), files.joints);
    EXPECT_EQ(robot.variables().size(), files.variables);
    EXPECT_EQ(shapes, files.shapes);
    EXPECT_EQ(semantics.allowed.size(), files.allowed);
    EXPECT_EQ(semantics.warnings.size(), files.warnings);
    for (const RobotPair& pair : collide(robot, robot.default_configuration()))
        std::cout << "  meet at rest: " << description.links[pair.link].name << " and "
                  << description.links[pair.other].name << '\n';
    for (const NamedState& state : semantics.states)
        EXPECT_FALSE(state.name.empty());
    const auto proposed = propose_allowed_pairs(robot, {.samples = 100});
    EXPECT_GE(proposed.size(), 1);
}

INSTANTIATE_TEST_SUITE_P(Data, RealRobots, testing::ValuesIn(kRobots),
                         [](const auto& each) { return std::string(each.param.name); });

} // namespace
} // namespace abut::test
