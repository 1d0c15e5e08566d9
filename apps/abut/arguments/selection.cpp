#include "arguments/selection.h"

#include <abut/error.h>

#include "arguments/common.h"

#include <algorithm>
#include <array>

namespace abut::command {

namespace {

PartQuery parse_query(const char* option, const std::string& text) {
    if (text.empty())
        return {};
    try {
        return PartQuery::parse(text);
    } catch (const Error& error) {
        throw Error(ErrorCode::bad_argument, option, error.what());
    }
}

std::vector<Neighbours> parse_neighbours(const std::string& words) {
    if (words.empty())
        return {};
    std::vector<std::string> known{"neighbours"};
    for (const Neighbours neighbours : kNeighbours)
        known.emplace_back(abut::to_string(neighbours));
    std::vector<Neighbours> result;
    for (const std::string& word : parse_words("--leave-out", words, known))
        for (const Neighbours neighbours : kNeighbours)
            if ((word == "neighbours" || word == abut::to_string(neighbours)) &&
                std::ranges::find(result, neighbours) == result.end())
                result.push_back(neighbours);
    std::ranges::sort(result); // so that the question of a store does not depend on the order
    return result;
}

} // namespace

void add_selection(CLI::App& app, SelectionArguments& arguments) {
    const auto add = [&](const char* option, std::string& value, const char* help,
                         const char* what) {
        app.add_option(option, value, help)->check(not_empty(what));
    };
    add("--only", arguments.only,
        "Only pairs of parts that both match: 'storey = L2 and not type = IfcSpace' "
        "(docs/selecting.md)",
        "CONDITION");
    add("--a", arguments.a, "Only pairs of which one part matches this condition, and",
        "CONDITION");
    add("--b", arguments.b, "the other part this one", "CONDITION");
    add("--rules", arguments.rules,
        "JSON or TOML file that selects pairs and their tolerances (docs/selecting.md)", "FILE");
    add("--matrix", arguments.matrix,
        "JSON or TOML file with groups of parts, and how each two are examined", "FILE");
    app.add_option("--preset", arguments.preset,
                   "A matrix that Abut brings along: mep-structure, clearances or architecture")
        ->check(
            CLI::IsMember(std::vector<std::string>(kMatrixPresets.begin(), kMatrixPresets.end())));
    add("--leave-out", arguments.leave_out,
        "Do not test known neighbours: fills, connected, covers, same_assembly (comma-separated), "
        "or all neighbours",
        "WORDS");
    app.add_option("--sort", arguments.sort,
                   "Order of the clashes: part (default), or volume: the worst first")
        ->check(CLI::IsMember({"part", "volume"}));
}

void read_selection(const SelectionArguments& arguments, ClashOptions& options) {
    if (!arguments.matrix.empty() && !arguments.preset.empty())
        throw Error(ErrorCode::bad_argument, "--preset", "cannot be combined with --matrix");
    options.only = parse_query("--only", arguments.only);
    options.a = parse_query("--a", arguments.a);
    options.b = parse_query("--b", arguments.b);
    options.leave_out = parse_neighbours(arguments.leave_out);
    if (!arguments.rules.empty())
        options.rules = read_rules(arguments.rules);
    if (!arguments.matrix.empty())
        options.matrix = read_matrix(arguments.matrix);
    if (!arguments.preset.empty())
        options.matrix = matrix_preset(arguments.preset);
    options.order = arguments.sort == "volume" ? ClashOrder::volume : ClashOrder::part;
}

} // namespace abut::command
