#include "suites/moving_scenes.h"

#include "simulator/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

namespace abut::bench {

namespace {

using simulation::Quaternion, simulation::product;
using std::numbers::pi;

Vec3 sum(const Vec3& a, const Vec3& b, double t = 1) {
    return {a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

/// The rotation by |turn| radians about turn.
Quaternion rotation(const Vec3& turn) {
    return simulation::rotated({1, 0, 0, 0}, turn);
}

/// Joins a grid of points, closed in both directions, by two triangles a cell.
void join(Mesh& mesh, std::uint32_t rows, std::uint32_t columns) {
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t k = 0; k < columns; ++k) {
            const std::uint32_t i1 = (i + 1) % rows, k1 = (k + 1) % columns;
            const std::uint32_t a = i * columns + k, b = i1 * columns + k, c = i1 * columns + k1,
                                d = i * columns + k1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
}

/// A torus about the z axis with 2 rows columns triangles.
Mesh torus(double radius, double tube, std::uint32_t rows, std::uint32_t columns) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t k = 0; k < columns; ++k) {
            const double u = 2 * pi * i / rows, v = 2 * pi * k / columns;
            const double r = radius + tube * std::cos(v);
            mesh.positions.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
        }
    join(mesh, rows, columns);
    return mesh;
}

/// A gear wheel about the z axis: a ring whose outline goes from root to tip and back once a tooth.
Mesh gear(int teeth, double root, double tip, double bore, double width) {
    constexpr std::array<double, 8> kShares{0, 0.12, 0.3, 0.36, 0.42, 0.48, 0.54, 0.6};
    Mesh mesh;
    std::uint32_t rows = 0;
    for (int tooth = 0; tooth < teeth; ++tooth)
        for (std::size_t k = 0; k < kShares.size(); ++k, ++rows) {
            const double u = 2 * pi * (tooth + kShares[k]) / teeth;
            const double r = k >= 3 && k <= 6 ? tip : root;
            for (const auto& [radius, z] : {std::pair(bore, -width), std::pair(r, -width),
                                            std::pair(r, width), std::pair(bore, width)})
                mesh.positions.push_back({radius * std::cos(u), radius * std::sin(u), z});
        }
    join(mesh, rows, 4);
    return mesh;
}

struct Mover {
    BodyId id;
    Pose pose;
    Vec3 velocity, spin;
};

/// Equal tori that fly in a box and bounce at its walls.
class Tori final : public MovingScene {
public:
    Tori(double side, bool spin, std::uint64_t seed) : random_(seed), half_(0.5 * side) {
        const Model model(torus(1, 0.4, 40, 20));
        for (int i = 0; i < 300; ++i) {
            const Vec3 axis = draw(1);
            const Pose pose{draw(half_), {0.5, axis.x, axis.y, axis.z}};
            Mover& body = bodies_.emplace_back(
                Mover{world.add(model, pose), pose, draw(2), spin ? draw(2) : Vec3{}});
            tell(body);
        }
    }
    void move() override {
        for (Mover& body : bodies_) {
            body.pose.translation = sum(body.pose.translation, body.velocity, kSceneStep);
            if (!(body.spin == Vec3{})) {
                const Vec3 turn = sum({}, body.spin, kSceneStep);
                body.pose.rotation = product(rotation(turn), body.pose.rotation);
            }
            world.move(body.id, body.pose);
        }
    }
    void steer() override {
        for (Mover& body : bodies_) {
            bool turned = false;
            for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
                double& v = body.velocity.*axis;
                const double p = body.pose.translation.*axis;
                if (std::abs(p) > half_ && p * v > 0)
                    v = -v, turned = true;
            }
            if (turned)
                tell(body);
        }
    }

private:
    void tell(const Mover& body) {
        const Vec3& w = body.spin;
        world.set_speed(
            body.id, {.velocity = body.velocity,
                      .angular_speed = std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z) * (1 + 1e-9)});
    }
    Vec3 draw(double half) {
        std::uniform_real_distribution<double> along(-half, half);
        const double x = along(random_), y = along(random_), z = along(random_);
        return {x, y, z};
    }

    std::mt19937_64 random_;
    double half_;
    std::vector<Mover> bodies_;
};

/// Chains of rings. Each ring wanders about its place and gets another velocity after some steps.
class Chains final : public MovingScene {
public:
    Chains(std::size_t period, std::uint64_t seed) : random_(seed), period_(period) {
        constexpr int kChains = 10, kRings = 20;
        const Model model(torus(1, 0.15, 40, 20));
        for (int chain = 0; chain < kChains; ++chain)
            for (int i = 0; i < kRings; ++i) {
                const Vec3 home{1.35 * i, 4.0 * chain, 0};
                const Quaternion turned = rotation({i % 2 == 0 ? 0 : pi / 2, 0, 0});
                bodies_.push_back({world.add(model, Pose{home, turned}), {home, turned}, {}, {}});
                homes_.push_back(home);
            }
        steer();
    }
    void move() override {
        ++steps_;
        for (Mover& body : bodies_) {
            body.pose.translation = sum(body.pose.translation, body.velocity, kSceneStep);
            const Vec3 turn = sum({}, body.spin, kSceneStep);
            body.pose.rotation = product(rotation(turn), body.pose.rotation);
            world.move(body.id, body.pose);
        }
    }
    void steer() override {
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if ((steps_ + 7 * i) % period_ == 0 || steps_ == 0) {
                Mover& body = bodies_[i];
                std::uniform_real_distribution<double> along(-0.1, 0.1);
                const Vec3 target =
                    sum(homes_[i], {along(random_), along(random_), along(random_)});
                const double time = kSceneStep * static_cast<double>(period_);
                body.velocity = sum({}, sum(target, body.pose.translation, -1), 1 / time);
                const double spin = 0.075 / time * (body.spin.x > 0 ? -1 : 1);
                body.spin = {spin, 0, 0};
                world.set_speed(body.id, {.velocity = body.velocity,
                                          .angular_speed = std::abs(spin) * (1 + 1e-9)});
            }
    }

private:
    std::mt19937_64 random_;
    std::size_t period_, steps_ = 0;
    std::vector<Mover> bodies_;
    std::vector<Vec3> homes_;
};

/// A train of equal gear wheels that mesh with play.
class Gears final : public MovingScene {
public:
    Gears() {
        constexpr int kGears = 20, kTeeth = 24;
        const Model models[]{Model(gear(kTeeth, 0.9, 1.06, 0.3, 0.1)),
                             Model(gear(kTeeth, 0.9, 1.06, 0.3, 0.09))};
        for (int i = 0; i < kGears; ++i) {
            const double start = i % 2 == 0 ? 0.0 : -0.4 / kTeeth * 2 * pi;
            const Pose pose{{2.0 * i, 0, 0}, rotation({0, 0, start})};
            const double speed = i % 2 == 0 ? kSpeed : -kSpeed;
            bodies_.push_back({world.add(models[i % 2], pose), pose, {}, {0, 0, speed}});
            world.set_speed(bodies_.back().id, {.angular_velocity = {0, 0, speed}});
        }
    }
    void move() override {
        ++steps_;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const Vec3 turn{0, 0, kSceneStep * static_cast<double>(steps_) * bodies_[i].spin.z};
            Pose pose = bodies_[i].pose;
            pose.rotation = product(rotation(turn), pose.rotation);
            world.move(bodies_[i].id, pose);
        }
    }
    void steer() override {}

private:
    static constexpr double kSpeed = 1;
    std::size_t steps_ = 0;
    std::vector<Mover> bodies_;
};

/// An arm of six links between the posts of its cell. Its joints swing.
class RobotCell final : public MovingScene {
public:
    RobotCell()
        : MovingScene({.filter = [](BodyId a, BodyId b) {
              return a.index == 0 || b.index - a.index > 1; // neighbouring links share a joint
          }}) {
        Mesh cell;
        for (int i = 0; i < 12; ++i) // posts around the arm
            add_box(cell, {1.6 * std::cos(i * pi / 6), 1.6 * std::sin(i * pi / 6), 0});
        world.add(Model(cell), Pose{}, {.is_static = true});
        // A link is a capsule-like tube along z.
        Mesh link;
        constexpr std::uint32_t kRows = 24, kColumns = 40;
        for (std::uint32_t i = 0; i < kRows; ++i)
            for (std::uint32_t k = 0; k < kColumns; ++k) {
                const double u = 2 * pi * i / kRows, v = 2 * pi * k / kColumns;
                const double r = 0.05 + 0.03 * std::cos(v);
                link.positions.push_back(
                    {r * std::cos(u), r * std::sin(u), kLength * (0.5 - 0.4 * std::sin(v))});
            }
        join(link, kRows, kColumns);
        const Model model(link);
        for (std::size_t i = 0; i < kLinks; ++i)
            bodies_.push_back(world.add(model, pose_at(i, 0)));
        steer();
    }
    void move() override {
        ++steps_;
        for (std::size_t i = 0; i < kLinks; ++i)
            world.move(bodies_[i], pose_at(i, time()));
    }
    void steer() override {
        constexpr double kSmall = 1e-5;
        for (std::size_t i = 0; i < kLinks; ++i) {
            const Vec3 now = pose_at(i, time()).translation,
                       next = pose_at(i, time() + kSmall).translation;
            const auto joints = static_cast<double>(i + 1);
            world.set_speed(bodies_[i], {.velocity = sum({}, sum(next, now, -1), 1 / kSmall),
                                         .acceleration_bound = 2 * joints,
                                         .angular_speed = kRate * joints});
        }
    }

private:
    static constexpr std::size_t kLinks = 6;
    static constexpr double kLength = 0.3, kSwing = 0.5, kRate = 0.5;

    [[nodiscard]] double time() const { return kSceneStep * static_cast<double>(steps_); }
    static void add_box(Mesh& mesh, const Vec3& foot) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        constexpr std::uint32_t kRows = 20;
        for (std::uint32_t i = 0; i < kRows; ++i)
            for (std::uint32_t k = 0; k < 20; ++k) {
                const double u = 2 * pi * i / kRows, v = 2 * pi * k / 20;
                const double r = 0.08 + 0.02 * std::cos(v);
                mesh.positions.push_back(
                    sum(foot, {r * std::cos(u), r * std::sin(u), 1 + 1.2 * std::sin(v)}));
            }
        Mesh post;
        join(post, kRows, 20);
        for (auto triangle : post.triangles) {
            for (std::uint32_t& vertex : triangle)
                vertex += first;
            mesh.triangles.push_back(triangle);
        }
    }
    static Pose pose_at(std::size_t link, double t) {
        Pose pose{{0, 0, 0.1}, {1, 0, 0, 0}};
        for (std::size_t i = 0; i <= link; ++i) {
            if (i > 0)
                pose.translation =
                    sum(pose.translation,
                        simulation::rotation_matrix(pose.rotation) * Vec3{0, 0, kLength});
            const double angle = kSwing * std::sin(kRate / kSwing * t + static_cast<double>(i));
            pose.rotation = product(pose.rotation, rotation(i == 0       ? Vec3{0, 0, angle}
                                                            : i % 2 == 1 ? Vec3{angle, 0, 0}
                                                                         : Vec3{0, angle, 0}));
        }
        return pose;
    }

    std::size_t steps_ = 0;
    std::vector<BodyId> bodies_;
};

} // namespace

std::vector<NamedScene> moving_scenes(std::uint64_t seed) {
    std::vector<NamedScene> scenes;
    for (const double side : {20.0, 40.0, 80.0})
        for (const bool spin : {true, false})
            scenes.push_back(
                {fmt::format("300 tori in a box of {:.0f}{}", side, spin ? ", spinning" : ""),
                 [=] { return std::make_unique<Tori>(side, spin, seed); }});
    for (const int period : {60, 240})
        scenes.push_back({fmt::format("10 chains of 20 rings, pushed {}",
                                      period == 60 ? "4 times a second" : "once a second"),
                          [=] { return std::make_unique<Chains>(period, seed); }});
    scenes.push_back({"20 gears in a train", [] { return std::make_unique<Gears>(); }});
    scenes.push_back({"robot in its cell", [] { return std::make_unique<RobotCell>(); }});
    return scenes;
}

} // namespace abut::bench
