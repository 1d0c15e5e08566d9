#include "help/help.h"

#include "text/screen.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace abut::command {

namespace {

// The positions where the second column begins.
constexpr std::size_t kOptionColumn = 24, kVerbColumn = 18;

/// Returns the width of the text: that of the terminal, at most 100 columns for legibility; 80
/// without a terminal.
std::size_t text_width() {
    const int columns = columns_of(stdout);
    return columns == 0 ? 80 : static_cast<std::size_t>(std::clamp(columns, 40, 100));
}

/// Wraps a text to the text width. All lines but the first are indented.
std::string wrapped(std::string_view text, std::size_t first_column, std::size_t indent) {
    const std::size_t width = text_width();
    std::string out;
    std::size_t column = first_column;
    bool is_first = true;
    while (!text.empty()) {
        const std::size_t space = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, space);
        text.remove_prefix(std::min(space + 1, text.size()));
        if (!is_first && column + 1 + word.size() > width) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            out += ' ';
            ++column;
        }
        out += word;
        column += word.size();
        is_first = false;
    }
    return out + "\n";
}

std::string section(const std::string& title) {
    return fmt::format("\n{}\n", coloured(Colour::heading, title + ":"));
}

/// Formats "  NAME    text" with the text in a second column; it begins on the next line if the
/// name is too long.
std::string row(const std::string& name, const std::string& says, std::size_t column) {
    std::string text = "  " + name;
    if (text.size() + 2 > column)
        text += "\n" + std::string(column, ' ');
    else
        text.resize(column, ' ');
    return text + wrapped(says, column, column);
}

std::string option_row(const OptionFacts& option, std::size_t column) {
    std::string name = fmt::format("{}", fmt::join(option.names, ", "));
    if (!option.value.empty() && !option.is_argument)
        name += " " + option.value;
    if (option.repeated)
        name += "...";
    return row(name, option.says, column);
}

std::string example_section(const std::vector<Example>& examples) {
    std::string text = section("Examples");
    for (const Example& example : examples)
        text += fmt::format("  {}\n      {}", example.line, wrapped(example.says, 6, 6));
    return text;
}

std::string status_section(const std::string& problem) {
    std::string text = section("Exit status");
    for (const ExitStatus& each : exit_statuses(problem))
        text += row(each.status, each.says, 7);
    return text;
}

} // namespace

std::string general_help(const CLI::App& root) {
    std::string text =
        wrapped(root.get_description(), 0, 0) +
        fmt::format("\n{} abut VERB [OPTIONS] ARGUMENTS\n", coloured(Colour::heading, "Usage:"));
    const std::vector<const Verb*> verbs = verbs_of(root);
    std::string group;
    for (const Verb* verb : verbs) {
        if (verb->get_group() != group)
            text += section(group = verb->get_group());
        text += row(verb->get_name(), verb->get_description(), kVerbColumn);
    }
    text += section(std::string(kCommonGroup) + ", before or after the verb");
    for (const OptionGroup& options : options_of(*verbs.front()))
        if (options.title == kCommonGroup)
            for (const OptionFacts& option : options.options)
                text += option_row(option, kVerbColumn);
    text += section("Other options") + row("--version", "Print the version and exit", kVerbColumn);
    text += example_section(general_examples());
    text += status_section("the problem that --fail-on names was found");
    return text + "\n" +
           wrapped("abut VERB --help and man abut-VERB list the options of a verb, with examples.",
                   0, 0);
}

std::string help_of(const Verb& verb) {
    const VerbHelp& help = verb.help_of_verb();
    std::string text =
        wrapped(help.says, 0, 0) +
        fmt::format("\n{} {}\n", coloured(Colour::heading, "Usage:"), usage_of(verb));
    for (const OptionGroup& group : options_of(verb)) {
        text += section(group.title);
        for (const OptionFacts& option : group.options)
            text += option_row(option, kOptionColumn);
    }
    if (const std::string note = note_on_lengths(options_of(verb)); !note.empty())
        text += "\n" + wrapped(note, 0, 0);
    return text + example_section(help.examples) + status_section(help.problem);
}

std::string note_on_lengths(const std::vector<OptionGroup>& groups) {
    for (const OptionGroup& group : groups)
        if (std::ranges::find(group.options, "LENGTH", &OptionFacts::value) != group.options.end())
            return "A LENGTH is in metres unless it has a unit: 50mm, 5cm, 0.05m, 2in, 1ft.";
    return "";
}

} // namespace abut::command
