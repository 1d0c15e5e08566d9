#include "help/completion.h"

#include "arguments/verb.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <vector>

namespace abut::command {

namespace {

/// Functions that both completions for bash use.
constexpr const char* kBashHelpers =
    "_abut_words() { mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$current\"); }\n"
    "_abut_folders() {\n"
    "    mapfile -t COMPREPLY < <(compgen -d -- \"$current\")\n"
    "    compopt -o filenames 2>/dev/null\n"
    "}\n"
    "_abut_nothing() { compopt +o default +o bashdefault 2>/dev/null; }\n";

std::vector<OptionFacts> options_in_a_row(const CLI::App& app) {
    std::vector<OptionFacts> all;
    for (OptionGroup& group : options_of(app))
        std::ranges::move(group.options, std::back_inserter(all));
    return all;
}

bool takes_file(const OptionFacts& option) {
    constexpr std::array<std::string_view, 2> kFiles{"FILE", "JSON"};
    return std::ranges::find(kFiles, option.value) != kFiles.end();
}

bool takes_folder(const OptionFacts& option) {
    return option.value == "FOLDER";
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> names_of_verbs(const CLI::App& root) {
    std::vector<std::string> names;
    for (const Verb* verb : verbs_of(root))
        names.push_back(verb->get_name());
    return names;
}

/// Returns the bash code that completes the value of an option; empty for a file name, which bash
/// itself completes.
std::string bash_value(const OptionFacts& option) {
    if (!option.choices.empty())
        return fmt::format("_abut_words \"{}\"; ", joined(option.choices));
    if (takes_folder(option))
        return "_abut_folders; ";
    return takes_file(option) ? "" : "_abut_nothing; ";
}

/// Returns the bash cases "VERB OPTION) ..." that complete the values of a verb's options.
std::string bash_values(const Verb& verb) {
    std::string text;
    for (const OptionFacts& option : options_in_a_row(verb))
        for (const std::string& name : option.names)
            if (!option.is_argument && !option.value.empty())
                text += fmt::format("    \"{} {}\") {}return ;;\n", verb.get_name(), name,
                                    bash_value(option));
    return text;
}

/// Returns the bash case of a verb, with its options and the words that are valid arguments.
std::string bash_verb(const Verb& verb) {
    std::vector<std::string> names, words;
    for (const OptionFacts& option : options_in_a_row(verb)) {
        auto& to = option.is_argument ? words : names;
        const auto& from = option.is_argument ? option.choices : option.names;
        to.insert(to.end(), from.begin(), from.end());
    }
    return fmt::format("    {}) options=\"{}\" words=\"{}\" ;;\n", verb.get_name(), joined(names),
                       joined(words));
}

/// Returns the text in single quotes for a shell.
std::string in_quotes(std::string_view text) {
    std::string out = "'";
    for (const char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// Escapes the characters that would end a description in zsh.
std::string zsh_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\')
            out += '\\';
        out += c;
    }
    return out;
}

std::string zsh_action(const OptionFacts& option) {
    if (!option.choices.empty())
        return "(" + joined(option.choices) + ")";
    if (takes_folder(option))
        return "_files -/";
    return option.is_argument || takes_file(option) ? "_files" : " ";
}

/// Returns the specifications for zsh's _arguments, one per line.
std::string zsh_specs(const Verb& verb) {
    std::string text;
    int place = 0;
    for (const OptionFacts& option : options_in_a_row(verb)) {
        if (option.is_argument) {
            const std::string which = option.repeated ? "*" : std::to_string(++place);
            text += " \\\n            " +
                    in_quotes(fmt::format("{}:{}:{}", which, zsh_text(option.names.front()),
                                          zsh_action(option)));
            continue;
        }
        for (const std::string& name : option.names) {
            std::string spec =
                fmt::format("{}{}[{}]", option.repeated ? "*" : "", name, zsh_text(option.brief));
            if (!option.value.empty())
                spec += fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option));
            text += " \\\n            " + in_quotes(spec);
        }
    }
    return text;
}

} // namespace

std::string bash_completion(const CLI::App& root) {
    const std::string verbs = joined(names_of_verbs(root));
    std::string values, cases;
    for (const Verb* verb : verbs_of(root)) {
        values += bash_values(*verb);
        cases += bash_verb(*verb);
    }
    return "# Completion of abut for bash. Made by abut generate.\n" + std::string(kBashHelpers) +
           "_abut() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
           "    # bash splits --option=value into three words.\n"
           "    [[ $current == = ]] && current=\n"
           "    [[ $previous == = ]] && previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
           "    local verbs=\"" +
           verbs +
           "\"\n"
           "    local verb= options= words= i\n"
           "    for ((i = 1; i < COMP_CWORD; ++i)); do\n"
           "        [[ \" $verbs \" == *\" ${COMP_WORDS[i]} \"* ]] && verb=${COMP_WORDS[i]} && "
           "break\n"
           "    done\n"
           "    COMPREPLY=()\n"
           "    case \"$verb $previous\" in\n" +
           values +
           "    esac\n"
           "    case $verb in\n"
           "    '') options=\"--help --version\" words=\"$verbs\" ;;\n" +
           cases +
           "    esac\n"
           "    if [[ $current == -* ]]; then\n"
           "        _abut_words \"$options\"\n"
           "    elif [[ -n $words ]]; then\n"
           "        _abut_words \"$words\"\n"
           "    fi\n"
           "}\n"
           "complete -o default -o bashdefault -F _abut abut\n";
}

std::string zsh_completion(const CLI::App& root) {
    std::string verbs, cases;
    for (const Verb* verb : verbs_of(root)) {
        verbs += "        " +
                 in_quotes(verb->get_name() + ":" + zsh_text(verb->get_description())) + "\n";
        cases += fmt::format("    {})\n        _arguments{}\n        ;;\n", verb->get_name(),
                             zsh_specs(*verb));
    }
    return "#compdef abut\n"
           "# Completion of abut for zsh. Made by abut generate.\n"
           "_abut() {\n"
           "    local -a verbs\n"
           "    verbs=(\n" +
           verbs +
           "    )\n"
           "    local -i i\n"
           "    local verb=\n"
           "    for ((i = 2; i < CURRENT; ++i)); do\n"
           "        if ((${verbs[(I)${words[i]}:*]})); then\n"
           "            verb=${words[i]}\n"
           "            words[i]=()\n"
           "            ((--CURRENT))\n"
           "            break\n"
           "        fi\n"
           "    done\n"
           "    case $verb in\n" +
           cases +
           "    *)\n"
           "        if [[ ${words[CURRENT]} == -* ]]; then\n"
           "            _arguments '--help[Print the help and exit]' "
           "'--version[Print the version and exit]'\n"
           "        else\n"
           "            _describe -t verbs verb verbs\n"
           "        fi\n"
           "        ;;\n"
           "    esac\n"
           "}\n"
           "_abut \"$@\"\n";
}

std::string bash_completion_of(const Verb& program) {
    const VerbHelp& help = program.help_of_verb();
    std::vector<std::string> names;
    for (const OptionFacts& option : options_in_a_row(program))
        if (!option.is_argument)
            names.insert(names.end(), option.names.begin(), option.names.end());
    return fmt::format("# Completion of {0} for bash. Made by the build.\n{1}"
                       "_abut_{2}() {{\n"
                       "    local current=${{COMP_WORDS[COMP_CWORD]}} "
                       "previous=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
                       "    [[ $current == = ]] && current=\n"
                       "    [[ $previous == = ]] && previous=${{COMP_WORDS[COMP_CWORD - 2]}}\n"
                       "    COMPREPLY=()\n"
                       "    case \"{2} $previous\" in\n{3}    esac\n"
                       "    [[ $current == -* ]] && _abut_words \"{4}\"\n"
                       "    return 0\n}}\n"
                       "complete -o default -o bashdefault -F _abut_{2} {0}\n",
                       help.program, kBashHelpers, help.name, bash_values(program), joined(names));
}

std::string zsh_completion_of(const Verb& program) {
    return fmt::format("#compdef {0}\n# Completion of {0} for zsh. Made by the build.\n"
                       "_arguments{1}\n",
                       program.help_of_verb().program, zsh_specs(program));
}

} // namespace abut::command
