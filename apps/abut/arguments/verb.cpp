#include "arguments/verb.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace abut::command {

namespace {

constexpr const char* kArguments = "Arguments";

/// Returns the words in the braces of CLI11's type name for a set: "TEXT:{aabb,obb}".
std::vector<std::string> choices_of(const std::string& type) {
    const std::size_t begin = type.find('{'), end = type.rfind('}');
    std::vector<std::string> words;
    if (begin == std::string::npos || end == std::string::npos)
        return words;
    for (std::size_t at = begin + 1; at <= end;) {
        const std::size_t comma = std::min(type.find(',', at), end);
        words.push_back(type.substr(at, comma - at));
        at = comma + 1;
    }
    return words;
}

/// Returns whether a text has a word, and not only as a part of another one.
bool has_word(const std::string& text, const std::string& word) {
    const auto is_of_word = [&](std::size_t at) {
        return at < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
    };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if ((at == 0 || !is_of_word(at - 1)) && !is_of_word(at + word.size()))
            return true;
    return false;
}

/// Returns the placeholder of a value: the name of a check if there is one ("LENGTH" of
/// "FLOAT:LENGTH"), because it says more than the type.
std::string value_of(const std::string& type) {
    if (type.find('{') != std::string::npos)
        return "WORD";
    const std::size_t colon = type.rfind(':');
    return colon == std::string::npos ? type : type.substr(colon + 1);
}

std::string names_of(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    names.reserve(options.size());
    for (const CLI::Option* option : options)
        names.push_back(option->get_name());
    std::sort(names.begin(), names.end());
    return fmt::format("{}", fmt::join(names, ", "));
}

OptionFacts facts_of(const CLI::Option& option) {
    OptionFacts facts;
    facts.is_argument = option.get_positional();
    facts.required = option.get_required();
    facts.repeated = option.get_expected_max() > 1;
    facts.says = facts.brief = option.get_description();
    if (facts.is_argument)
        facts.names = {option.get_name(true, false)};
    for (const std::string& name : option.get_snames())
        facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        facts.names.push_back("--" + name);
    if (option.get_type_size() != 0) {
        facts.choices = choices_of(option.get_type_name());
        facts.value =
            facts.choices.size() == 1 ? facts.choices.front() : value_of(option.get_type_name());
    }
    const auto add = [&](const std::string& sentence) { facts.says += ". " + sentence; };
    const bool are_told = std::ranges::all_of(
        facts.choices, [&](const std::string& word) { return has_word(facts.brief, word); });
    if (facts.choices.size() > 1 && !are_told)
        add(fmt::format("One of {}", fmt::join(facts.choices, ", ")));
    if (!option.get_default_str().empty())
        add("Default: " + option.get_default_str());
    if (!facts.is_argument && facts.required)
        add("Required");
    if (!option.get_needs().empty())
        add("Only with " + names_of(option.get_needs()));
    if (!option.get_excludes().empty())
        add("Not with " + names_of(option.get_excludes()));
    return facts;
}

} // namespace

namespace {

/// How a program of its own is called; empty for a verb of abut.
std::string program_of(const CLI::App& app) {
    const auto* const verb = dynamic_cast<const Verb*>(&app);
    return verb == nullptr ? "" : verb->help_of_verb().program;
}

} // namespace

std::vector<const Verb*> verbs_of(const CLI::App& root) {
    std::vector<const Verb*> verbs;
    for (const CLI::App* app : root.get_subcommands({}))
        if (const auto* verb = dynamic_cast<const Verb*>(app);
            verb != nullptr && !verb->get_group().empty())
            verbs.push_back(verb);
    return verbs;
}

std::vector<OptionGroup> options_of(const CLI::App& app) {
    std::vector<OptionGroup> groups{{kArguments, {}}};
    OptionGroup common{program_of(app).empty() ? kCommonGroup : kOtherOptions, {}};
    const auto add = [&](const std::string& title, const CLI::Option& option) {
        const OptionFacts facts = facts_of(option);
        const bool is_common = title == kCommonGroup || &option == app.get_help_ptr();
        if (is_common) {
            common.options.push_back(facts);
            return;
        }
        const std::string& name = facts.is_argument ? kArguments : title;
        auto group = std::ranges::find(groups, name, &OptionGroup::title);
        if (group == groups.end())
            group = groups.insert(groups.end(), {name, {}});
        group->options.push_back(facts);
    };
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty()) // CLI11 hides an option without a group
            add(option->get_group(), *option);
    // In CLI11, a subcommand without a name is a group of options.
    for (const CLI::App* group : app.get_subcommands({}))
        if (group->get_name().empty())
            for (const CLI::Option* option : group->get_options())
                if (option != group->get_help_ptr())
                    add(group->get_group() + " (" + group->get_description() + ")", *option);
    if (!common.options.empty()) // moves --help to the end
        std::rotate(common.options.begin(), common.options.begin() + 1, common.options.end());
    groups.push_back(common);
    std::erase_if(groups, [](const OptionGroup& group) { return group.options.empty(); });
    return groups;
}

std::string usage_of(const CLI::App& app) {
    const std::string program = program_of(app);
    std::string usage = (program.empty() ? "abut " + app.get_name() : program) + " [OPTIONS]";
    for (const CLI::Option* option : app.get_options())
        if (option->get_positional()) {
            std::string name = option->get_name(true, false);
            name += option->get_expected_max() > 1 ? "..." : "";
            usage += option->get_required() ? " " + name : " [" + name + "]";
        }
    return usage;
}

std::vector<ExitStatus> exit_statuses(const std::string& problem) {
    std::vector<ExitStatus> statuses{{"0", "done"}};
    if (!problem.empty())
        statuses.push_back({"1", "done, and " + problem});
    statuses.push_back(
        {"2", "bad usage or input: one line on standard error names the problem and the file"});
    statuses.push_back({"130", "interrupted"});
    return statuses;
}

const std::vector<Example>& general_examples() {
    static const std::vector<Example> examples{
        {"abut info model.glb", "parts, triangles, bounds and defects of a model"},
        {"abut clash design.glb pipes.glb --clearance 50mm --out report",
         "finds every clash between two models and writes the page report/report.html"}};
    return examples;
}

} // namespace abut::command
