#include "arguments/command_line.h"

#include <abut/error.h>

#include "arguments/common.h"
#include "arguments/verb.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace abut::command {

namespace {

using Words = std::vector<std::string>;

bool is_option(const std::string& word) {
    const bool negative_number =
        word.size() > 1 &&
        (std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.');
    return word.size() > 1 && word[0] == '-' && !negative_number;
}

/// Returns the option's name: "--out" for "--out=FOLDER".
std::string name_of_option(const std::string& word) {
    return word.substr(0, word.find('='));
}

/// Returns the word in lower case and without leading dashes, because case and dashes are mistyped
/// most often.
std::string bare(const std::string& word) {
    std::string letters = word.substr(std::min(word.find_first_not_of('-'), word.size()));
    std::ranges::transform(letters, letters.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return letters;
}

std::vector<OptionFacts> all_options(const CLI::App& app) {
    std::vector<OptionFacts> all;
    for (const OptionGroup& group : options_of(app))
        for (const OptionFacts& option : group.options)
            if (!option.is_argument)
                all.push_back(option);
    return all;
}

const OptionFacts* find(const std::vector<OptionFacts>& options, const std::string& name) {
    const auto found = std::ranges::find_if(options, [&](const OptionFacts& option) {
        return std::ranges::find(option.names, name) != option.names.end();
    });
    return found == options.end() ? nullptr : &*found;
}

/// Returns the number of words from `at` on that are one option with its value; 0 if the verb has
/// no such option.
std::size_t words_of_option(const std::vector<OptionFacts>& options, const Words& words,
                            std::size_t at) {
    const OptionFacts* const option = find(options, name_of_option(words[at]));
    if (option == nullptr)
        return 0;
    const bool apart = !option->value.empty() && words[at].find('=') == std::string::npos;
    return apart ? 2 : 1;
}

/// Returns whether all words before `end` are options of the verb with their values.
bool are_options(const CLI::App& verb, const Words& words, std::size_t end) {
    const std::vector<OptionFacts> options = all_options(verb);
    std::size_t at = 0;
    while (at < end) {
        const std::size_t count = words_of_option(options, words, at);
        if (count == 0)
            return false;
        at += count;
    }
    return at == end;
}

/// Returns the first option whose help names a file of a type: "--csv" is one of the files of --out.
const OptionFacts* find_file_type(const std::vector<OptionFacts>& options,
                                  const std::string& type) {
    const auto names_one = [&](const OptionFacts& option) {
        const std::string& brief = option.brief;
        const std::size_t at = brief.find("." + type), end = at + 1 + type.size();
        return at != std::string::npos &&
               (end == brief.size() || std::isalnum(static_cast<unsigned char>(brief[end])) == 0);
    };
    const auto found = std::ranges::find_if(options, names_one);
    return found == options.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_option(const CLI::App& verb, const std::vector<OptionFacts>& options,
                                const std::string& name) {
    Words names;
    for (const OptionFacts& option : options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    const std::string like = most_like(name, names);
    std::string hint = fmt::format("see abut {} --help", verb.get_name());
    if (!like.empty())
        hint = fmt::format("did you mean {}?", like);
    else if (const OptionFacts* const option = find_file_type(options, bare(name)))
        hint = fmt::format("did you mean {}? {}", option->names.back(), option->brief);
    throw Error(ErrorCode::bad_argument, fmt::format("unknown option '{}' ({})", name, hint));
}

/// Refuses a unit that is a word of its own: it would be taken for a file.
void refuse_lone_unit(const OptionFacts& option, const Words& words, std::size_t at) {
    if (option.value != "LENGTH" || at + 2 >= words.size() || !parse_number(words[at + 1]))
        return;
    const std::string joined = words[at + 1] + words[at + 2];
    const bool is_unit = !parse_number(joined) && parse_length(joined) &&
                         std::isalpha(static_cast<unsigned char>(words[at + 2][0])) != 0;
    if (is_unit)
        throw Error(ErrorCode::bad_argument,
                    fmt::format("{}: write {} without a space", option.names.back(), joined));
}

/// Refuses options that the verb does not have, a last option that lacks its value, and a length
/// whose unit stands apart.
void refuse_wrong_options(const CLI::App& verb, const Words& words) {
    const std::vector<OptionFacts> options = all_options(verb);
    for (std::size_t at = 0; at < words.size();) {
        if (words[at] == "--")
            return;
        const std::size_t count = is_option(words[at]) ? words_of_option(options, words, at) : 1;
        if (at + count > words.size())
            throw Error(ErrorCode::bad_argument, fmt::format("{} needs a value: {}", words[at],
                                                             find(options, words[at])->value));
        if (count == 2)
            refuse_lone_unit(*find(options, name_of_option(words[at])), words, at);
        if (count > 0) {
            at += count;
            continue;
        }
        refuse_option(verb, options, name_of_option(words[at]));
    }
}

const CLI::App* find_verb(const CLI::App& root, const std::string& name) {
    const auto apps = root.get_subcommands({});
    const auto found =
        std::ranges::find_if(apps, [&](const CLI::App* app) { return app->get_name() == name; });
    return found == apps.end() ? nullptr : *found;
}

/// Returns the index of the verb. It is the first word that is a verb and has only its own options
/// before it, else the first word that is a verb.
std::optional<std::size_t> place_of_verb(const CLI::App& root, const Words& words) {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (const CLI::App* verb = find_verb(root, words[i])) {
            if (are_options(*verb, words, i))
                return i;
            first = first.value_or(i);
        }
    const bool begins_with_option = is_option(words.front());
    return begins_with_option ? first : std::nullopt;
}

[[noreturn]] void refuse_verb(const CLI::App& root, const Words& words) {
    Words names;
    for (const Verb* verb : verbs_of(root))
        names.push_back(verb->get_name());
    std::string word, like;
    for (const std::string& each : words)
        if (!is_option(each) && like.empty()) {
            like = most_like(each, names);
            word = word.empty() || !like.empty() ? each : word;
        }
    if (word.empty())
        throw Error(ErrorCode::bad_argument, "no verb is given (see abut --help)");
    throw Error(
        ErrorCode::bad_argument,
        fmt::format("unknown verb '{}' ({})", word,
                    like.empty() ? "see abut --help" : fmt::format("did you mean {}?", like)));
}

/// Returns the optimal string alignment distance: the number of letters to insert, delete, change
/// or swap with the next one.
std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    std::iota(d[0].begin(), d[0].end(), 0U);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        d[i][0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1,
                                d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

} // namespace

std::string most_like(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t kFewLetters = 3;
    const std::string typed = bare(word);
    std::string best;
    std::size_t least = typed.size() / 3 + (typed.size() < kFewLetters ? 0 : 1);
    for (const std::string& name : names) {
        const std::string letters = bare(name);
        // A word that continues a name or is its beginning counts as one wrong letter at most.
        const bool is_start = std::min(typed.size(), letters.size()) >= kFewLetters &&
                              (typed.starts_with(letters) || letters.starts_with(typed));
        const std::size_t count =
            is_start ? std::min<std::size_t>(1, edits(typed, letters)) : edits(typed, letters);
        if (count < least || (count == least && best.empty() && count < letters.size())) {
            best = name;
            least = count;
        }
    }
    return best;
}

std::vector<std::string> arranged(const CLI::App& root, std::vector<std::string> words) {
    if (words.empty())
        return words;
    if (words.front() == "help") {
        words.erase(words.begin());
        words.emplace_back("--help");
    }
    const auto place = place_of_verb(root, words);
    if (!place) {
        if (find(all_options(root), words.front()) != nullptr)
            return words; // --help, --version
        refuse_verb(root, words);
    }
    const auto verb = words.begin() + static_cast<std::ptrdiff_t>(*place);
    std::rotate(words.begin(), verb, verb + 1);
    refuse_wrong_options(*find_verb(root, words.front()), {words.begin() + 1, words.end()});
    return words;
}

} // namespace abut::command
