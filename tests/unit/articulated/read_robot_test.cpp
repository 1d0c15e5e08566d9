// URDF and SRDF files, and what they cannot be.

#include <abut/error.h>
#include <abut/robot.h>

#include "tests/support/folder.h"

#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace abut::test {
namespace {

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class ReadRobotTest : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& content) {
        std::filesystem::create_directories(std::filesystem::path(folder_ / name).parent_path());
        std::ofstream(folder_ / name) << content;
        return folder_ / name;
    }
    RobotDescription read(const std::string& inside, const RobotReadOptions& options = {}) {
        return read_robot(write("a.urdf", "<robot name='a'>\n" + inside + "\n</robot>\n"), options);
    }
    std::string error_of(const std::string& inside) {
        try {
            read(inside);
        } catch (const Error& error) {
            const std::string text = error.what();
            const std::string start = (folder_ / "a.urdf") + ": ";
            EXPECT_TRUE(text.starts_with(start)) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            return text.substr(std::min(start.size(), text.size()));
        }
        return "no error";
    }
    Folder folder_;
};

const std::string kTwoLinks = R"(<link name="base"/><link name="arm"/>)";

TEST_F(ReadRobotTest, JointsComeParentsFirstAndElseInTheOrderOfTheFile) {
    const RobotDescription robot = read(R"(
      <link name="c"/><link name="b"/><link name="a"/><link name="d"/>
      <joint name="bc" type="fixed"><parent link="b"/><child link="c"/></joint>
      <joint name="ad" type="continuous"><parent link="a"/><child link="d"/></joint>
      <joint name="ab" type="prismatic"><parent link="a"/><child link="b"/>
        <axis xyz="0 0 2"/><limit lower="-1" upper="3"/></joint>)");
    ASSERT_EQ(robot.joints.size(), 3);
    EXPECT_EQ(robot.joints[0].name, "ad");
    EXPECT_EQ(robot.joints[1].name, "ab");
    EXPECT_EQ(robot.joints[2].name, "bc");
    EXPECT_EQ(robot.links[robot.root].name, "a");
    EXPECT_EQ(robot.joints[1].axis, (Vec3{0, 0, 1}));
    EXPECT_EQ(robot.joints[1].limits.lower, -1);
    EXPECT_EQ(robot.joints[1].limits.upper, 3);
}

TEST_F(ReadRobotTest, ShapesAreScaledAndPlaced) {
    write("meshes/t.obj", kTriangle);
    const RobotDescription robot = read(R"(<link name="base">
      <collision><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
        <geometry><mesh filename="meshes/t.obj" scale="1 -2 1"/></geometry></collision>
      <collision><geometry><!-- was: <sphere/> --><box size="1 2 3"/></geometry></collision>
      <collision><geometry><cylinder radius="1" length="4"/></geometry></collision>
      <collision><geometry><sphere radius="2"/></geometry></collision></link>)");
    ASSERT_EQ(robot.links[0].shapes.size(), 4);
    const RobotShape& mesh = robot.links[0].shapes[0];
    EXPECT_EQ(mesh.mesh.positions[2], (Vec3{0, -2, 0}));
    // A mirrored triangle is turned over.
    EXPECT_EQ(mesh.mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));
    EXPECT_NEAR(mesh.link_from_shape.m[1], 1, 1e-15); // x becomes y
    EXPECT_EQ(mesh.link_from_shape.m[9], 1);
    for (std::size_t i = 1; i < 4; ++i) {
        const RobotShape& shape = robot.links[0].shapes[i];
        const MeshReport report = inspect(shape.mesh);
        EXPECT_TRUE(report.closed) << shape.name;
        EXPECT_EQ(report.flipped_edges, 0) << shape.name;
    }
    // The polyhedra enclose their shapes, and hardly more.
    EXPECT_EQ(robot.links[0].shapes[1].excess, 0);
    EXPECT_LT(robot.links[0].shapes[2].excess, 0.002);
    EXPECT_LT(robot.links[0].shapes[3].excess, 0.03);
    EXPECT_GT(robot.links[0].shapes[3].excess, 0);
}

TEST_F(ReadRobotTest, PackagesAreFoundAboveTheFileAndInGivenFolders) {
    write("kit/meshes/t.obj", kTriangle);
    const std::string link =
        R"(<link name="base"><collision><geometry><mesh filename="package://kit/meshes/t.obj"/>
           </geometry></collision></link>)";
    const std::string inside = "<robot name='a'>" + link + "</robot>";
    const std::string in_kit = write("kit/urdf/in.urdf", inside);
    EXPECT_THROW(read_robot(in_kit), Error) << "any folder above the file was taken for a package";
    write("kit/package.xml", "<package/>");
    EXPECT_EQ(read_robot(in_kit).links[0].shapes.size(), 1);
    const Folder other;
    std::ofstream(other / "b.urdf") << inside;
    EXPECT_THROW(read_robot(other / "b.urdf"), Error);
    const std::string parent = std::filesystem::path(folder_ / "x").parent_path();
    EXPECT_EQ(read_robot(other / "b.urdf", {.package_folders = {parent}}).links.size(), 1);
    EXPECT_EQ(read_robot(other / "b.urdf", {.package_folders = {folder_ / "kit"}}).links.size(), 1);
}

TEST_F(ReadRobotTest, MeshesOutsideOfTheFolderAreRefused) {
    write("t.obj", kTriangle);
    const std::string path =
        write("in/a.urdf", "<robot name='a'><link name='base'><collision><geometry>"
                           "<mesh filename='../t.obj'/></geometry></collision></link></robot>");
    EXPECT_THROW(read_robot(path), Error);
    RobotReadOptions options;
    options.read.allow_outside_files = true;
    EXPECT_EQ(read_robot(path, options).links[0].shapes.size(), 1);
}

TEST_F(ReadRobotTest, MimicJointsFollowTheFirstSource) {
    const RobotDescription robot = read(R"(<link name="a"/><link name="b"/><link name="c"/>
      <link name="d"/>
      <joint name="1" type="continuous"><parent link="a"/><child link="b"/></joint>
      <joint name="2" type="continuous"><parent link="b"/><child link="c"/>
        <mimic joint="1" multiplier="2" offset="1"/></joint>
      <joint name="3" type="continuous"><parent link="c"/><child link="d"/>
        <mimic joint="2" multiplier="-3" offset="0.5"/></joint>)");
    ASSERT_TRUE(robot.joints[2].mimic);
    EXPECT_EQ(robot.joints[2].mimic->joint, 0);
    EXPECT_EQ(robot.joints[2].mimic->multiplier, -6);
    EXPECT_EQ(robot.joints[2].mimic->offset, -2.5);
    EXPECT_EQ(Robot(robot).variables().size(), 1);
}

TEST_F(ReadRobotTest, FaultsNameLineAndElement) {
    EXPECT_EQ(error_of("<link name='a'/>\n<link name='a'/>"),
              "line 3: the link 'a' is defined twice");
    EXPECT_EQ(error_of("<link/>"), "line 2: <link> needs the attribute 'name'");
    EXPECT_EQ(error_of(""), "line 1: the robot has no link");
    EXPECT_EQ(error_of(kTwoLinks), "line 1: no joint connects the links 'base' and 'arm'");
    EXPECT_EQ(error_of(kTwoLinks + "<joint name='j' type='hinge'/>"),
              "line 2: the type 'hinge' of joint 'j' is unknown");
    EXPECT_EQ(error_of(kTwoLinks + "\n<joint name='j' type='fixed'>\n<parent link='base'/>\n"
                                   "<child link='leg'/></joint>"),
              "line 5: the child link 'leg' of joint 'j' is not defined");
    EXPECT_EQ(error_of(kTwoLinks + "<joint name='j' type='revolute'><parent link='base'/>"
                                   "<child link='arm'/></joint>"),
              "line 2: the revolute joint 'j' needs a <limit>");
    EXPECT_EQ(error_of(kTwoLinks + "<joint name='j' type='continuous'><parent link='base'/>"
                                   "<child link='arm'/>\n<axis xyz='0 0 0'/></joint>"),
              "line 3: the axis of joint 'j' has no direction");
    EXPECT_EQ(error_of(kTwoLinks + "<joint name='j' type='fixed'><origin xyz='0 nan 0'/>"
                                   "<parent link='base'/><child link='arm'/></joint>"),
              "line 2: the attribute 'xyz' of <origin> is not 3 finite numbers");
    EXPECT_EQ(error_of("<link name='a'><collision><geometry><sphere radius='-1'/></geometry>"
                       "</collision></link>"),
              "line 2: the radius of <sphere> is not positive");
    EXPECT_EQ(error_of("<link name='a'><collision><geometry/></collision></link>"),
              "line 2: the shape of link 'a' is missing");
    EXPECT_EQ(error_of("<link name='a'><collision><geometry><mesh filename='no.stl'/></geometry>"
                       "</collision></link>"),
              "link 'a': the mesh 'no.stl' does not exist");
    EXPECT_EQ(error_of("<link name='a'>").substr(0, 5), "line ");
}

TEST_F(ReadRobotTest, CyclesAndSecondParentsAreFaults) {
    const std::string joint =
        "<joint name='%' type='fixed'><parent link='@'/><child link='&'/></joint>";
    const auto of = [&](char name, char parent, char child) {
        std::string text = joint;
        for (char& c : text)
            c = c == '%' ? name : c == '@' ? parent : c == '&' ? child : c;
        return text;
    };
    const std::string links = "<link name='a'/><link name='b'/><link name='c'/>";
    EXPECT_EQ(error_of(links + of('1', 'a', 'b') + of('2', 'b', 'c') + of('3', 'c', 'a')),
              "line 2: the joints form a cycle through link 'a'");
    EXPECT_EQ(error_of(links + of('1', 'b', 'c') + "\n" + of('2', 'c', 'b')),
              "line 2: the joint '1' is part of a cycle");
    EXPECT_EQ(error_of(links + of('1', 'a', 'c') + "\n" + of('2', 'b', 'c')),
              "line 3: the link 'c' has two parents, by the joints '1' and '2'");
    EXPECT_EQ(error_of(links + of('1', 'a', 'b') + "\n" + of('2', 'a', 'a')),
              "line 2: the joint '1' is part of a cycle");
}

TEST_F(ReadRobotTest, JointsThatFollowThemselvesAreFaults) {
    const auto follower = [](const std::string& name, const std::string& source,
                             const std::string& child) {
        return "<joint name='" + name + "' type='continuous'><parent link='base'/><child link='" +
               child + "'/><mimic joint='" + source + "'/></joint>";
    };
    EXPECT_EQ(error_of(kTwoLinks + follower("1", "1", "arm")), "line 2: joint '1' follows itself");
    EXPECT_EQ(error_of(kTwoLinks + "<link name='leg'/>" + follower("1", "2", "arm") +
                       follower("2", "1", "leg")),
              "line 2: joint '1' follows itself");
    EXPECT_EQ(error_of(kTwoLinks + follower("1", "0", "arm")),
              "line 2: the joint '0' that joint '1' follows is not defined");
}

TEST_F(ReadRobotTest, SemanticsAreReadAndWritten) {
    const RobotDescription robot = read(kTwoLinks + R"(<link name="leg"/>
      <joint name="j" type="continuous"><parent link="base"/><child link="arm"/></joint>
      <joint name="k" type="continuous"><parent link="base"/><child link="leg"/></joint>)");
    const std::string path = write("a.srdf", R"(<robot name="a"><group name="g"/>
      <group_state name="up" group="g"><joint name="j" value="1.5"/><joint name="z" value="0"/>
      </group_state>
      <disable_collisions link1="leg" link2="base" reason="Adjacent"/>
      <disable_collisions link1="base" link2="leg" reason="Never"/>
      <disable_collisions link1="arm" link2="tail" reason="Never"/></robot>)");
    const RobotSemantics semantics = read_srdf(path, robot);
    ASSERT_EQ(semantics.allowed.size(), 1);
    EXPECT_EQ(semantics.allowed[0], (AllowedPair{0, 2, AllowReason::adjacent}));
    ASSERT_EQ(semantics.states.size(), 1);
    EXPECT_EQ(semantics.states[0].joints[0].second, std::vector<double>{1.5});
    EXPECT_EQ(semantics.warnings.size(), 2);

    const std::vector<AllowedPair> pairs{{0, 1, AllowReason::adjacent}, {1, 2, AllowReason::never}};
    write_srdf(robot, pairs, folder_ / "b.srdf", path);
    const RobotSemantics again = read_srdf(folder_ / "b.srdf", robot);
    EXPECT_EQ(again.allowed, pairs);
    EXPECT_EQ(again.states.size(), 1);
    write_srdf(robot, {}, folder_ / "c.srdf");
    EXPECT_TRUE(read_srdf(folder_ / "c.srdf", robot).allowed.empty());
}

} // namespace
} // namespace abut::test
