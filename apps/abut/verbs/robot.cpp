#include "commands.h"
#include "robot/robot_answers.h"

#include <memory>

namespace abut::command {

namespace {

int run(const RobotArguments& arguments, const CommonOptions& common) {
    const RobotCell cell = load_cell(arguments, common);
    if (arguments.action == "info")
        return robot_info(arguments, cell, common);
    if (arguments.action == "check")
        return robot_check(arguments, cell, common);
    if (arguments.action == "distance")
        return robot_distance(arguments, cell, common);
    return robot_allowed(arguments, cell, common);
}

} // namespace

Subcommand add_robot(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<RobotArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"robot",
         kRobots,
         "Contacts and distances of a robot's links, with each other and with a scene",
         {{"abut robot info arm.urdf --srdf arm.srdf", "links, joints, limits, tested pairs"},
          {"abut robot check arm.urdf --srdf arm.srdf --configurations path.csv --continuous",
           "which links meet on the way of a trajectory?"},
          {"abut robot distance arm.urdf --configuration 0,0.5,0 --scene cell.glb",
           "the nearest pair of a link and another link or an obstacle"},
          {"abut robot allowed arm.urdf --out arm.srdf", "proposes the pairs that need no test"}},
         "something meets (with --fail-on contact)"});
    add_robot_arguments(*app, *arguments);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
