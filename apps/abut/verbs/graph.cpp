#include <abut/error.h>
#include <abut/store_clash.h>

#include "arguments/interrupt.h"
#include "arguments/output_files.h"
#include "commands.h"
#include "text/graph_drawing.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

/// Edges in a drawing, at most. More would be illegible and make the file large.
constexpr std::uint64_t kMostLines = 20'000;

struct GraphArguments {
    std::string store, memory = "512M", rules, svg;
    bool keep = false;
    ClashOptions options;
};

nlohmann::ordered_json describe(const GraphReport& graph, const std::string& store) {
    nlohmann::ordered_json units = nlohmann::ordered_json::array();
    for (const GraphReport::Unit& unit : graph.units)
        units.push_back({{"parts", unit.parts},
                         {"edges", unit.edges},
                         {"meshes", unit.meshes},
                         {"bytes", unit.bytes}});
    return {{"store", store},
            {"nodes", graph.nodes},
            {"edges", graph.edges},
            {"isolated", graph.isolated},
            {"components", graph.components},
            {"largest_component", graph.largest_component},
            {"mean_valence", graph.mean_valence},
            {"highest_valence", graph.highest_valence},
            {"bytes", graph.bytes},
            {"large_meshes", graph.large_meshes},
            {"large_bytes", graph.large_bytes},
            {"cut_edges", graph.cut_edges},
            {"units", std::move(units)},
            {"seconds", graph.seconds}};
}

std::string table(const GraphReport& graph, const std::string& store) {
    std::string text = fmt::format(
        "{}\n"
        "  nodes       {:>14}  parts, {} of them without an edge\n"
        "  edges       {:>14}  pairs of parts within the clearance\n"
        "  components  {:>14}  the largest of {} parts\n"
        "  valence     {:>14.2f}  on average, {} at most\n"
        "  models      {:>14}  bytes of meshes and hierarchies that edges need\n"
        "  large       {:>14}  of these bytes, in {} meshes of which only a few blocks are in "
        "memory\n"
        "  units       {:>14}  work units, each of which fits into the memory\n"
        "  cut         {:>14}  edges between units\n"
        "seconds     {:.2f}\n",
        shown(store), grouped(graph.nodes), grouped(graph.isolated), grouped(graph.edges),
        grouped(graph.components), grouped(graph.largest_component), graph.mean_valence,
        grouped(graph.highest_valence), grouped(graph.bytes), grouped(graph.large_bytes),
        grouped(graph.large_meshes), grouped(graph.units.size()), grouped(graph.cut_edges),
        graph.seconds);
    constexpr std::size_t kMostUnits = 40;
    if (graph.units.size() > 1)
        text += "\n  unit     parts     edges    meshes         bytes\n";
    for (std::size_t i = 0; i < std::min(kMostUnits, graph.units.size()) && graph.units.size() > 1;
         ++i) {
        const GraphReport::Unit& unit = graph.units[i];
        text += fmt::format("  {:>4} {:>9} {:>9} {:>9} {:>13}\n", i + 1, grouped(unit.parts),
                            grouped(unit.edges), grouped(unit.meshes), grouped(unit.bytes));
    }
    if (graph.units.size() > kMostUnits)
        text += fmt::format("  and {} more\n", grouped(graph.units.size() - kMostUnits));
    return text;
}

int run(const GraphArguments& arguments, const CommonOptions& common) {
    ClashOptions options = arguments.options;
    if (!arguments.rules.empty())
        options.rules = read_rules(arguments.rules);
    const OutOfCoreOptions out_of_core{.memory = parse_bytes("--memory", arguments.memory)};
    std::optional<OutputFiles> outputs;
    const std::filesystem::path drawing(arguments.svg);
    if (!arguments.svg.empty())
        outputs.emplace(drawing.parent_path(), std::vector{drawing.filename().string()});
    ProgressBar bar(common.progress_style());
    options.progress = bar.progress();
    GraphReport graph;
    {
        const InterruptScope scope(OnInterrupt::ask);
        graph = overlap_graph(open_store(arguments.store), options, out_of_core,
                              outputs ? kMostLines : 0, arguments.keep);
    }
    bar.finish();
    throw_if_interrupted();
    if (outputs) {
        const InterruptScope scope(OnInterrupt::defer);
        outputs->stage_text(drawing.filename(), draw(graph));
        throw_if_interrupted();
        outputs->commit();
    }
    if (common.json)
        print_json(dump(describe(graph, arguments.store)));
    else if (!common.quiet)
        print_text(table(graph, arguments.store));
    return kExitDone;
}

} // namespace

Subcommand add_graph(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<GraphArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"graph",
         kClashes,
         "The overlap graph of a store's parts, cut into work units that fit into the memory",
         {{"abut graph site.abut --clearance 50mm --memory 2G",
           "the work units of a job with two gigabytes"},
          {"abut graph site.abut --svg graph.svg", "a drawing of the graph"}},
         ""});
    app->add_option("STORE", arguments->store, "A store (abut import)")->required();
    add_length(*app, "--clearance", arguments->options.clearance,
               "Parts nearer than this have an edge (default 0)");
    app->add_flag("--self", arguments->options.self,
                  "With several models: also test the pairs within each");
    app->add_option("--rules", arguments->rules,
                    "JSON or TOML file that selects pairs (docs/selecting.md)")
        ->check(not_empty("FILE"));
    app->add_option("--memory", arguments->memory,
                    "Limit of a job's memory in bytes, with K, M or G (default 512M)")
        ->check(not_empty("BYTES"));
    app->add_flag("--keep", arguments->keep,
                  "Keep edges and units in the store, for queries in SQL");
    app->add_option("--svg", arguments->svg, "Draw the graph, with one colour for each unit")
        ->check(not_empty("FILE"));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
