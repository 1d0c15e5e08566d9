#include <abut/clash.h>
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "measure.h"
#include "scenes/plant/plant.h"
#include "scratch_folder.h"
#include "suite.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct MassiveSuiteOptions {
    std::vector<std::uint64_t> plants = {2'000'000}; ///< triangles of each, instances counted
    std::uint64_t ground = 2'000'000; ///< triangles of a large mesh with small parts on it; 0: none
    std::uint64_t sheet = 2'000'000;  ///< triangles of one mesh; 0: none
    std::uint64_t memory = std::uint64_t{512} << 20; ///< of the import
    std::vector<std::uint64_t> clash_memory = {std::uint64_t{512} << 20, std::uint64_t{64} << 20};
    int rounds = 3;
};

/// Writes a wavy sheet as binary STL. Each triangle has three vertices of its own, which the import
/// must join.
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

/// Compares the clash job on a store with the job in core. Import and reading are not measured. The
/// units run in order and at random, which shows what the partition saves.
void add_clash_rows(const std::string& name, const std::string& store, const std::string& model,
                    const std::vector<double>& clearances, const MassiveSuiteOptions& options,
                    Report& report) {
    const Store opened = open_store(store);
    const std::vector<Scene> models{read_scene(model)};
    for (const double clearance : clearances)
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
                row.counters["blocks of large meshes"] = static_cast<double>(work.blocks);
                row.counters["block loads"] = static_cast<double>(work.block_loads);
                row.counters["bytes read for one needed"] =
                    static_cast<double>(work.bytes_read) /
                    std::max(1.0, static_cast<double>(work.bytes_needed));
                row.counters["peak of models, MiB"] = static_cast<double>(work.peak_bytes >> 20);
                report.rows.push_back(row);
            }
}

/// Measures what stored hierarchies cost the job that builds them, and what they save a job with
/// another question. Only one of two copies of the store keeps them; the jobs leave nothing else
/// that a later one uses.
void add_hierarchy_rows(const std::string& name, const ScratchFolder& folder,
                        const std::string& store, double clearance,
                        const MassiveSuiteOptions& options, Report& report) {
    const std::string with = folder / "with.abut", without = folder / "without.abut";
    const OutOfCoreOptions keeping{.memory = options.clash_memory.front()};
    OutOfCoreOptions leaving = keeping, reading = keeping;
    leaving.keep_hierarchies = false;
    reading.keep = false;
    ClashOptions question;
    question.clearance = clearance;
    const auto first_job = [&](const std::string& copy, const OutOfCoreOptions& how) {
        std::filesystem::copy_file(store, copy, std::filesystem::copy_options::overwrite_existing);
        return find_clashes(open_store(copy), question, how).counters;
    };
    OutOfCoreCounters first, second;
    Row row{name + ", first job, hierarchies kept", 0, "not kept", 0, "s", 1, {}};
    Turns turns = take_turns(
        options.rounds, [&] { first = first_job(with, keeping); },
        [&] { (void)first_job(without, leaving); });
    row.ours = turns.ours;
    row.theirs = turns.theirs;
    row.counters["hierarchies kept"] = static_cast<double>(first.hierarchies_kept);
    const StoreSummary kept = summary(open_store(with));
    row.counters["bytes of hierarchies"] = static_cast<double>(kept.hierarchy_bytes);
    row.counters["bytes of blocks"] = static_cast<double>(kept.stored_bytes);
    row.counters["bytes of the store"] = static_cast<double>(kept.file_bytes);
    report.rows.push_back(row);

    const Store opened_with = open_store(with), opened_without = open_store(without);
    row = {name + ", second job, hierarchies read", 0, "built", 0, "s", 1, {}};
    turns = take_turns(
        options.rounds, [&] { second = find_clashes(opened_with, question, reading).counters; },
        [&] { (void)find_clashes(opened_without, question, reading); });
    row.ours = turns.ours;
    row.theirs = turns.theirs;
    row.counters["loads"] = static_cast<double>(second.mesh_loads + second.block_loads);
    row.counters["hierarchies found"] = static_cast<double>(second.hierarchies_found);
    row.counters["bytes read for one of the store"] =
        static_cast<double>(second.bytes_read) / static_cast<double>(kept.file_bytes);
    report.rows.push_back(row);
}

/// A large sheet, with small parts all over it. Each part needs only a little of the sheet. No two
/// parts have the same mesh.
Scene sheet_and_parts(std::uint64_t triangles, int parts) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2));
    const double size = 0.01 * side;
    const auto height = [](double x, double z) {
        return 0.3 * std::sin(1.3 * x) * std::cos(1.7 * z);
    };
    Scene scene;
    Mesh& sheet = scene.meshes.emplace_back();
    for (std::uint32_t i = 0; i <= side; ++i)
        for (std::uint32_t k = 0; k <= side; ++k)
            sheet.positions.push_back({0.01 * i, height(0.01 * i, 0.01 * k), 0.01 * k});
    for (std::uint32_t i = 0; i < side; ++i)
        for (std::uint32_t k = 0; k < side; ++k) {
            const std::uint32_t at = i * (side + 1) + k, next = at + side + 1;
            sheet.triangles.push_back({at, at + 1, next});
            sheet.triangles.push_back({next, at + 1, next + 1});
        }
    scene.parts.push_back({"sheet", "", "", 0, {}});
    for (int i = 0; i < parts; ++i) {
        // Multiples of the inverse plastic number and of its square (the R2 sequence) spread the
        // parts evenly, and neighbours in the list do not lie next to each other.
        const double x = std::fmod(0.7548776662466927 * (i + 1), 1) * (size - 1) + 0.5,
                     z = std::fmod(0.5698402909980532 * (i + 1), 1) * (size - 1) + 0.5;
        Mesh ball;
        constexpr int kRings = 24;
        for (int r = 0; r <= kRings; ++r)
            for (int k = 0; k < kRings; ++k) {
                const double a = 2 * 3.141592653589793 * k / kRings,
                             b = 3.141592653589793 * (static_cast<double>(r) / kRings - 0.5);
                ball.positions.push_back({(0.05 + 1e-7 * i) * std::cos(b) * std::cos(a),
                                          0.05 * std::sin(b), 0.05 * std::cos(b) * std::sin(a)});
            }
        for (std::uint32_t r = 0; r < kRings; ++r)
            for (std::uint32_t k = 0; k < kRings; ++k) {
                const std::uint32_t next = (k + 1) % kRings, at = r * kRings;
                ball.triangles.push_back({at + k, at + kRings + k, at + kRings + next});
                ball.triangles.push_back({at + k, at + kRings + next, at + next});
            }
        scene.meshes.push_back(std::move(ball));
        Transform world;
        world.m[9] = x, world.m[10] = height(x, z) + (i % 50 == 0 ? 0.03 : 0.07), world.m[11] = z;
        scene.parts.push_back({fmt::format("part{}", i), "", "",
                               static_cast<std::uint32_t>(scene.meshes.size() - 1), world});
    }
    return scene;
}

/// Measures imports into a store against `read_scene` of the same files, which keeps all in memory,
/// and clash jobs on the store against the job in core.
///
/// Errors      as import_models.
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
        add_clash_rows(name, folder / "store.abut", model, {0.005, 1.0}, options, report);
        for (const double clearance : {0.005, 0.2})
            add_hierarchy_rows(fmt::format("{}, clash {} m", name, clearance), folder,
                               folder / "store.abut", clearance, options, report);
    }
    if (options.ground > 0) {
        const std::string model = folder / "ground.glb";
        write_glb(sheet_and_parts(options.ground, 5000), model);
        const std::string name = fmt::format("sheet of {} and 5000 parts", options.ground);
        report.rows.push_back(import_row("import, " + name, folder, model, options));
        add_clash_rows(name, folder / "store.abut", model, {0.005}, options, report);
        add_hierarchy_rows(name, folder, folder / "store.abut", 0.005, options, report);
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

const Suite kMassiveSuite(
    "massive",
    "Models beyond the memory: import into a store and its clashes, against the same in core",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<MassiveSuiteOptions>();
        suite.add_option("--plants", options->plants, "Triangles of each plant");
        suite.add_option("--ground", options->ground,
                         "Triangles of the large mesh that small parts lie on; 0: none");
        suite.add_option("--sheet", options->sheet, "Triangles of the one large mesh; 0: none");
        suite.add_option("--memory", options->memory, "Bytes that the import keeps to");
        suite.add_option("--clash-memory", options->clash_memory,
                         "Bytes that the clash job keeps to, each in turn");
        add_rounds(suite, options->rounds);
        return [options] { return run_massive_suite(*options); };
    });

} // namespace

} // namespace abut::bench
