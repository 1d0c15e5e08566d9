#pragma once

#include "simulator/surfaces.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

/// Scenes of the simulator, for its program and its tests.
namespace simulation {

/// A box at a place.
struct Brick {
    Vec3 half;
    Vec3 centre;
    double density = 1000; ///< 0: static
};
/// A floor whose top is at z = 0.
Brick floor_brick(double half_width = 20);
/// A floor, and above it a stack of cubes of 1 m.
std::vector<Brick> stack_bricks(int high);
/// A floor, and on it a wall of bricks of 0.4 m by 0.2 m by 0.2 m along x. Every second row is
/// shifted by half a brick, and has half a brick at both ends.
std::vector<Brick> wall_bricks(int wide, int high);

/// A simulator with what is needed to show it.
struct Stage {
    explicit Stage(const Settings& settings = {}) : simulator(settings) {}

    template <typename Shape>
    BodyNumber add(const Shape& shape, const Pose& pose, const Material& material = {}) {
        const BodyNumber body = simulator.add(shape, pose, material);
        surfaces.of_body.push_back(surface_of(shape));
        return body;
    }
    void add(const std::vector<Brick>& bricks);

    Simulator simulator;
    Surfaces surfaces;
    /// Called before each step with the time that has passed; may be empty.
    std::function<void(Simulator& simulator, double seconds)> act{};
    double seconds = 10; ///< that the scene takes to become quiet
};

void add_stack(Stage& stage, int high);
void add_wall(Stage& stage, int wide, int high);
/// A chain of capsules on ball joints, which begins horizontal at a static ball.
void add_chain(Stage& stage, int links);
/// A wheel on a hinge turns a rod, which moves a slider: three hinges and a slider in a loop.
void add_crank(Stage& stage);
/// A mesh that lies on the floor, and another one that falls on it from a few millimetres.
struct PairOfMeshes {
    std::array<abut::Mesh, 2> meshes;
    std::array<Pose, 2> poses;
    Material material;
};
/// A disc with a dent, 1.2 m wide, and a ball with bumps.
PairOfMeshes ball_on_disc();
/// Two Stanford bunnies on their sides. Their poses are those at which the upper one stays on the
/// lower one, for the bunny of 6,966 triangles with z along its width (`bunny.off` of many mesh
/// libraries). The size of the mesh along z becomes 1 m. Other meshes may fall off.
PairOfMeshes pair_of_bunnies(abut::Mesh mesh);
void add_pair(Stage& stage, const PairOfMeshes& pair);
/// A ball of 5 mm radius at 500 m/s, and three plates of 1 mm, the last of them static.
void add_bullet(Stage& stage);

/// Makes a scene by its name. `mesh` is the file of a bunny for "meshes"; if empty, a ball falls on a
/// disc.
///
/// Errors      abut::Error{bad_argument} if there is no such scene; those of `abut::read_mesh`.
Stage make_stage(const std::string& name, const Settings& settings, const std::string& mesh = "");
const std::vector<std::string>& stage_names();

} // namespace simulation
