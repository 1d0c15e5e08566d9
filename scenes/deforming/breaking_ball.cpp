#include "scenes/deforming/fragments.h"
#include "scenes/deforming/frame.h"
#include "scenes/rigid_bodies.h"
#include "scenes/rigid_scenes.h"
#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::scenes {

namespace {

constexpr double kRadius = 0.5, kDrop = 0.6;
/// Cracks spread from where the ball hits the floor, slowly enough to be seen.
constexpr double kCrackSpeed = 1.2;
/// Speed at which a new piece leaves its parent's centre: metres per second for each metre of
/// distance.
constexpr double kBurst = 1.5;

RigidBody floor_slab() {
    RigidBody body;
    body.shape = box({{-3, -0.2, -3}, {3, 0, 3}}).mesh;
    return body;
}

Vec3 velocity_at(const RigidBody& body, const Vec3& arm) {
    return add(body.velocity, cross(body.spin, arm));
}

class BreakingBall : public DeformingScene {
public:
    explicit BreakingBall(const DeformingOptions& options)
        : solid_(kRadius, options.triangles, options.seed), group_(solid_.fragments(), 0),
          bodies_(whole(), {.thickness = solid_.cell_size() / 40, .restitution = 0.3}) {}

    [[nodiscard]] const Mesh& mesh() const override { return bodies_.mesh(); }
    void step() override {
        bodies_.step();
        ++frame_;
        const double fall = std::sqrt(2 * kDrop / 9.81);
        const double reach = kCrackSpeed * (frame_ * kFrameSeconds - fall);
        auto group = solid_.groups({0, -kRadius, 0}, reach);
        if (group != group_)
            split(std::move(group));
    }

private:
    std::vector<RigidBody> whole() {
        Piece piece = solid_.piece(group_, 0);
        centres_ = {{}, piece.centre};
        RigidBody ball = body_of(std::move(piece));
        ball.pose.translation = add(centres_[1], {0, kRadius + kDrop, 0});
        return {floor_slab(), std::move(ball)};
    }

    static RigidBody body_of(Piece piece) {
        RigidBody body;
        body.shape = std::move(piece.shape);
        body.inverse_mass = 1 / piece.mass;
        body.inverse_inertia = 1 / piece.inertia;
        return body;
    }

    /// Turns each new group into a body, which continues the motion of the body it was part of.
    void split(std::vector<std::uint32_t> group) {
        std::vector<RigidBody> bodies{bodies_.bodies()[0]};
        std::vector<Vec3> centres{{}};
        for (std::uint32_t g = 0; g <= *std::ranges::max_element(group); ++g) {
            const auto fragment =
                static_cast<std::size_t>(std::ranges::find(group, g) - group.begin());
            const std::uint32_t parent_index = group_[fragment] + 1;
            const RigidBody& parent = bodies_.bodies()[parent_index];
            Piece piece = solid_.piece(group, g);
            centres.push_back(piece.centre);
            const Vec3 arm = turn(Transform(Pose{{}, parent.pose.rotation}),
                                  subtract(piece.centre, centres_[parent_index]));
            RigidBody body = body_of(std::move(piece));
            body.pose = {add(parent.pose.translation, arm), parent.pose.rotation};
            body.velocity = add(velocity_at(parent, arm), scaled(arm, kBurst));
            body.spin = parent.spin;
            bodies.push_back(std::move(body));
        }
        bodies_.replace(std::move(bodies));
        centres_ = std::move(centres);
        group_ = std::move(group);
    }

    FragmentedBall solid_;
    std::vector<std::uint32_t> group_; ///< of each fragment; group g is body g + 1
    std::vector<Vec3> centres_;        ///< of each body, in the whole ball's frame
    RigidBodies bodies_;
    double frame_ = 0;
};

} // namespace

std::unique_ptr<DeformingScene> breaking_ball(const DeformingOptions& options) {
    return std::make_unique<BreakingBall>(options);
}

} // namespace abut::scenes
