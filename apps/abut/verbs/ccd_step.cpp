#include "verbs/ccd_step.h"

#include <abut/progress.h>

#include <filesystem>
#include <fmt/format.h>

namespace abut::command {

namespace {

void add(TestCounts& sum, const TestCounts& counts) {
    sum.vertex_face += counts.vertex_face;
    sum.edge_edge += counts.edge_edge;
}

nlohmann::ordered_json json_of_counts(const TestCounts& counts) {
    return {{"vertex_face", counts.vertex_face}, {"edge_edge", counts.edge_edge}};
}

void add_counters(nlohmann::ordered_json& json, const DeformableCounters& counters) {
    json["triangle_pairs"] = counters.triangle_pairs;
    json["candidates"] = json_of_counts(counters.candidates);
    json["elementary_tests"] = json_of_counts(counters.elementary_tests);
    json["exact_fallbacks"] = counters.exact_fallbacks;
}

nlohmann::ordered_json json_of_seconds(double refit, double detect, double total) {
    return {{"refit", refit}, {"detect", detect}, {"total", total}};
}

std::string file_name(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

/// Returns a step's name as a column, or as a line of its own if the terminal is narrower than a
/// row.
std::string step_column(const std::string& name) {
    constexpr int kRow = 124;
    const int columns = columns_of(stdout);
    return columns > 0 && columns < kRow ? name + "\n " : fmt::format("{:<44} ", name);
}

/// Formats the numbers of a row, from the impacts to the seconds.
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

CcdFrame::CcdFrame(const Deformable& surface, std::string file_name) : file(std::move(file_name)) {
    const Stopwatch watch;
    for (const EdgeFaceIntersection& each : self_intersections(surface, {.at_end = true}))
        ++(each.contact == EdgeFaceContact::crossing   ? crossing
           : each.contact == EdgeFaceContact::touching ? touching
                                                       : coplanar);
    seconds = watch.seconds();
}

nlohmann::ordered_json describe(const CcdFrame& frame) {
    return {{"frame", frame.file},
            {"crossing", frame.crossing},
            {"touching", frame.touching},
            {"coplanar", frame.coplanar},
            {"seconds", frame.seconds}};
}

nlohmann::ordered_json describe(const CcdStep& step) {
    nlohmann::ordered_json json{{"from", step.from},
                                {"to", step.to},
                                {"topology_changed", step.topology_changed},
                                {"vertices", step.vertices},
                                {"edges", step.edges},
                                {"triangles", step.triangles}};
    json.update(json_of_counts(step.impacts));
    json["first_time"] =
        step.first_time ? nlohmann::ordered_json(*step.first_time) : nlohmann::ordered_json();
    add_counters(json, step.counters);
    json["seconds"] = json_of_seconds(step.seconds_refit, step.seconds_detect, step.seconds);
    return json;
}

nlohmann::ordered_json describe(const CcdTotal& total, double seconds, std::size_t bytes) {
    nlohmann::ordered_json json{{"steps", total.steps},
                                {"topology_changes", total.topology_changes}};
    json.update(json_of_counts(total.impacts));
    add_counters(json, total.counters);
    json["seconds"] = json_of_seconds(total.seconds_refit, total.seconds_detect, seconds);
    json["peak_rss_mib"] = peak_resident_mib();
    json["bytes"] = bytes;
    return json;
}

std::string table_head() {
    return step_column("step") + fmt::format("{:>11} {:>11} {:>10} {:>13} {:>9} {:>9} {:>9}\n",
                                             "vertex-face", "edge-edge", "first time", "candidates",
                                             "refit s", "detect s", "total s");
}

std::string table_row(const CcdStep& step) {
    const std::string name = shown(file_name(step.from)) + " -> " + shown(file_name(step.to));
    if (step.topology_changed)
        return step_column(name) + fmt::format("topology changed: {} vertices, {} triangles\n",
                                               grouped(step.vertices), grouped(step.triangles));
    const std::string first_time = step.first_time ? number(*step.first_time) : "-";
    return step_column(name) + table_cells(step.impacts, first_time, step.counters,
                                           step.seconds_refit, step.seconds_detect, step.seconds);
}

std::string table_row(const CcdFrame& frame) {
    return step_column(shown(file_name(frame.file))) +
           fmt::format("at rest: {} edges cross faces, {} touch, {} coplanar\n",
                       grouped(frame.crossing), grouped(frame.touching), grouped(frame.coplanar));
}

std::string table_row(const CcdTotal& total, double seconds) {
    return step_column("total") + table_cells(total.impacts, "", total.counters,
                                              total.seconds_refit, total.seconds_detect, seconds);
}

} // namespace abut::command
