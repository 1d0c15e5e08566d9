#include <abut/clash.h>
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "measure.h"
#include "scenes/plant.h"
#include "scratch_folder.h"
#include "suites.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace abut::bench {

namespace {

/// A wavy sheet as binary STL: every triangle with three vertices of its own, to be joined.
void write_sheet(const std::string& path, std::uint64_t triangles) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2));
    const auto at = [](std::uint32_t i, std::uint32_t k) {
        const double x = 0.01 * i, y = 0.01 * k;
        return std::array<float, 3>{
            static_cast<float>(x), static_cast<float>(y),
            static_cast<float>(0.3 * std::sin(1.3 * x) * std::cos(1.7 * y))};
    };
    std::ofstream file(path, std::ios::binary);
    file << std::string(80, ' ');
    const std::uint32_t count = 2 * side * side;
    file.write(reinterpret_cast<const char*>(&count), sizeof count);
    for (std::uint32_t i = 0; i < side; ++i)
        for (std::uint32_t k = 0; k < side; ++k)
            for (const bool upper : {false, true}) {
                const std::array corners{upper ? at(i + 1, k + 1) : at(i, k), at(i + 1, k),
                                         at(i, k + 1)};
                char record[50] = {};
                std::memcpy(record + 12, corners.data(), sizeof corners);
                file.write(record, sizeof record);
            }
    if (!file.flush())
        throw Error(ErrorCode::cannot_write, path, "cannot be written");
}

Row import_row(const std::string& name, const ScratchFolder& folder, const std::string& model,
               const MassiveSuiteOptions& options) {
    Row row{name, 0, "read_scene", 0, "s", 1, {}};
    const std::string store = folder / "store.abut";
    const auto import = [&] {
        std::filesystem::remove(store);
        (void)import_models({model}, store, {.memory = options.memory});
    };
    const Turns turns = take_turns(options.rounds, import, [&] { (void)read_scene(model); });
    row.ours = turns.ours;
    row.theirs = turns.theirs;
    const StoreSummary found = summary(open_store(store));
    const auto bytes = static_cast<double>(std::filesystem::file_size(model));
    row.counters["file, MB"] = bytes / 1e6;
    row.counters["MB/s"] = bytes / 1e6 / turns.ours;
    row.counters["parts"] = static_cast<double>(found.parts);
    row.counters["triangles"] = static_cast<double>(found.triangles);
    row.counters["stored triangles"] = static_cast<double>(found.stored_triangles);
    row.counters["geometry, bytes a stored triangle"] =
        static_cast<double>(found.stored_bytes) / static_cast<double>(found.stored_triangles);
    row.counters["store, bytes a triangle"] =
        static_cast<double>(found.file_bytes) / static_cast<double>(found.triangles);
    const double start = wall_seconds();
    (void)import_models({model}, store, {.memory = options.memory});
    row.counters["again, unchanged, ms"] = 1e3 * (wall_seconds() - start);
    const double before = wall_seconds();
    verify(open_store(store));
    row.counters["verify, s"] = wall_seconds() - before;
    return row;
}

/// The clash job of a store against the one in core, import and reading left out. In order and at
/// random: what the partition saves.
void add_clash_rows(const std::string& name, const std::string& store, const std::string& model,
                    const MassiveSuiteOptions& options, Report& report) {
    const Store opened = open_store(store);
    const std::vector<Scene> models{read_scene(model)};
    for (const double clearance : {0.005, 1.0})
        for (const std::uint64_t memory : options.clash_memory)
            for (const WorkOrder order : {WorkOrder::partition, WorkOrder::random}) {
                ClashOptions clash;
                clash.clearance = clearance;
                StoreClashReport found;
                ClashReport truth;
                const bool in_order = order == WorkOrder::partition;
                Row row{fmt::format("{}, clash {} m, {} MiB, {}", name, clearance, memory >> 20,
                                    in_order ? "partition" : "random order"),
                        0,
                        in_order ? "in core" : "",
                        0,
                        "s",
                        1,
                        {}};
                const auto in_core = [&] { truth = find_clashes(models, clash); };
                const Turns turns = take_turns(
                    options.rounds,
                    [&] {
                        found = find_clashes(opened, clash,
                                             {.memory = memory, .order = order, .keep = false});
                    },
                    in_order ? in_core : std::function<void()>());
                row.ours = turns.ours;
                row.theirs = turns.theirs;
                const OutOfCoreCounters& work = found.counters;
                row.counters["candidates"] = static_cast<double>(found.report.candidates);
                row.counters["clashes"] = static_cast<double>(found.report.clashes.size());
                if (in_order)
                    row.counters["clashes in core"] = static_cast<double>(truth.clashes.size());
                row.counters["units"] = static_cast<double>(work.units);
                row.counters["meshes"] = static_cast<double>(work.meshes);
                row.counters["mesh loads"] = static_cast<double>(work.mesh_loads);
                row.counters["bytes read for one needed"] =
                    static_cast<double>(work.bytes_read) /
                    std::max(1.0, static_cast<double>(work.bytes_needed));
                row.counters["peak of models, MiB"] = static_cast<double>(work.peak_bytes >> 20);
                report.rows.push_back(row);
            }
}

} // namespace

Report run_massive_suite(const MassiveSuiteOptions& options) {
    Report report{"massive", {}, {}};
    const ScratchFolder folder;
    for (const std::uint64_t triangles : options.plants) {
        const std::string model = folder / "plant.glb";
        write_glb(make_plant({.triangles = triangles}).scene, model);
        report.rows.push_back(
            import_row(fmt::format("import, plant of {}", triangles), folder, model, options));
        write_glb(make_plant({.triangles = triangles, .distinct = true}).scene, model);
        const std::string name = fmt::format("plant of {}, nothing shared", triangles);
        report.rows.push_back(import_row("import, " + name, folder, model, options));
        add_clash_rows(name, folder / "store.abut", model, options, report);
    }
    if (options.sheet > 0) {
        const std::string model = folder / "sheet.stl";
        write_sheet(model, options.sheet);
        report.rows.push_back(import_row(fmt::format("import, one mesh of {} (STL)", options.sheet),
                                         folder, model, options));
    }
    report.notes.push_back(fmt::format(
        "wall time; import writes a store and keeps to {} MiB, read_scene ends with all in memory",
        options.memory >> 20));
    return report;
}

} // namespace abut::bench
