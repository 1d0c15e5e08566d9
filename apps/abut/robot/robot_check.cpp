#include <abut/error.h>

#include "arguments/interrupt.h"
#include "robot/robot_answers.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace abut::command {

namespace {

/// Lists no more configurations than this on a terminal.
constexpr std::size_t kMostListed = 40;

/// One configuration of the list.
std::span<const double> configuration_at(const std::vector<double>& values, std::size_t i,
                                         const Robot& robot) {
    const std::size_t width = robot.variables().size();
    return std::span(values).subspan(i * width, width);
}

std::size_t configuration_count(const std::vector<double>& values, const Robot& robot) {
    return robot.variables().empty() ? 1 : values.size() / robot.variables().size();
}

std::string pair_text(const RobotPair& pair, const RobotCell& cell) {
    const auto [link, other] = names_of(pair, cell);
    return fmt::format("{} and {}", shown(link), shown(other));
}

/// The findings for one configuration, and for the way from the one before.
struct Checked {
    std::vector<RobotPair> pairs;
    std::vector<std::uint32_t> beyond;
    std::optional<RobotImpact> way;
    [[nodiscard]] bool is_problem() const { return !pairs.empty() || (way && way->meet); }
};

std::vector<Checked> check_all(const RobotArguments& arguments, const RobotCell& cell,
                               const std::vector<double>& values, const Progress& progress) {
    const RobotQuery query{.obstacles = cell.obstacles, .progress = progress};
    const std::size_t count = configuration_count(values, cell.robot);
    std::vector<Checked> checked(count);
    std::vector<bool> meets(count, true); // a robot without variables has one configuration
    if (!cell.robot.variables().empty())
        meets = collide(cell.robot, Configurations{values}, query);
    const RobotQuery of_each{.obstacles = cell.obstacles,
                             .progress = {.report = {}, .stop = progress.stop}};
    for (std::size_t i = 0; i < count; ++i) {
        throw_if_interrupted();
        const auto q = configuration_at(values, i, cell.robot);
        if (meets[i])
            checked[i].pairs = collide(cell.robot, q, of_each);
        checked[i].beyond = cell.robot.beyond_limits(q);
        if (arguments.continuous && i > 0)
            checked[i].way = time_of_impact(cell.robot, configuration_at(values, i - 1, cell.robot),
                                            q, {of_each});
    }
    return checked;
}

nlohmann::ordered_json check_json(const std::vector<Checked>& checked, const RobotCell& cell,
                                  const std::vector<double>& values) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < checked.size(); ++i) {
        const Checked& each = checked[i];
        nlohmann::ordered_json json{{"configuration", configuration_at(values, i, cell.robot)},
                                    {"meet", !each.pairs.empty()},
                                    {"pairs", nlohmann::ordered_json::array()},
                                    {"beyond_limits", nlohmann::ordered_json::array()}};
        for (const RobotPair& pair : each.pairs)
            json["pairs"].push_back(to_json(pair, cell));
        for (const std::uint32_t variable : each.beyond)
            json["beyond_limits"].push_back(cell.robot.variables()[variable].name);
        if (each.way) {
            nlohmann::ordered_json& way = json["way"];
            way = {{"meet", each.way->meet}, {"time", each.way->time}};
            if (each.way->meet) {
                way["pair"] = to_json(each.way->pair, cell);
                way["contact_time"] = std::isfinite(each.way->contact_time)
                                          ? nlohmann::ordered_json(each.way->contact_time)
                                          : nlohmann::ordered_json();
            }
            way["status"] = to_string(each.way->status);
        }
        list.push_back(std::move(json));
    }
    return list;
}

std::string check_lines(const Checked& each, std::size_t index, const RobotCell& cell) {
    std::string text;
    for (const RobotPair& pair : each.pairs)
        text += fmt::format("configuration {}: {} meet\n", index, pair_text(pair, cell));
    for (const std::uint32_t variable : each.beyond)
        text += fmt::format("configuration {}: {} is beyond its limits\n", index,
                            shown(cell.robot.variables()[variable].name));
    if (each.way && each.way->meet)
        text += fmt::format("way {} to {}: free up to {}, then {} {}\n", index - 1, index,
                            number_below(each.way->time), pair_text(each.way->pair, cell),
                            each.way->status == Status::exact ? "meet" : "come too near to tell");
    return text;
}

std::string check_text(const std::vector<Checked>& checked, const RobotCell& cell) {
    std::string text;
    std::size_t meeting = 0;
    std::size_t ways = 0;
    std::size_t beyond = 0;
    std::size_t listed = 0;
    for (std::size_t i = 0; i < checked.size(); ++i) {
        const Checked& each = checked[i];
        meeting += each.pairs.empty() ? 0 : 1;
        ways += each.way && each.way->meet ? 1 : 0;
        beyond += each.beyond.empty() ? 0 : 1;
        const std::string lines = check_lines(each, i, cell);
        if (!lines.empty() && listed++ < kMostListed)
            text += lines;
    }
    if (listed > kMostListed)
        text += fmt::format("… and {} more\n", grouped(listed - kMostListed));
    text += fmt::format("{} of {} configurations meet something", grouped(meeting),
                        grouped(checked.size()));
    if (ways > 0)
        text += fmt::format("; {} ways do", grouped(ways));
    if (beyond > 0)
        text += fmt::format("; {} are beyond limits", grouped(beyond));
    return text + "\n";
}

/// Runs a query with a progress bar that an interrupt ends.
template <typename Query>
auto with_bar(const CommonOptions& common, const Query& query) {
    ProgressBar bar(common.progress_style());
    const InterruptScope scope(OnInterrupt::ask);
    auto answer = query(bar.progress());
    throw_if_interrupted();
    bar.finish();
    return answer;
}

int exit_status(const RobotArguments& arguments, bool problem) {
    return problem && !arguments.fail_on.empty() ? kExitProblem : kExitDone;
}

} // namespace

std::array<std::string, 2> names_of(const RobotPair& pair, const RobotCell& cell) {
    const auto& links = cell.robot.description().links;
    return {links[pair.link].name,
            pair.is_obstacle ? cell.obstacles.list()[pair.other].name : links[pair.other].name};
}

nlohmann::ordered_json to_json(const RobotPair& pair, const RobotCell& cell) {
    const auto [link, other] = names_of(pair, cell);
    return {{"link", link}, {"other", other}, {"is_obstacle", pair.is_obstacle}};
}

int robot_check(const RobotArguments& arguments, const RobotCell& cell,
                const CommonOptions& common) {
    const std::vector<double> values = robot_configurations(arguments, cell);
    const Stopwatch watch;
    const std::vector<Checked> checked = with_bar(common, [&](const Progress& progress) {
        return check_all(arguments, cell, values, progress);
    });
    const double seconds = watch.seconds();
    if (common.json)
        print_json(dump({{"robot", cell.robot.description().name},
                         {"configurations", check_json(checked, cell, values)},
                         {"seconds", {{"query", seconds}}}}));
    else if (!common.quiet)
        print_text(check_text(checked, cell));
    return exit_status(arguments, std::ranges::any_of(checked, &Checked::is_problem));
}

int robot_distance(const RobotArguments& arguments, const RobotCell& cell,
                   const CommonOptions& common) {
    const std::vector<double> values = robot_configurations(arguments, cell);
    const Stopwatch watch;
    const std::vector<RobotGap> gaps = with_bar(common, [&](const Progress& progress) {
        const RobotDistanceOptions options{{.obstacles = cell.obstacles, .progress = progress}};
        return cell.robot.variables().empty()
                   ? std::vector{distance(cell.robot, values, options)}
                   : distance(cell.robot, Configurations{values}, options);
    });
    const double seconds = watch.seconds();
    std::string text;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const RobotGap& gap = gaps[i];
        const bool is_known = std::isfinite(gap.distance);
        nlohmann::ordered_json each{{"configuration", configuration_at(values, i, cell.robot)},
                                    {"distance", is_known ? nlohmann::ordered_json(gap.distance)
                                                          : nlohmann::ordered_json()},
                                    {"status", to_string(gap.status)}};
        if (is_known) {
            each["pair"] = to_json(gap.pair, cell);
            each["point_a"] = to_json(gap.point_a);
            each["point_b"] = to_json(gap.point_b);
        }
        list.push_back(std::move(each));
        text += is_known ? fmt::format("distance {}, {}\n", metres(gap.distance),
                                       pair_text(gap.pair, cell))
                         : std::string("there is no pair to test\n");
    }
    if (common.json)
        print_json(dump({{"robot", cell.robot.description().name},
                         {"frame", describe_frame(UpAxis::z, arguments.urdf)},
                         {"configurations", std::move(list)},
                         {"seconds", {{"query", seconds}}}}));
    else if (!common.quiet)
        print_text(text);
    return exit_status(arguments, std::ranges::any_of(
                                      gaps, [](const RobotGap& gap) { return gap.distance == 0; }));
}

int robot_allowed(const RobotArguments& arguments, const RobotCell& cell,
                  const CommonOptions& common) {
    const std::vector<AllowedPair> pairs = with_bar(common, [&](const Progress& progress) {
        return propose_allowed_pairs(cell.robot, {arguments.samples, arguments.seed, progress});
    });
    const RobotDescription& robot = cell.robot.description();
    std::vector<AllowedPair> all = cell.semantics.allowed;
    for (const AllowedPair& pair : pairs)
        if (std::ranges::none_of(cell.semantics.allowed, [&](const AllowedPair& known) {
                return known.a == pair.a && known.b == pair.b;
            }))
            all.push_back(pair);
    if (!arguments.out.empty())
        write_srdf(robot, all, arguments.out, arguments.srdf);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::string text;
    for (const AllowedPair& pair : pairs) {
        const std::string& a = robot.links[pair.a].name;
        const std::string& b = robot.links[pair.b].name;
        list.push_back({{"a", a}, {"b", b}, {"reason", to_string(pair.reason)}});
        text += fmt::format("{:<9} {} and {}\n", to_string(pair.reason), shown(a), shown(b));
    }
    text += fmt::format(
        "{} pairs need no test; {} remain\n", grouped(pairs.size()),
        grouped(cell.robot.pairs().size() -
                static_cast<std::size_t>(std::ranges::count_if(pairs, [](const AllowedPair& pair) {
                    return pair.reason != AllowReason::adjacent;
                }))));
    if (common.json)
        print_json(dump({{"robot", robot.name},
                         {"samples", arguments.samples},
                         {"seed", arguments.seed},
                         {"pairs", std::move(list)}}));
    else if (!common.quiet)
        print_text(text);
    return kExitDone;
}

} // namespace abut::command
