#include "help/man_page.h"

#include "help/help.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <string_view>

namespace abut::command {

namespace {

/// Escapes a text for roff, so that it contains no request and no escape, and hyphens are copied as
/// typed.
std::string roff(std::string_view text) {
    std::string out;
    if (text.starts_with('.') || text.starts_with('\''))
        out += "\\&";
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else
            out += c;
    }
    return out;
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string head(const std::string& name, const std::string& says) {
    return fmt::format(".\\\" Made by abut generate.\n.TH {} 1 \"\" \"Abut {}\" \"Abut\"\n"
                       ".SH NAME\n{} \\- {}\n",
                       roff(upper(name)), ABUT_VERSION, roff(name), roff(says));
}

std::string synopsis(const std::string& usage) {
    return ".SH SYNOPSIS\n.nf\n" + roff(usage) + "\n.fi\n";
}

std::string roff_section(const std::string& title) {
    return fmt::format(".SH \"{}\"\n", roff(upper(title)));
}

std::string tagged(const std::string& tag, const std::string& says) {
    return fmt::format(".TP\n{}\n{}\n", tag, roff(says));
}

std::string bold(const std::string& text) {
    return "\\fB" + roff(text) + "\\fR";
}

std::string option_entry(const OptionFacts& option) {
    std::string tag;
    for (const std::string& name : option.names)
        tag += (tag.empty() ? "" : ", ") + bold(name);
    if (!option.value.empty() && !option.is_argument)
        tag += " \\fI" + roff(option.value) + "\\fR";
    if (option.repeated)
        tag += "...";
    return tagged(tag, option.says);
}

std::string roff_examples(const std::vector<Example>& all) {
    std::string text = roff_section("Examples");
    for (const Example& example : all)
        text += tagged(bold(example.line), example.says);
    return text;
}

std::string statuses(const std::string& problem) {
    std::string text = roff_section("Exit status");
    for (const ExitStatus& each : exit_statuses(problem))
        text += tagged(bold(each.status), each.says);
    return text;
}

} // namespace

std::string man_page(const CLI::App& root) {
    std::string text = head("abut", root.get_description()) +
                       synopsis("abut VERB [OPTIONS] ARGUMENTS\nabut VERB --help") +
                       roff_section("Verbs");
    const std::vector<const Verb*> verbs = verbs_of(root);
    std::string group, see_also;
    for (const Verb* verb : verbs) {
        if (verb->get_group() != group)
            text += ".SS \"" + roff(group = verb->get_group()) + "\"\n";
        text += tagged(bold(verb->get_name()), verb->get_description());
        see_also += fmt::format(".BR {} (1){}\n", roff("abut-" + verb->get_name()),
                                verb == verbs.back() ? "" : " ,");
    }
    text += roff_section("Options");
    for (const CLI::Option* option : root.get_options())
        text += tagged(bold(option->get_name(false, true)), option->get_description());
    for (const OptionGroup& options : options_of(*verbs.front()))
        if (options.title == kCommonGroup) {
            text += ".SS \"" + roff(kCommonGroup) + "\"\n";
            for (const OptionFacts& option : options.options)
                text += option_entry(option);
        }
    return text + roff_examples(general_examples()) +
           statuses("the problem that --fail-on names was found") + roff_section("See also") +
           see_also;
}

std::string man_page(const Verb& verb) {
    const VerbHelp& help = verb.help_of_verb();
    std::string text = head("abut-" + help.name, help.says) + synopsis(usage_of(verb));
    for (const OptionGroup& group : options_of(verb)) {
        text += roff_section(group.title);
        for (const OptionFacts& option : group.options)
            text += option_entry(option);
    }
    if (const std::string note = note_on_lengths(options_of(verb)); !note.empty())
        text += ".PP\n" + roff(note) + "\n";
    return text + roff_examples(help.examples) + statuses(help.problem) + roff_section("See also") +
           ".BR abut (1)\n";
}

} // namespace abut::command
