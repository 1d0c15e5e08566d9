#include "ccd_step.h"

#include <abut/progress.h>

#include <filesystem>
#include <fmt/format.h>

namespace abut::command {

namespace {

void add(TestCounts& sum, const TestCounts& counts) {
    sum.vertex_face += counts.vertex_face;
    sum.edge_edge += counts.edge_edge;
}

nlohmann::ordered_json to_json(const TestCounts& counts) {
    return {{"vertex_face", counts.vertex_face}, {"edge_edge", counts.edge_edge}};
}

void add_counters(nlohmann::ordered_json& json, const DeformableCounters& counters) {
    json["triangle_pairs"] = counters.triangle_pairs;
    json["candidates"] = to_json(counters.candidates);
    json["elementary_tests"] = to_json(counters.elementary_tests);
    json["exact_fallbacks"] = counters.exact_fallbacks;
}

nlohmann::ordered_json describe_seconds(double refit, double detect, double total) {
    return {{"refit", refit}, {"detect", detect}, {"total", total}};
}

std::string file_name(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

/// Numbers of a row, impacts to seconds.
std::string table_cells(const TestCounts& impacts, const std::string& first_time,
                        const DeformableCounters& counters, double refit, double detect,
                        double total) {
    return fmt::format("{:>11} {:>11} {:>10} {:>13} {:>9.3f} {:>9.3f} {:>9.3f}\n",
                       grouped(impacts.vertex_face), grouped(impacts.edge_edge), first_time,
                       grouped(counters.candidates.vertex_face + counters.candidates.edge_edge),
                       refit, detect, total);
}

} // namespace

void CcdTotal::add(const CcdStep& step) {
    ++steps;
    topology_changes += step.topology_changed ? 1 : 0;
    command::add(impacts, step.impacts);
    counters.triangle_pairs += step.counters.triangle_pairs;
    command::add(counters.candidates, step.counters.candidates);
    command::add(counters.elementary_tests, step.counters.elementary_tests);
    counters.exact_fallbacks += step.counters.exact_fallbacks;
    seconds_refit += step.seconds_refit;
    seconds_detect += step.seconds_detect;
}

nlohmann::ordered_json describe(const CcdStep& step) {
    nlohmann::ordered_json json{{"from", step.from},
                                {"to", step.to},
                                {"topology_changed", step.topology_changed},
                                {"vertices", step.vertices},
                                {"edges", step.edges},
                                {"triangles", step.triangles}};
    json.update(to_json(step.impacts));
    json["first_time"] =
        step.first_time ? nlohmann::ordered_json(*step.first_time) : nlohmann::ordered_json();
    add_counters(json, step.counters);
    json["seconds"] = describe_seconds(step.seconds_refit, step.seconds_detect, step.seconds);
    return json;
}

nlohmann::ordered_json describe(const CcdTotal& total, double seconds, std::size_t bytes) {
    nlohmann::ordered_json json{{"steps", total.steps},
                                {"topology_changes", total.topology_changes}};
    json.update(to_json(total.impacts));
    add_counters(json, total.counters);
    json["seconds"] = describe_seconds(total.seconds_refit, total.seconds_detect, seconds);
    json["peak_rss_mb"] = peak_resident_mib();
    json["bytes"] = bytes;
    return json;
}

std::string table_head() {
    return fmt::format("{:<44} {:>11} {:>11} {:>10} {:>13} {:>9} {:>9} {:>9}\n", "step",
                       "vertex-face", "edge-edge", "first time", "candidates", "refit s",
                       "detect s", "total s");
}

std::string table_row(const CcdStep& step) {
    const std::string name = file_name(step.from) + " -> " + file_name(step.to);
    if (step.topology_changed)
        return fmt::format("{:<44} topology changed: {} vertices, {} triangles\n", name,
                           grouped(step.vertices), grouped(step.triangles));
    const std::string first_time = step.first_time ? fmt::format("{:.6f}", *step.first_time) : "-";
    return fmt::format("{:<44} ", name) + table_cells(step.impacts, first_time, step.counters,
                                                      step.seconds_refit, step.seconds_detect,
                                                      step.seconds);
}

std::string table_row(const CcdTotal& total, double seconds) {
    return fmt::format("{:<44} ", "total") + table_cells(total.impacts, "", total.counters,
                                                         total.seconds_refit, total.seconds_detect,
                                                         seconds);
}

} // namespace abut::command
