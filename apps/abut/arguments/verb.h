#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The verbs and their options as the parser knows them. Help, manual pages and completion are all
/// generated from these data, so that they agree.
namespace abut::command {

/// The groups of verbs, in the order of the help.
inline constexpr const char* kModels = "Models and stores";
inline constexpr const char* kTwoModels = "Two models";
inline constexpr const char* kOneModel = "One model and a shape";
inline constexpr const char* kClashes = "Clashes between the parts of models";
inline constexpr const char* kDeforming = "Surfaces that deform";
inline constexpr const char* kRobots = "Robots";
inline constexpr const char* kAssemblies = "Assemblies in motion";
inline constexpr const char* kScenes = "Example scenes";

/// The group of the options that all verbs have, and its name for a program of its own.
inline constexpr const char* kCommonGroup = "Options of every verb";
inline constexpr const char* kOtherOptions = "Other options";

struct Example {
    std::string line; ///< as typed
    std::string says;
};

struct VerbHelp {
    std::string name;
    std::string group;
    std::string says; ///< one sentence
    std::vector<Example> examples;
    std::string problem;   ///< when the exit status is 1; never if empty
    std::string program{}; ///< how it is called, if it is a program of its own: "abut-walk"
};

/// A subcommand that knows its help.
class Verb : public CLI::App {
public:
    explicit Verb(VerbHelp help) : CLI::App(help.says, help.name), help_(std::move(help)) {
        group(help_.group);
    }
    [[nodiscard]] const VerbHelp& help_of_verb() const { return help_; }

private:
    VerbHelp help_;
};

/// Returns the verbs that have a group, in their order.
std::vector<const Verb*> verbs_of(const CLI::App& root);

/// An option or an argument of a verb.
struct OptionFacts {
    std::vector<std::string> names; ///< "-h", "--help"; for an argument its name in capitals
    std::string value;              ///< placeholder of its value ("FILE"); empty for a flag
    std::vector<std::string> choices;
    std::string brief; ///< one line
    std::string says;  ///< with choices, default, and the options it needs and excludes
    bool is_argument = false;
    bool required = false;
    bool repeated = false;
};

struct OptionGroup {
    std::string title;
    std::vector<OptionFacts> options;
};

/// Returns the arguments, then the options by group; the options of all verbs come last.
std::vector<OptionGroup> options_of(const CLI::App& app);

/// Returns the usage line, such as "abut collide [OPTIONS] A B".
std::string usage_of(const CLI::App& app);

struct ExitStatus {
    std::string status, says;
};
/// In          problem: when the exit status is 1; never if empty.
std::vector<ExitStatus> exit_statuses(const std::string& problem);

/// Examples of the command as a whole.
const std::vector<Example>& general_examples();

} // namespace abut::command
