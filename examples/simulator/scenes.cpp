#include "simulator/scenes.h"

#include <abut/error.h>

#include "simulator/container.h"

#include <memory>
#include <utility>

namespace simulation {

namespace {

/// Scales a mesh to a size along z of 1, with the middle of its box at the origin.
abut::Mesh scaled(abut::Mesh mesh) {
    const abut::Box3 box = abut::inspect(mesh).bounds;
    const Vec3 centre = 0.5 * (box.lower + box.upper);
    const double size = box.upper.z - box.lower.z;
    for (Vec3& p : mesh.positions)
        p = (1 / size) * (p - centre);
    return mesh;
}

void add_falling_wall(Stage& stage) {
    constexpr double kHitAt = 2;
    add_wall(stage, 25, 20);
    const BodyNumber ball = stage.add(abut::Sphere{{}, 0.5}, {{0, -8, 0.5}}, {.density = 2000});
    stage.seconds = 8;
    stage.act = [ball, hit = false](Simulator& simulator, double seconds) mutable {
        if (hit || seconds < kHitAt)
            return;
        hit = true;
        simulator.wake(ball);
        simulator.bodies()[ball].velocity = {0, 20, 3};
    };
}

} // namespace

Brick floor_brick(double half_width) {
    return {{half_width, half_width, 0.5}, {0, 0, -0.5}, 0};
}

std::vector<Brick> stack_bricks(int high) {
    std::vector<Brick> bricks{floor_brick()};
    for (int i = 0; i < high; ++i)
        bricks.push_back({{0.5, 0.5, 0.5}, {0, 0, i + 0.5}});
    return bricks;
}

std::vector<Brick> wall_bricks(int wide, int high) {
    const Vec3 half{0.2, 0.1, 0.1}, quarter{0.1, 0.1, 0.1};
    std::vector<Brick> bricks{floor_brick()};
    for (int row = 0; row < high; ++row) {
        const double z = (2 * row + 1) * half.z;
        const bool shifted = row % 2 != 0; // with half a brick at each end
        const double first = -half.x * (wide - (shifted ? 2 : 1)), end = half.x * wide - quarter.x;
        for (int i = 0; i < (shifted ? wide - 1 : wide); ++i)
            bricks.push_back({half, {first + 2 * i * half.x, 0, z}, 1800});
        if (shifted)
            bricks.push_back({quarter, {-end, 0, z}, 1800}),
                bricks.push_back({quarter, {end, 0, z}, 1800});
    }
    return bricks;
}

void Stage::add(const std::vector<Brick>& bricks) {
    for (const Brick& brick : bricks)
        add(abut::Box3{-1 * brick.half, brick.half}, {brick.centre}, {.density = brick.density});
}

void add_stack(Stage& stage, int high) {
    stage.add(stack_bricks(high));
}

void add_wall(Stage& stage, int wide, int high) {
    stage.add(wall_bricks(wide, high));
}

void add_chain(Stage& stage, int links) {
    constexpr double kLength = 0.25, kRadius = 0.04;
    const double top = (links + 2) * kLength;
    BodyNumber last = stage.add(abut::Sphere{{}, 0.1}, {{0, 0, top}}, {.density = 0});
    for (int i = 0; i < links; ++i) {
        const abut::Capsule link{{{-0.5 * kLength, 0, 0}, {0.5 * kLength, 0, 0}}, kRadius};
        const BodyNumber next = stage.add(link, {{(i + 0.5) * kLength, 0, top}});
        stage.simulator.join(JointKind::ball, last, next, {{i * kLength, 0, top}});
        last = next;
    }
}

void add_crank(Stage& stage) {
    const auto bar = [](double x, double y, double z) {
        return abut::Box3{{-x, -y, -z}, {x, y, z}};
    };
    const auto base = stage.add(bar(2, 0.3, 0.1), {{0.5, 0, -1.5}}, {.density = 0});
    const auto wheel = stage.add(bar(0.5, 0.1, 0.5), {});
    const auto rod = stage.add(bar(0.8, 0.05, 0.05), {{1.2, 0.3, 0}});
    const auto piston = stage.add(bar(0.2, 0.1, 0.2), {{2, 0, 0}});
    const Vec3 y{0, 1, 0};
    Simulator& simulator = stage.simulator;
    simulator.join(JointKind::hinge, base, wheel, {{0, 0, 0}, y});
    simulator.join(JointKind::hinge, wheel, rod, {{0.4, 0.15, 0}, y});
    simulator.join(JointKind::hinge, rod, piston, {{2, 0.15, 0}, y});
    simulator.join(JointKind::slider, base, piston, {{2, 0, 0}, {1, 0, 0}});
    simulator.bodies()[wheel].spin = 6.0 * y;
    // A rod at rest would be an error of the joints' speeds.
    simulator.bodies()[rod].velocity = {0, 0, -1.2};
    simulator.bodies()[rod].spin = -1.5 * y;
}

PairOfMeshes ball_on_disc() {
    return {
        {dented_disc(0.6), bumpy_ball(0.2)}, {Pose{{0, 0, 0.225}}, Pose{{0.05, 0.02, 0.62}}}, {}};
}

PairOfMeshes pair_of_bunnies(abut::Mesh mesh) {
    const Pose lower{{0, 0, 0.3403}, {0.9134, 0.0967, 0.0893, -0.3853}},
        upper{{-0.24, 0.027, 1.4}, {-0.0266, -0.9969, -0.0464, -0.058}};
    const Material soft{.friction = 0.6, .rolling = 0.005};
    const abut::Mesh bunny = scaled(std::move(mesh));
    return {{bunny, bunny}, {lower, upper}, soft};
}

void add_pair(Stage& stage, const PairOfMeshes& pair) {
    stage.add({floor_brick(2)});
    for (std::size_t i = 0; i < 2; ++i)
        stage.add(abut::Model(pair.meshes[i]), pair.poses[i], pair.material);
}

void add_bullet(Stage& stage) {
    const abut::Box3 plate{{-0.0005, -0.5, -0.5}, {0.0005, 0.5, 0.5}};
    const BodyNumber ball = stage.add(abut::Sphere{{}, 0.005}, {{-3, 0.1, 0.2}}, {.density = 8000});
    stage.add(plate, {{0, 0, 0}});
    stage.add(plate, {{0.3, 0, 0}});
    stage.add(plate, {{0.6, 0, 0}}, {.density = 0});
    stage.simulator.bodies()[ball].velocity = {500, 0, 0};
    stage.seconds = 0.25;
}

const std::vector<std::string>& stage_names() {
    static const std::vector<std::string> names{"stack10", "stack20", "wall",   "chain",
                                                "crank",   "meshes",  "bullet", "container"};
    return names;
}

Stage make_stage(const std::string& name, const Settings& settings, const std::string& mesh) {
    Stage stage(settings);
    if (name == "stack10")
        add_stack(stage, 10);
    else if (name == "stack20")
        add_stack(stage, 20);
    else if (name == "wall")
        add_falling_wall(stage);
    else if (name == "chain")
        add_chain(stage, 20);
    else if (name == "crank")
        add_crank(stage);
    else if (name == "meshes")
        add_pair(stage, mesh.empty() ? ball_on_disc() : pair_of_bunnies(abut::read_mesh(mesh)));
    else if (name == "bullet")
        add_bullet(stage);
    else if (name == "container")
        fill_container(stage, 1000);
    else
        throw abut::Error(abut::ErrorCode::bad_argument, "no scene is called '" + name + "'");
    return stage;
}

} // namespace simulation
