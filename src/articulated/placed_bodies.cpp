#include "articulated/placed_bodies.h"

#include <abut/rigid.h>
#include <abut/shape_queries.h>

#include "math/transform.h"
#include "math/vector.h"

#include <algorithm>

namespace abut {

QueryBodies::QueryBodies(const RobotData& robot, const RobotQuery& query)
    : robot_(robot), links_(robot.bodies) {
    if (query.self)
        tests_ = robot.tests;
    if (query.obstacles.data() != nullptr)
        obstacles_ = query.obstacles.data()->bodies;
    const auto links = static_cast<std::uint32_t>(links_.size());
    for (std::uint32_t a = 0; a < links; ++a)
        if (query.root || links_[a].owner != robot.description.root)
            for (std::uint32_t b = 0; b < obstacles_.size(); ++b)
                tests_.push_back({a, links + b});
}

RobotPair QueryBodies::pair_of(const BodyTest& test) const {
    return {(*this)[test.a].owner, (*this)[test.b].owner, is_obstacle(test.b)};
}

PlacedBodies::PlacedBodies(const QueryBodies& bodies)
    : bodies_(bodies), places_(bodies.size()), centres_(bodies.size()) {
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        if (bodies.is_obstacle(i)) {
            places_[i] = bodies[i].owner_from_model;
            centres_[i] = bodies[i].centre;
        }
}

void PlacedBodies::place(std::span<const double> configuration) {
    const RobotData& robot = bodies_.robot();
    forward_kinematics(robot.description, robot.joints, configuration, links_);
    for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
        const RobotBody& body = robot.bodies[i];
        const Transform& link = links_[body.owner];
        places_[i] = compose(link, body.owner_from_model);
        centres_[i] = apply(link, body.centre);
    }
}

double PlacedBodies::ball_gap(const BodyTest& test) const {
    constexpr double kRoundingShare = 1e-12; // of the coordinates: far more than their rounding
    const Vec3& a = centres_[test.a];
    const Vec3& b = centres_[test.b];
    return length(b - a) - bodies_[test.a].radius - bodies_[test.b].radius -
           kRoundingShare * (max_abs(a) + max_abs(b));
}

double PlacedBodies::hull_gap(const BodyTest& test) const {
    return abut::distance(bodies_[test.a].hull, places_[test.a], bodies_[test.b].hull,
                          places_[test.b])
        .at_least;
}

Gap PlacedBodies::measure(const BodyTest& test, const DistanceOptions& options) const {
    Gap gap = distance(bodies_[test.a].model, places_[test.a], bodies_[test.b].model,
                       places_[test.b], options);
    if (gap.distance > 0 && (inside(test.a, test.b) || inside(test.b, test.a))) {
        gap.distance = gap.at_least = 0;
        gap.status = Status::exact;
    }
    return gap;
}

bool PlacedBodies::meet(const BodyTest& test) const {
    return collide(bodies_[test.a].model, places_[test.a], bodies_[test.b].model, places_[test.b])
               .meet() ||
           inside(test.a, test.b) || inside(test.b, test.a);
}

bool PlacedBodies::inside(std::uint32_t inner, std::uint32_t outer) const {
    return is_inside(bodies_[inner], places_[inner], bodies_[outer], places_[outer]);
}

bool is_inside(const RobotBody& inner, const Transform& inner_place, const RobotBody& solid,
               const Transform& solid_place) {
    if (!solid.is_solid)
        return false;
    const Vec3 middle = apply(solid_place, 0.5 * (solid.box.lower + solid.box.upper));
    // The surfaces do not meet, so one vertex decides for its component. A point outside of the
    // solid's ball is not inside of the solid.
    return std::ranges::any_of(inner.vertices, [&](const Vec3& vertex) {
        const Vec3 point = apply(inner_place, vertex);
        return length(point - middle) <= solid.radius &&
               contains(solid.model, solid_place, point).side == Side::inside;
    });
}

} // namespace abut
