#pragma once

#include <abut/robot.h>

#include "arguments/common.h"

#include <string>
#include <vector>

/// The arguments of `abut robot`: the robot, its obstacles, and the configurations.
namespace abut::command {

struct RobotArguments {
    std::string action; ///< "info", "check", "distance" or "allowed"
    std::string urdf, srdf;
    std::vector<std::string> packages, scenes;
    bool visual = false;
    bool all_pairs = false; ///< also the pairs that the SRDF file allows, and adjacent ones

    std::vector<std::string> configurations; ///< "0,1.5,…"
    std::string state, file;
    std::uint64_t random = 0, seed = 1;
    bool continuous = false;

    std::uint64_t samples = 10'000;
    std::string out;
    std::string fail_on;
};

/// Declares the options of `abut robot`.
void add_robot_arguments(CLI::App& app, RobotArguments& arguments);

/// A robot with the things around it.
struct RobotCell {
    RobotSemantics semantics;
    Robot robot;
    RobotObstacles obstacles; ///< one for each part of the scenes, z up
};

/// Reads the robot, its SRDF file and the scenes.
RobotCell load_cell(const RobotArguments& arguments, const CommonOptions& common);

/// The configurations that the arguments name, one after another: those of --configuration, of
/// --state, of --configurations and of --random. Without any of them, the default configuration.
///
/// Errors      Error, naming the option or the file and line.
std::vector<double> robot_configurations(const RobotArguments& arguments, const RobotCell& cell);

} // namespace abut::command
