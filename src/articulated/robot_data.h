#pragma once

#include <abut/convex.h>
#include <abut/robot.h>

#include "articulated/kinematics.h"

#include <span>
#include <utility>
#include <vector>

namespace abut {

/// A shape that is ready for queries: one of a link, or an obstacle.
struct RobotBody {
    std::uint32_t owner = 0; ///< index of the link or the obstacle
    Model model;
    Transform owner_from_model;
    Vec3 centre;                ///< of a ball that encloses the shape, in the owner's frame
    double radius = 0;          ///< of that ball, rounded up
    bool is_solid = false;      ///< its surface is closed
    Box3 box;                   ///< of the model, in its own frame
    std::vector<Vec3> vertices; ///< one of each connected component, in the model's frame
    Convex hull;                ///< of the surface, in the model's frame
};

/// Returns nothing for a mesh without triangles.
std::vector<RobotBody> make_body(std::uint32_t owner, const Model& model,
                                 const Transform& owner_from_model);

/// Two bodies to be tested: indices.
struct BodyTest {
    std::uint32_t a = 0, b = 0;
};

class RobotData {
public:
    RobotData(RobotDescription description, const RobotOptions& options);

    /// Errors      Error{bad_argument} if the configuration has the wrong length or a value that is
    ///             not finite or too large.
    void require_valid(std::span<const double> configuration) const;

    RobotDescription description;
    JointVariables joints;
    std::vector<RobotBody> bodies;                              ///< sorted by link
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs; ///< of links, sorted
    std::vector<BodyTest> tests;                                ///< of the pairs of links, in order
    std::vector<AllowedPair> allowed;                           ///< as given
    /// For each link, the joint that moves it; none for the root.
    std::vector<std::uint32_t> joint_above;
};

class ObstacleData {
public:
    explicit ObstacleData(std::vector<RobotObstacle> obstacles);

    std::vector<RobotObstacle> list;
    std::vector<RobotBody> bodies; ///< sorted by obstacle
};

inline constexpr std::uint32_t kNoJoint = ~std::uint32_t{0};

} // namespace abut
