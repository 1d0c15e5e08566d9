#include <abut/store_clash.h>

#include "clash/report/clash_json.h"

namespace abut {

using nlohmann::ordered_json;

namespace {

ordered_json json_of(const OutOfCoreCounters::Worker& worker) {
    return {{"units", worker.units},
            {"pairs", worker.pairs},
            {"mesh_loads", worker.mesh_loads},
            {"bytes_read", worker.bytes_read},
            {"peak_model_bytes", worker.peak_bytes},
            {"processor_seconds", json_number(worker.processor_seconds)},
            {"waiting_seconds", json_number(worker.waiting_seconds)},
            {"peak_rss_mib", json_number(worker.peak_rss_mib)}};
}

ordered_json json_of(const OutOfCoreCounters& counters) {
    ordered_json processes = ordered_json::array();
    for (const OutOfCoreCounters::Worker& worker : counters.workers)
        processes.push_back(json_of(worker));
    return {{"units", counters.units},
            {"meshes", counters.meshes},
            {"mesh_loads", counters.mesh_loads},
            {"blocks", counters.blocks},
            {"block_loads", counters.block_loads},
            {"hierarchies_found", counters.hierarchies_found},
            {"hierarchies_kept", counters.hierarchies_kept},
            {"bytes_needed", counters.bytes_needed},
            {"bytes_read", counters.bytes_read},
            {"peak_model_bytes", counters.peak_bytes},
            {"kept", counters.kept},
            {"recalled_pairs", counters.recalled_pairs},
            {"processes", std::move(processes)}};
}

} // namespace

std::string to_json(const StoreClashReport& found) {
    JsonLines out;
    out.begin_object();
    write_report(out, found.report, found.models);
    out.member("out_of_core", json_of(found.counters));
    out.end_object();
    return out.take() + "\n";
}

} // namespace abut
