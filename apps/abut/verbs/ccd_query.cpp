#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "arguments/elementary_arguments.h"
#include "commands.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <numeric>

namespace abut::command {

namespace {

struct QueryArguments {
    std::vector<std::string> files;
    std::string truth_file, kind;
    ElementaryArguments elementary;
};

/// Totals of the answers to the queries of one file, or of all files.
struct Tally {
    std::size_t queries = 0, hits = 0;
    bool has_truth = true;
    std::size_t positives = 0, false_negatives = 0, false_positives = 0;
    std::array<std::size_t, 3> decided_by{}; ///< answers decided by each stage
    std::vector<double> nanoseconds;         ///< by query

    void add(const Tally& other) {
        queries += other.queries;
        hits += other.hits;
        has_truth = has_truth && other.has_truth;
        positives += other.positives;
        false_negatives += other.false_negatives;
        false_positives += other.false_positives;
        for (std::size_t i = 0; i < decided_by.size(); ++i)
            decided_by.at(i) += other.decided_by.at(i);
        nanoseconds.insert(nanoseconds.end(), other.nanoseconds.begin(), other.nanoseconds.end());
    }
    [[nodiscard]] double mean_ns() const {
        const double sum = std::accumulate(nanoseconds.begin(), nanoseconds.end(), 0.0);
        return nanoseconds.empty() ? 0 : sum / static_cast<double>(nanoseconds.size());
    }
    /// Returns the time below which this share of the queries lies, in nanoseconds.
    [[nodiscard]] double quantile_ns(double share) const {
        if (nanoseconds.empty())
            return 0;
        std::vector<double> sorted = nanoseconds;
        std::sort(sorted.begin(), sorted.end());
        const auto last = static_cast<double>(sorted.size() - 1);
        return sorted[static_cast<std::size_t>(share * last)];
    }
};

std::optional<ElementaryKind> kind_of(const QueryArguments& arguments) {
    if (arguments.kind.empty())
        return std::nullopt;
    return arguments.kind == "vertex-face" ? ElementaryKind::vertex_face
                                           : ElementaryKind::edge_edge;
}

/// Reads a list of true and false (or 1 and 0), one for each query of all files in their order.
std::vector<bool> read_truth(const std::string& file) {
    if (!std::filesystem::exists(file))
        throw Error(ErrorCode::file_not_found, file, "no such file");
    std::ifstream stream(file);
    if (!stream)
        throw Error(ErrorCode::unreadable, file, "cannot be read");
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_array())
        throw Error(ErrorCode::malformed, file, "is not a JSON list");
    std::vector<bool> truth;
    for (const auto& value : json) {
        const bool is_bool = value.is_boolean() || value == 0 || value == 1;
        if (!is_bool)
            throw Error(ErrorCode::malformed, file,
                        fmt::format("[{}] is neither true nor false", truth.size()));
        truth.push_back(value.is_boolean() ? value.get<bool>() : value == 1);
    }
    return truth;
}

/// Replaces the expected answers of the queries by those of a file.
void replace_truth(const std::string& file, std::vector<ElementaryQueries>& queries) {
    const std::vector<bool> truth = read_truth(file);
    std::size_t pairs = 0;
    for (const ElementaryQueries& each : queries)
        pairs += each.pairs.size();
    if (truth.size() != pairs)
        throw Error(ErrorCode::malformed, file,
                    fmt::format("has {} values for {} queries", truth.size(), pairs));
    auto next = truth.begin();
    for (ElementaryQueries& each : queries) {
        const auto end = next + static_cast<std::ptrdiff_t>(each.pairs.size());
        each.truth.assign(next, end);
        next = end;
    }
}

/// Measures the time of a query. It is repeated for some microseconds, because a clock cannot
/// resolve a single one.
double nanoseconds_of(const ElementaryPair& pair, const ElementaryOptions& options) {
    constexpr int kMostRepeats = 16;
    constexpr double kLongEnough = 4e-6;
    bool hit = elementary_impact(pair, options).meet; // warms the caches
    const Stopwatch watch;
    double seconds = 0;
    int repeats = 0;
    for (; repeats < kMostRepeats && seconds < kLongEnough; repeats += 4) {
        for (int i = 0; i < 4; ++i)
            hit = elementary_impact(pair, options).meet || hit;
        seconds = watch.seconds();
    }
    return 1e9 * seconds / repeats;
}

Tally answer(const ElementaryQueries& queries, const ElementaryOptions& options) {
    const auto impacts = elementary_impacts(queries.pairs, options);
    Tally tally;
    tally.queries = queries.pairs.size();
    tally.has_truth = !queries.truth.empty();
    for (std::size_t i = 0; i < impacts.size(); ++i) {
        const bool hit = impacts[i].meet;
        tally.hits += hit ? 1 : 0;
        ++tally.decided_by.at(static_cast<std::size_t>(impacts[i].decided_by));
        if (tally.has_truth) {
            tally.positives += queries.truth[i] ? 1 : 0;
            tally.false_negatives += queries.truth[i] && !hit ? 1 : 0;
            tally.false_positives += hit && !queries.truth[i] ? 1 : 0;
        }
        tally.nanoseconds.push_back(nanoseconds_of(queries.pairs[i], options));
    }
    return tally;
}

nlohmann::ordered_json describe_tally(const Tally& tally) {
    nlohmann::ordered_json row{{"queries", tally.queries}, {"hits", tally.hits}};
    const auto count = [&](const char* key, std::size_t n) {
        row[key] = tally.has_truth ? nlohmann::ordered_json(n) : nlohmann::ordered_json();
    };
    count("positives", tally.positives);
    count("false_negatives", tally.false_negatives);
    count("false_positives", tally.false_positives);
    row["mean_ns"] = tally.mean_ns();
    row["median_ns"] = tally.quantile_ns(0.5);
    row["p90_ns"] = tally.quantile_ns(0.9);
    row["p99_ns"] = tally.quantile_ns(0.99);
    row["decided_by"] = {{"filter", tally.decided_by[0]},
                         {"interval", tally.decided_by[1]},
                         {"exact", tally.decided_by[2]}};
    return row;
}

/// Returns a file's name as a column, or as a line of its own if the terminal is narrower than a
/// row.
std::string file_column(const std::string& name) {
    constexpr int kRow = 132;
    const int columns = columns_of(stdout);
    return columns > 0 && columns < kRow ? name + "\n  " : fmt::format("{:<52} ", name);
}

std::string table_row(const std::string& name, const Tally& tally) {
    const auto count = [&](std::size_t n) { return tally.has_truth ? grouped(n) : "-"; };
    return file_column(shown(name)) +
           fmt::format("{:>9} {:>9} {:>9} {:>9} {:>9} {:>9.0f} {:>9.0f}\n", grouped(tally.queries),
                       grouped(tally.hits), count(tally.positives), count(tally.false_negatives),
                       count(tally.false_positives), tally.mean_ns(), tally.quantile_ns(0.5));
}

int run(const QueryArguments& arguments, const CommonOptions& common) {
    const ElementaryOptions options = arguments.elementary.options();
    // The expected answers of a file are about features that touch, without a thickness.
    if (options.thickness > 0 && !arguments.truth_file.empty())
        throw Error(ErrorCode::bad_argument, "--truth cannot be combined with --thickness");
    std::vector<ElementaryQueries> queries;
    for (const std::string& file : arguments.files) {
        queries.push_back(read_elementary_queries(file, kind_of(arguments)));
        if (options.thickness > 0)
            queries.back().truth.clear();
    }
    if (!arguments.truth_file.empty())
        replace_truth(arguments.truth_file, queries);

    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    std::string text = file_column("file") +
                       fmt::format("{:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "queries", "hits",
                                   "positives", "false neg", "false pos", "mean ns", "median ns");
    Tally total;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Tally tally = answer(queries[i], options);
        total.add(tally);
        nlohmann::ordered_json row{{"file", arguments.files[i]}};
        row.update(describe_tally(tally));
        files.push_back(std::move(row));
        text += table_row(std::filesystem::path(arguments.files[i]).filename().string(), tally);
    }
    if (common.json)
        print_json(dump({{"mode", arguments.elementary.mode},
                         {"delta", options.absolute_error},
                         {"thickness", options.thickness},
                         {"files", std::move(files)},
                         {"total", describe_tally(total)}}));
    else if (!common.quiet)
        print_text(text + table_row("total", total));
    return kExitDone;
}

} // namespace

Subcommand add_ccd_query(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<QueryArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"ccd-query",
         kDeforming,
         "Elementary tests of continuous collision: compare answers with known ones, and measure "
         "times",
         {{"abut ccd-query queries-vertex-face.csv",
           "do a vertex and a face meet between t = 0 and 1? Eight rows a query"},
          {"abut ccd-query queries.csv --kind edge-edge --mode conservative --delta 1e-6",
           "no impact is missed; pairs nearer than a micrometre may be reported"}},
         ""});
    app->add_option("CSV", arguments->files, "Files of queries: eight rows each")->required();
    app->add_option("--truth", arguments->truth_file,
                    "JSON list of the answers to all queries, in their order")
        ->check(not_empty("JSON"));
    app->add_option("--kind", arguments->kind,
                    "vertex-face or edge-edge (default: taken from the file's name)")
        ->check(CLI::IsMember({"vertex-face", "edge-edge"}));
    add_elementary_arguments(*app, arguments->elementary);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
