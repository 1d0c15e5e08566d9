#include "scenes/bodies.h"
#include "scenes/deforming/frame.h"
#include "scenes/random.h"
#include "scenes/rigid_bodies.h"
#include "scenes/rigid_scenes.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace abut::scenes {

namespace {

constexpr double kHalf = 1; ///< half the side of the box

/// The box that holds the balls: closed, with its triangles facing inward. It turns, so that the
/// balls never come to rest.
RigidBody box_around() {
    RigidBody body;
    body.spin = {0, 0, 1};
    body.shape = box({{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}}).mesh;
    for (auto& t : body.shape.triangles)
        std::swap(t[1], t[2]);
    return body;
}

std::vector<RigidBody> box_of_balls(const DeformingOptions& options) {
    constexpr double kBalls = 42, kFill = 0.36; // kFill: a ball's radius / the width of its cell
    std::vector<RigidBody> bodies{box_around()};
    const double wanted = static_cast<double>(options.triangles - bodies[0].shape.triangles.size());
    const double fineness = std::max(2.0, std::round(std::sqrt(wanted / (8 * kBalls))));
    const Mesh ball = sphere(static_cast<std::uint32_t>(8 * fineness * fineness));
    const int count =
        static_cast<int>(std::lround(wanted / static_cast<double>(ball.triangles.size())));
    int side = 1;
    while (side * side * side < count)
        ++side;
    const double room = 2 * kHalf / side, radius = kFill * room, slack = room / 2 - radius;
    Random random(options.seed);
    for (int i = 0; i < count; ++i) {
        RigidBody body;
        body.shape = ball;
        for (Vec3& p : body.shape.positions)
            p = scaled(p, radius);
        const auto along = [&](int k) {
            return -kHalf + room * (k + 0.5) + 0.8 * slack * random.uniform(-1, 1);
        };
        body.pose.translation = {along(i % side), along(i / side / side), along(i / side % side)};
        body.velocity = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
        body.spin = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
        body.inverse_mass = 1;
        body.inverse_inertia = 1 / (0.4 * radius * radius);
        bodies.push_back(std::move(body));
    }
    return bodies;
}

class BouncingBalls : public DeformingScene {
public:
    explicit BouncingBalls(const DeformingOptions& options)
        : bodies_(box_of_balls(options),
                  {.thickness = 0.01, .restitution = 0.85, .friction = 0.2}) {}
    [[nodiscard]] const Mesh& mesh() const override { return bodies_.mesh(); }
    void step() override { bodies_.step(); }

private:
    RigidBodies bodies_;
};

} // namespace

std::unique_ptr<DeformingScene> bouncing_balls(const DeformingOptions& options) {
    return std::make_unique<BouncingBalls>(options);
}

} // namespace abut::scenes
