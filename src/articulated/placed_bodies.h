#pragma once

#include <abut/rigid.h>

#include "articulated/robot_data.h"

#include <span>
#include <vector>

namespace abut {

/// The bodies that a query tests: those of the robot, then the obstacles.
class QueryBodies {
public:
    QueryBodies(const RobotData& robot, const RobotQuery& query);

    [[nodiscard]] const RobotBody& operator[](std::uint32_t i) const {
        return i < links_.size() ? links_[i] : obstacles_[i - links_.size()];
    }
    [[nodiscard]] std::size_t size() const { return links_.size() + obstacles_.size(); }
    [[nodiscard]] bool is_obstacle(std::uint32_t body) const { return body >= links_.size(); }
    [[nodiscard]] std::span<const BodyTest> tests() const { return tests_; }
    [[nodiscard]] RobotPair pair_of(const BodyTest& test) const;
    [[nodiscard]] const RobotData& robot() const { return robot_; }

private:
    const RobotData& robot_;
    std::span<const RobotBody> links_;
    std::span<const RobotBody> obstacles_;
    std::vector<BodyTest> tests_; ///< sorted by their pairs
};

/// Whether a component of one body lies inside another one, which bounds a solid.
///
/// In          bodies whose surfaces do not meet, at their places: world_from_model.
bool is_inside(const RobotBody& inner, const Transform& inner_place, const RobotBody& solid,
               const Transform& solid_place);

/// The bodies of a query at their places in one configuration. Reuse it for many configurations.
class PlacedBodies {
public:
    explicit PlacedBodies(const QueryBodies& bodies);

    /// In          a valid configuration.
    void place(std::span<const double> configuration);

    /// A lower bound of the distance of two bodies; may be negative.
    [[nodiscard]] double ball_gap(const BodyTest& test) const;
    /// A better lower bound of the distance, by convex hulls. 0 if these meet.
    [[nodiscard]] double hull_gap(const BodyTest& test) const;
    /// Measures two bodies as solids: the distance is 0 if one is inside the other.
    [[nodiscard]] Gap measure(const BodyTest& test, const DistanceOptions& options) const;
    [[nodiscard]] bool meet(const BodyTest& test) const;
    [[nodiscard]] const Transform& world_from_body(std::uint32_t body) const {
        return places_[body];
    }

private:
    [[nodiscard]] bool inside(std::uint32_t inner, std::uint32_t outer) const;

    const QueryBodies& bodies_;
    std::vector<Transform> links_;
    std::vector<Transform> places_; ///< world_from_model
    std::vector<Vec3> centres_;
};

} // namespace abut
