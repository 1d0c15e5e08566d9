#include "robot/robot_arguments.h"

#include <abut/error.h>

#include "arguments/interrupt.h"
#include "text/text_lines.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <random>

namespace abut::command {

namespace {

std::string form_of(const Robot& robot) {
    std::string form;
    for (const RobotVariable& variable : robot.variables())
        form += (form.empty() ? "" : ",") + variable.name;
    return form;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line)
        if (c == ',')
            fields.emplace_back();
        else if (c != ' ' && c != '\t' && c != '"')
            fields.back() += c;
    return fields;
}

/// Reads lines of values. If the first line names variables, the columns are these, and the other
/// variables keep their default values.
class ConfigurationFile {
public:
    ConfigurationFile(const std::string& file, const Robot& robot) : file_(file), robot_(robot) {
        for (std::size_t i = 0; i < robot.variables().size(); ++i)
            columns_.push_back(i);
    }

    std::vector<double> read() {
        for_each_line(file_, [&](std::size_t number, const std::string& line) {
            if (line.empty() || line.front() == '#')
                return;
            if (!is_begun_ && !parse_number(fields_of(line).front()))
                read_header(number, fields_of(line));
            else
                add(number, line);
            is_begun_ = true;
        });
        return std::move(values_);
    }

private:
    [[noreturn]] void fail(std::size_t number, const std::string& what) const {
        throw Error(ErrorCode::malformed, file_, fmt::format("line {}: {}", number, what));
    }

    void read_header(std::size_t number, const std::vector<std::string>& names) {
        columns_.clear();
        for (const std::string& name : names) {
            const auto& variables = robot_.variables();
            const auto found = std::ranges::find(variables, name, &RobotVariable::name);
            if (found == variables.end())
                fail(number, fmt::format("the robot has no variable '{}'", name));
            const auto index = static_cast<std::size_t>(found - variables.begin());
            if (std::ranges::find(columns_, index) != columns_.end())
                fail(number, fmt::format("the variable '{}' has two columns", name));
            columns_.push_back(index);
        }
    }

    void add(std::size_t number, const std::string& line) {
        const std::vector<std::string> fields = fields_of(line);
        if (fields.size() != columns_.size())
            fail(number,
                 fmt::format("{} values where {} are needed", fields.size(), columns_.size()));
        std::vector<double> values = robot_.default_configuration();
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const std::optional<double> value = parse_number(fields[i]);
            if (!value)
                fail(number, fmt::format("'{}' is not a finite number", fields[i]));
            values[columns_[i]] = *value;
        }
        values_.insert(values_.end(), values.begin(), values.end());
    }

    std::string file_;
    const Robot& robot_;
    std::vector<std::size_t> columns_;
    std::vector<double> values_;
    bool is_begun_ = false;
};

/// The default configuration with the values of a named state.
std::vector<double> state_values(const std::string& name, const RobotCell& cell) {
    const auto& states = cell.semantics.states;
    if (std::ranges::find(states, name, &NamedState::name) == states.end())
        throw Error(ErrorCode::bad_argument,
                    fmt::format("--state: the SRDF file has no state '{}'", name));
    std::vector<double> values = cell.robot.default_configuration();
    const auto& joints = cell.robot.description().joints;
    for (const NamedState& state : states)
        for (const auto& [joint, given] : state.joints) {
            if (state.name != name)
                continue;
            std::size_t next = 0;
            for (std::size_t i = 0; i < values.size() && next < given.size(); ++i)
                if (joints[cell.robot.variables()[i].joint].name == joint)
                    values[i] = given[next++];
        }
    return values;
}

double lower_of(const RobotVariable& variable) {
    return std::isfinite(variable.limits.lower) ? variable.limits.lower
                                                : (variable.is_angle ? -std::numbers::pi : -1);
}
double upper_of(const RobotVariable& variable) {
    return std::isfinite(variable.limits.upper) ? variable.limits.upper
                                                : (variable.is_angle ? std::numbers::pi : 1);
}

/// Adds a scene's parts as obstacles, turned z up as robots are.
void add_obstacles(Scene scene, std::vector<RobotObstacle>& obstacles) {
    turn_up(scene, UpAxis::z);
    std::vector<std::optional<Model>> models(scene.meshes.size());
    for (const Part& part : scene.parts) {
        std::optional<Model>& model = models.at(part.mesh);
        if (!model)
            model.emplace(std::move(scene.meshes.at(part.mesh)));
        obstacles.push_back({part.name, *model, part.world_from_mesh});
    }
}

} // namespace

void add_robot_arguments(CLI::App& app, RobotArguments& arguments) {
    app.add_option("ACTION", arguments.action, "What to do: info, check, distance or allowed")
        ->required()
        ->check(CLI::IsMember({"info", "check", "distance", "allowed"}));
    app.add_option("URDF", arguments.urdf, "Robot: a URDF file")->required();
    app.add_option("--srdf", arguments.srdf,
                   "SRDF file with the pairs of links that may meet, and named states")
        ->check(not_empty("FILE"));
    app.add_option("--package", arguments.packages,
                   "Folder to search for the packages of package://NAME/… ; may be repeated")
        ->allow_extra_args(false)
        ->check(not_empty("FOLDER"));
    app.add_flag("--visual", arguments.visual,
                 "Use the visual shapes in place of the collision shapes");
    app.add_flag("--all-pairs", arguments.all_pairs,
                 "Also test the pairs that the SRDF file allows, and adjacent links");
    app.add_option("--scene", arguments.scenes,
                   fmt::format("Model whose parts are obstacles; may be repeated: {}", kModelHelp))
        ->allow_extra_args(false)
        ->check(not_empty("FILE"));
    app.add_option("--configuration", arguments.configurations,
                   "Values of all variables, in radians and metres: V1,V2,…; may be repeated")
        ->allow_extra_args(false)
        ->check(not_empty("VALUES"));
    app.add_option("--state", arguments.state, "Named state of the SRDF file")
        ->check(not_empty("NAME"));
    app.add_option("--configurations", arguments.file,
                   "File with a configuration on each line; its first line may name the variables")
        ->check(not_empty("FILE"));
    app.add_option("--random", arguments.random, "Also this many random configurations")
        ->check(whole_number(1, 1'000'000'000));
    app.add_option("--seed", arguments.seed, "Seed of random configurations")
        ->check(whole_number(0, ~std::uint64_t{0} >> 1));
    app.add_flag("--continuous", arguments.continuous,
                 "check: also test the straight ways between successive configurations");
    app.add_option("--samples", arguments.samples, "allowed: number of random configurations")
        ->check(whole_number(1, 1'000'000'000))
        ->capture_default_str();
    app.add_option("--out", arguments.out, "allowed: SRDF file to write")->check(not_empty("FILE"));
    add_fail_on(app, arguments.fail_on, "contact");
}

RobotCell load_cell(const RobotArguments& arguments, const CommonOptions& common) {
    ProgressBar bar(common.progress_style());
    const InterruptScope scope(OnInterrupt::ask);
    RobotReadOptions options{.package_folders = arguments.packages, .visual = arguments.visual};
    options.read.progress = bar.progress();
    RobotDescription description = read_robot(arguments.urdf, options);
    RobotSemantics semantics;
    if (!arguments.srdf.empty())
        semantics = read_srdf(arguments.srdf, description);
    std::vector<RobotObstacle> obstacles;
    for (const ModelPath& path : parse_model_paths(arguments.scenes))
        add_obstacles(read_scene(path, options.read), obstacles);
    throw_if_interrupted();
    bar.finish();
    RobotOptions of_robot;
    if (!arguments.all_pairs)
        of_robot.allowed = semantics.allowed;
    of_robot.allow_adjacent = !arguments.all_pairs;
    Robot robot(std::move(description), of_robot);
    return {std::move(semantics), std::move(robot), RobotObstacles(std::move(obstacles))};
}

std::vector<double> robot_configurations(const RobotArguments& arguments, const RobotCell& cell) {
    std::vector<double> values;
    const auto append = [&](const std::vector<double>& more) {
        values.insert(values.end(), more.begin(), more.end());
    };
    for (const std::string& text : arguments.configurations)
        append(parse_numbers("--configuration", text, form_of(cell.robot)));
    if (!arguments.state.empty())
        append(state_values(arguments.state, cell));
    if (!arguments.file.empty())
        append(ConfigurationFile(arguments.file, cell.robot).read());
    std::mt19937_64 engine(arguments.seed);
    for (std::uint64_t i = 0; i < arguments.random; ++i)
        for (const RobotVariable& variable : cell.robot.variables()) {
            const double unit = static_cast<double>(engine() >> 11) * 0x1p-53;
            values.push_back(lower_of(variable) + unit * (upper_of(variable) - lower_of(variable)));
        }
    const bool asks = !arguments.configurations.empty() || !arguments.state.empty() ||
                      !arguments.file.empty() || arguments.random > 0;
    if (!asks)
        append(cell.robot.default_configuration());
    return values;
}

} // namespace abut::command
