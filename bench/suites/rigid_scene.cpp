#include "suites/rigid_scene.h"

#include <abut/rigid.h>

#include "placement.h"
#include "scenes/deforming/frame.h"
#include "scenes/random.h"
#include "simulator/rotation.h"

#include <cmath>
#include <numbers>

namespace abut::bench {

namespace {

using scenes::add;
using scenes::scaled;
using simulation::Quaternion, simulation::product;

class PoseMaker {
public:
    PoseMaker(const RigidScene& scene, std::uint64_t seed)
        : a_(scene.a), b_(scene.b), random_(seed) {}

    PosedPair make(Regime regime) {
        const Quaternion turn_a = random_rotation(random_), turn_b = random_rotation(random_);
        const Vec3 direction = random_direction(random_);
        const double share = unit(random_);
        const Transform a = Pose{{}, turn_a};
        const auto b_at = [&](double offset) {
            return Transform(Pose{scaled(direction, offset), turn_b});
        };
        if (regime == Regime::deep)
            return {a, b_at(0.2 * share)};
        const double touch = first_touch(a, b_at);
        switch (regime) {
        case Regime::graze_in:
            return {a, b_at(touch - 0.01 * share)};
        case Regime::graze_out:
            return {a, b_at(touch + 0.01 * share)};
        default:
            return {a, b_at(touch + 0.05 + 0.45 * share)};
        }
    }

    void add_path(std::vector<PosedPair>& poses) {
        const Quaternion turn_a = random_rotation(random_);
        Quaternion turn_b = random_rotation(random_);
        const Vec3 direction = random_direction(random_), axis = random_direction(random_);
        Vec3 step = scaled(random_direction(random_), 0.005);
        const Transform a = Pose{{}, turn_a};
        const double touch = first_touch(a, [&](double offset) {
            return Transform(Pose{scaled(direction, offset), turn_b});
        });
        Vec3 at = scaled(direction, touch + 0.1);
        const double half = 0.5 * std::numbers::pi / 180;
        const Quaternion turn{std::cos(half), std::sin(half) * axis.x, std::sin(half) * axis.y,
                              std::sin(half) * axis.z};
        for (std::size_t i = 0; i < kPathSteps; ++i) {
            Transform b = Pose{at, turn_b};
            if (!(distance(a_, a, b_, b).distance > 0.01)) {
                // Reverse the direction before they meet.
                step = scaled(step, -1);
                at = add(at, scaled(step, 2));
                b = Pose{at, turn_b};
            }
            poses.push_back({a, b});
            at = add(at, step);
            turn_b = product(turn, turn_b);
        }
    }

private:
    /// Moves b in from far away, each time by the distance that is left, until almost none is left.
    template <class At>
    double first_touch(const Transform& a, const At& b_at) {
        double offset = 1.1;
        for (int i = 0; i < 200; ++i) {
            const double gap = distance(a_, a, b_, b_at(offset)).distance;
            offset -= gap;
            if (gap < 1e-5 || offset < 0)
                break;
        }
        return std::max(offset, 0.0);
    }

    Model a_, b_;
    scenes::Random random_;
};

} // namespace

const char* to_string(Regime regime) {
    constexpr std::array kNames{"deep", "graze in", "graze out", "separated", "path"};
    return kNames[static_cast<std::size_t>(regime)];
}

RigidScene make_rigid_scene(std::string name, Mesh a, Mesh b, std::size_t poses,
                            std::uint64_t seed) {
    RigidScene scene;
    scene.name = std::move(name);
    normalise(a);
    normalise(b);
    scene.a = std::move(a);
    scene.b = std::move(b);
    PoseMaker maker(scene, seed);
    for (const Regime regime : kRegimes) {
        auto& made = scene.poses[static_cast<std::size_t>(regime)];
        while (made.size() < poses)
            if (regime == Regime::path)
                maker.add_path(made);
            else
                made.push_back(maker.make(regime));
        made.resize(poses);
    }
    return scene;
}

} // namespace abut::bench
