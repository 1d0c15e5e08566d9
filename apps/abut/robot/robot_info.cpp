#include "robot/robot_answers.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace abut::command {

namespace {

std::string range_of(const RobotVariable& variable) {
    if (!std::isfinite(variable.limits.lower) || !std::isfinite(variable.limits.upper))
        return "no limits";
    return fmt::format("{} to {} {}", number(variable.limits.lower), number(variable.limits.upper),
                       variable.is_angle ? "rad" : "m");
}

std::uint64_t triangles_of(const RobotLink& link) {
    std::uint64_t triangles = 0;
    for (const RobotShape& shape : link.shapes)
        triangles += shape.mesh.triangles.size();
    return triangles;
}

nlohmann::ordered_json limits_json(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json info_json(const RobotCell& cell) {
    const RobotDescription& robot = cell.robot.description();
    nlohmann::ordered_json json{{"robot", robot.name},
                                {"file", robot.file},
                                {"root", robot.links[robot.root].name},
                                {"links", nlohmann::ordered_json::array()},
                                {"joints", nlohmann::ordered_json::array()},
                                {"variables", nlohmann::ordered_json::array()}};
    for (const RobotLink& link : robot.links) {
        nlohmann::ordered_json shapes = nlohmann::ordered_json::array();
        for (const RobotShape& shape : link.shapes)
            shapes.push_back({{"name", shape.name},
                              {"triangles", shape.mesh.triangles.size()},
                              {"excess", shape.excess}});
        json["links"].push_back({{"name", link.name}, {"shapes", std::move(shapes)}});
    }
    for (const RobotJoint& joint : robot.joints) {
        nlohmann::ordered_json each{{"name", joint.name},
                                    {"type", to_string(joint.type)},
                                    {"parent", robot.links[joint.parent].name},
                                    {"child", robot.links[joint.child].name}};
        if (joint.mimic)
            each["mimic"] = {{"joint", robot.joints[joint.mimic->joint].name},
                             {"multiplier", joint.mimic->multiplier},
                             {"offset", joint.mimic->offset}};
        json["joints"].push_back(std::move(each));
    }
    for (const RobotVariable& variable : cell.robot.variables())
        json["variables"].push_back({{"name", variable.name},
                                     {"lower", limits_json(variable.limits.lower)},
                                     {"upper", limits_json(variable.limits.upper)},
                                     {"unit", variable.is_angle ? "rad" : "m"}});
    json["pairs"] = cell.robot.pairs().size();
    json["allowed"] = cell.semantics.allowed.size();
    json["states"] = nlohmann::ordered_json::array();
    for (const NamedState& state : cell.semantics.states)
        json["states"].push_back({{"name", state.name}, {"group", state.group}});
    json["warnings"] = robot.warnings;
    for (const std::string& warning : cell.semantics.warnings)
        json["warnings"].push_back(warning);
    return json;
}

std::string info_text(const RobotCell& cell) {
    const RobotDescription& robot = cell.robot.description();
    std::uint64_t shapes = 0;
    std::uint64_t triangles = 0;
    for (const RobotLink& link : robot.links) {
        shapes += link.shapes.size();
        triangles += triangles_of(link);
    }
    std::map<std::string, int> types;
    for (const RobotJoint& joint : robot.joints)
        ++types[joint.mimic ? "following" : to_string(joint.type)];
    std::string joints;
    for (const auto& [type, count] : types)
        joints += fmt::format("{}{} {}", joints.empty() ? "" : ", ", count, type);
    std::string text = fmt::format("{}\n", shown(robot.name));
    text += fmt::format("  links      {:>6}  root {}\n", robot.links.size(),
                        shown(robot.links[robot.root].name));
    text += fmt::format("  shapes     {:>6}  {} triangles\n", shapes, grouped(triangles));
    text += fmt::format("  joints     {:>6}  {}\n", robot.joints.size(), joints);
    text +=
        fmt::format("  pairs      {:>6}  of links are tested; {} are allowed by the SRDF file\n",
                    cell.robot.pairs().size(), cell.semantics.allowed.size());
    text += fmt::format("  variables  {:>6}\n", cell.robot.variables().size());
    for (const RobotVariable& variable : cell.robot.variables())
        text += fmt::format("    {}: {}\n", shown(variable.name), range_of(variable));
    for (const NamedState& state : cell.semantics.states)
        text += fmt::format("  state {} of {}\n", shown(state.name), shown(state.group));
    for (const auto* warnings : {&robot.warnings, &cell.semantics.warnings})
        for (const std::string& warning : *warnings)
            text += fmt::format("  warning: {}\n", shown(warning));
    return text;
}

} // namespace

int robot_info(const RobotArguments& /*arguments*/, const RobotCell& cell,
               const CommonOptions& common) {
    if (common.json)
        print_json(dump(info_json(cell)));
    else if (!common.quiet)
        print_text(info_text(cell));
    return kExitDone;
}

} // namespace abut::command
