#pragma once

#include <abut/mesh.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Robots as URDF describes them: links with shapes, joined to a tree by joints. docs/robots.md
/// shows how to use them. abut/robot.h has the queries.
namespace abut {

enum class JointType : std::uint8_t {
    fixed,
    revolute,   ///< rotates about the axis, within limits
    continuous, ///< rotates about the axis without limits
    prismatic,  ///< slides along the axis, within limits
    planar,     ///< moves in the plane that is normal to the axis, and rotates about the axis
    floating,   ///< moves freely
};
inline constexpr std::array kJointTypes{JointType::fixed,      JointType::revolute,
                                        JointType::continuous, JointType::prismatic,
                                        JointType::planar,     JointType::floating};
/// "fixed", "revolute", "continuous", "prismatic", "planar", "floating".
const char* to_string(JointType type);
/// The number of values that place a joint of this type: 0, 1, 3 (planar) or 6 (floating).
std::size_t variables_of(JointType type);

/// Bounds of a joint's value, in radians or metres.
struct JointLimits {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// The joint follows another one: value = multiplier * value of `joint` + offset.
struct JointMimic {
    std::uint32_t joint = 0; ///< index of a joint with one variable that follows none itself
    double multiplier = 1, offset = 0;
};

struct RobotJoint {
    std::string name;
    JointType type = JointType::fixed;
    std::uint32_t parent = 0, child = 0; ///< indices of links
    Transform parent_from_joint;         ///< the child's frame where all values are 0
    Vec3 axis{1, 0, 0};                  ///< unit vector in the joint's frame
    JointLimits limits;                  ///< of a revolute or prismatic joint
    std::optional<JointMimic> mimic{};
};

/// A collision shape of a link, as triangles.
struct RobotShape {
    std::string name; ///< the path of its mesh as the file has it, or "box", "cylinder", "sphere"
    Mesh mesh;        ///< in metres, in the shape's frame; scaled as the file says
    Transform link_from_shape;
    /// The mesh encloses the shape, and its surface is at most this far outside of it, in metres.
    /// 0 for a mesh and a box. Cylinders and spheres are polyhedra.
    double excess = 0;
};

struct RobotLink {
    std::string name;
    std::vector<RobotShape> shapes; ///< of collision; may be empty
};

/// A tree of links. Joints come parents first: a joint's parent link is the root, or the child of
/// an earlier joint.
struct RobotDescription {
    std::string name;
    std::string file; ///< path as given
    std::vector<RobotLink> links;
    std::vector<RobotJoint> joints;
    std::uint32_t root = 0;            ///< the link that no joint moves
    std::vector<std::string> warnings; ///< one line each: what the file has, but queries ignore
};

struct RobotReadOptions {
    /// Folders that are searched for the packages of `package://NAME/…`: the folder itself if it
    /// has that name, then its folder NAME. After them come the folders above the file, for
    /// packages with a package.xml, and those of the environment variable ROS_PACKAGE_PATH.
    std::vector<std::string> package_folders{};
    /// Reads the visual shapes in place of the collision shapes.
    bool visual = false;
    /// Options of the meshes' readers. Meshes outside the package, or (without a package) outside
    /// the folder of the file, are read only if `allow_outside_files` is set.
    ReadOptions read{};
};

/// Reads a robot from a URDF file, with its meshes. Equal mesh files are read once.
///
/// A mesh of COLLADA is scaled by its unit, but its up axis is ignored, as in ROS.
///
/// Errors      Error, naming the file, and the line and the element at fault: file_not_found,
///             unreadable, malformed (wrong XML; a joint or link that is missing, defined twice, or
///             part of a cycle; a number that is not finite; a size that is not positive; a mimic
///             joint that follows itself); also those of a mesh.
RobotDescription read_robot(const std::string& path, const RobotReadOptions& options = {});

/// The reason why a pair of links is not tested.
enum class AllowReason : std::uint8_t {
    adjacent, ///< a joint connects the links
    at_rest,  ///< the links meet in the default configuration
    always,   ///< the links meet in all configurations that were sampled
    never,    ///< the links meet in no configuration that was sampled
    user,     ///< someone has decided so
};
inline constexpr std::array kAllowReasons{AllowReason::adjacent, AllowReason::at_rest,
                                          AllowReason::always, AllowReason::never,
                                          AllowReason::user};
/// "Adjacent", "Default", "Always", "Never", "User", as in SRDF files.
const char* to_string(AllowReason reason);

/// A pair of links that may meet, so that queries leave it out. a < b.
struct AllowedPair {
    std::uint32_t a = 0, b = 0; ///< indices of links
    AllowReason reason = AllowReason::user;
    friend bool operator==(const AllowedPair&, const AllowedPair&) = default;
};

/// Values of some joints under a name: "ready".
struct NamedState {
    std::string name, group;
    std::vector<std::pair<std::string, std::vector<double>>> joints; ///< name and values
};

/// The content of an SRDF file that concerns collisions.
struct RobotSemantics {
    std::vector<AllowedPair> allowed; ///< sorted, each once
    std::vector<NamedState> states;
    std::vector<std::string> warnings; ///< one line each: links and joints that the robot lacks
};

/// Reads the allowed pairs and the named states of an SRDF file.
///
/// Errors      Error, naming the file and the line: file_not_found, unreadable, malformed.
RobotSemantics read_srdf(const std::string& path, const RobotDescription& robot);

/// Writes the allowed pairs as an SRDF file, atomically. If `base` names an SRDF file, its other
/// elements and comments are kept, and its pairs are replaced.
///
/// Errors      Error{cannot_write}, naming the file; those of `base` as read_srdf;
///             Error{bad_argument} if a pair names a link that is out of range.
void write_srdf(const RobotDescription& robot, const std::vector<AllowedPair>& allowed,
                const std::string& path, const std::string& base = {});

} // namespace abut
