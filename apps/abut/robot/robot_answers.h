#pragma once

#include "robot/robot_arguments.h"

/// The actions of `abut robot`. Each prints its answer and returns the exit status.
namespace abut::command {

int robot_info(const RobotArguments& arguments, const RobotCell& cell, const CommonOptions& common);
int robot_check(const RobotArguments& arguments, const RobotCell& cell,
                const CommonOptions& common);
int robot_distance(const RobotArguments& arguments, const RobotCell& cell,
                   const CommonOptions& common);
int robot_allowed(const RobotArguments& arguments, const RobotCell& cell,
                  const CommonOptions& common);

/// The names of a pair: two links, or a link and an obstacle.
std::array<std::string, 2> names_of(const RobotPair& pair, const RobotCell& cell);

/// Returns {"link": …, "other": …, "is_obstacle": …}.
nlohmann::ordered_json to_json(const RobotPair& pair, const RobotCell& cell);

} // namespace abut::command
