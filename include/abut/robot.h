#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/robot_description.h>
#include <abut/types.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// Queries on a robot in some configuration: its links with each other, and with obstacles.
/// docs/robots.md explains them.
///
/// A configuration has one number for each variable of the robot, in the order of
/// `Robot::variables()`: radians, or metres. Shapes that bound a solid are solid: a link inside
/// another one meets it.
namespace abut {

class RobotData;

/// A number that places a joint.
struct RobotVariable {
    std::string name; ///< of its joint; with "/x", "/y", "/z", "/rx", … if that has several
    std::uint32_t joint = 0;
    JointLimits limits; ///< infinite where there are none
    bool is_angle = false;
};

struct RobotOptions {
    /// Pairs of links that are not tested, such as those of `read_srdf`.
    std::vector<AllowedPair> allowed{};
    /// Also leaves out the pairs of links that a joint connects. Links without shapes between them
    /// do not count.
    bool allow_adjacent = true;
};

/// A robot that is ready for queries. Immutable: copies share the data, and any number of threads
/// may query it.
class Robot {
public:
    /// Builds the hierarchies of its meshes.
    ///
    /// Errors      Error{bad_argument} if an index of the description is out of range, a number is
    ///             not finite, limits leave no value, or its joints are no tree in the order that
    ///             RobotDescription states; Error{bad_mesh}, naming the link.
    explicit Robot(RobotDescription description, const RobotOptions& options = {});

    [[nodiscard]] const RobotDescription& description() const noexcept;
    /// The variables in the order of the joints. Joints that follow others have none.
    [[nodiscard]] const std::vector<RobotVariable>& variables() const noexcept;
    /// Every variable is 0, or the limit that is nearest to 0.
    [[nodiscard]] std::vector<double> default_configuration() const;
    /// The pairs of links that are tested, as a < b, sorted.
    [[nodiscard]] const std::vector<std::pair<std::uint32_t, std::uint32_t>>&
    pairs() const noexcept;
    /// Returns the place of every link.
    ///
    /// Errors      of this function and all queries: Error{bad_argument} if a configuration has the
    ///             wrong length, or if one of its values, or the value that a joint which follows
    ///             another one gets, is not finite or is beyond 1e9.
    [[nodiscard]] std::vector<Transform>
    link_transforms(std::span<const double> configuration) const;
    /// Returns the indices of the variables that are beyond their limits by more than 1e-9.
    [[nodiscard]] std::vector<std::uint32_t>
    beyond_limits(std::span<const double> configuration) const;
    [[nodiscard]] const RobotData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const RobotData> data_;
};

/// Something that stands still in the robot's world.
struct RobotObstacle {
    std::string name;
    Model model;
    Transform world_from_model{};
};

class ObstacleData;

/// Obstacles that are ready for queries. Immutable: copies share the data, and any number of threads
/// may use it.
class RobotObstacles {
public:
    RobotObstacles() = default;
    /// Errors      Error{bad_argument}, naming the obstacle, if a transform is not finite.
    /// Cost        that of a convex hull of each model.
    explicit RobotObstacles(std::vector<RobotObstacle> obstacles);

    [[nodiscard]] const std::vector<RobotObstacle>& list() const noexcept;
    [[nodiscard]] const ObstacleData* data() const noexcept { return data_.get(); }

private:
    std::shared_ptr<const ObstacleData> data_;
};

/// A link, and another link or an obstacle.
struct RobotPair {
    std::uint32_t link = 0;
    std::uint32_t other = 0;  ///< index of a link, or of an obstacle
    bool is_obstacle = false; ///< false: `other` is a link, and link < other
    friend bool operator==(const RobotPair&, const RobotPair&) = default;
};

/// The pairs that a query tests.
struct RobotQuery {
    bool self = true; ///< the pairs of links
    /// Tested with every link but the root, which stands still.
    RobotObstacles obstacles{};
    bool root = false; ///< also tests the root link with the obstacles
    Progress progress{};
};

/// Returns the pairs that share a point: links first, sorted.
///
/// Accuracy    exact for the triangles at the places that Robot::link_transforms gives. A shape with
///             an `excess` counts as its polyhedron.
/// Errors      Error{bad_argument}; Error{interrupted}.
std::vector<RobotPair> collide(const Robot& robot, std::span<const double> configuration,
                               const RobotQuery& query = {});

/// The nearest pair of a robot in a configuration.
struct RobotGap {
    /// 0 if a pair meets; infinite if there is no pair, or none nearer than the upper bound.
    double distance = std::numeric_limits<double>::infinity();
    RobotPair pair;        ///< of several that meet, one of them
    Vec3 point_a, point_b; ///< witness points on the link and on the other, world frame
    /// exact: to rounding. bound_only: no pair is nearer than the upper bound.
    Status status = Status::exact;
};

struct RobotDistanceOptions : RobotQuery {
    double upper_bound = std::numeric_limits<double>::infinity();
};

/// Finds the nearest pair.
///
/// Accuracy    as `distance` of two models; 0 if and only if `collide` finds a pair.
/// Cost        pairs are measured nearest first by bounds of their distances, until the others
///             cannot be nearer.
RobotGap distance(const Robot& robot, std::span<const double> configuration,
                  const RobotDistanceOptions& options = {});

/// Many configurations, one after another in one array.
struct Configurations {
    std::span<const double> values;
};

/// As above for many configurations, in parallel. Answers have the indices of the configurations.
///
/// Errors      Error{bad_argument}, naming the configuration, counted from 0.
std::vector<RobotGap> distance(const Robot& robot, Configurations configurations,
                               const RobotDistanceOptions& options = {});

/// Returns for each of many configurations whether any pair meets. Errors as `distance`.
std::vector<bool> collide(const Robot& robot, Configurations configurations,
                          const RobotQuery& query = {});

struct RobotImpactOptions : RobotQuery {
    /// Metres: at the returned time some pair is at most this far apart.
    double absolute_error = 1e-4;
    /// Maximum number of steps. A step measures one pair.
    std::uint64_t max_steps = 100'000;
};

/// The first contact on the way from one configuration to another.
struct RobotImpact {
    bool meet = false;
    /// In [0, 1]. The way is free up to this time. 1 if no pair meets.
    double time = 1;
    /// A time at which the pair is in contact; infinite if none was found.
    double contact_time = std::numeric_limits<double>::infinity();
    RobotPair pair;
    double gap = std::numeric_limits<double>::infinity(); ///< of the pair at `time`, metres
    /// exact: a contact was found, or it is proven that there is none. bound_only: a pair comes
    /// within the error, and whether it touches was not decided; `meet` is true, to be safe.
    Status status = Status::exact;
    std::uint64_t steps = 0;
};

/// Finds the first contact while every variable changes at a constant rate from `from` to `to`.
///
/// Accuracy    the time is never later than the first contact, and no contact is missed.
/// Source      conservative advancement [Mirtich 1996] with bounds of the motion of one link
///             relative to another: of each joint between them, the largest distance of the link
///             from the joint's axis [Schwarzer, Saha, Latombe 2005].
RobotImpact time_of_impact(const Robot& robot, std::span<const double> from,
                           std::span<const double> to, const RobotImpactOptions& options = {});

struct AllowedPairsOptions {
    std::uint64_t samples = 10'000; ///< random configurations within the limits
    std::uint64_t seed = 1;
    Progress progress{};
};

/// Proposes the pairs of links that need no test: adjacent ones, those that meet in the default
/// configuration, and those that meet in all or in none of some random configurations. Variables
/// without limits are sampled in one turn, or in one metre to either side.
///
/// "Never" is an observation, not a proof. Pairs that `robot` leaves out already, except adjacent
/// ones, are not proposed.
///
/// Errors      Error{bad_argument} if there are no samples; Error{interrupted}.
std::vector<AllowedPair> propose_allowed_pairs(const Robot& robot,
                                               const AllowedPairsOptions& options = {});

} // namespace abut
