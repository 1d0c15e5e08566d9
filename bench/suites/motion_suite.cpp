#include <abut/assembly.h>
#include <abut/broad_phase.h>
#include <abut/rigid.h>

#include "measure.h"
#include "placement.h"
#include "scenes/engine.h"
#include "scratch_folder.h"
#include "suite.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <vector>

namespace abut::bench {

namespace {

struct MotionSuiteOptions {
    std::vector<int> cylinders{4, 99};
    int rounds = 3;
    std::size_t samples = 1000;
};

Assembly make_assembly(int cylinders, const ScratchFolder& folder) {
    const scenes::Engine engine = scenes::make_engine({.cylinders = cylinders}, "engine.glb");
    write_glb(engine.scene, folder / "engine.glb");
    const std::string file = folder / "engine.toml";
    std::ofstream(file) << engine.assembly;
    return read_assembly(file);
}

/// The box of the placed corners.
Box3 moved_box(const Box3& box, const Transform& place) {
    Box3 moved;
    for (int corner = 0; corner < 8; ++corner)
        extend(moved, placed(place, {(corner & 1) != 0 ? box.upper.x : box.lower.x,
                                     (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                     (corner & 4) != 0 ? box.upper.z : box.lower.z}));
    return moved;
}

/// The usual way: poses at many times, boxes, and `collide` for the pairs whose boxes overlap. It
/// misses what happens in between, and finds no depth. Returns the number of pairs that meet.
std::size_t sample_contacts(const Assembly& assembly, std::size_t samples) {
    const auto [start, end] = time_range(assembly);
    std::vector<Box3> boxes;
    for (const AssemblyPart& part : assembly.parts)
        boxes.push_back(box_of(part.model.mesh(), {}));
    const auto is_joined = [&](std::uint32_t a, std::uint32_t b) {
        const auto& parts = assembly.parts;
        return parts[a].on == b || parts[b].on == a || (!parts[a].on && !parts[b].on) ||
               std::ranges::any_of(assembly.loops, [&](const AssemblyLoop& loop) {
                   return std::minmax(loop.coupler, loop.closer) == std::minmax(a, b);
               });
    };
    std::vector<IndexPair> met;
    for (std::size_t i = 0; i < samples; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(samples - 1);
        const std::vector<Transform> places =
            part_transforms(assembly, start + share * (end - start));
        std::vector<Box3> now;
        for (std::size_t p = 0; p < places.size(); ++p)
            now.push_back(moved_box(boxes[p], places[p]));
        for (const IndexPair& pair : overlapping_boxes(now))
            if (!is_joined(pair.a(), pair.b()) &&
                collide(assembly.parts[pair.a()].model, places[pair.a()],
                        assembly.parts[pair.b()].model, places[pair.b()])
                    .meet())
                met.push_back(pair);
    }
    std::ranges::sort(met, {}, &IndexPair::key);
    const auto last = std::unique(met.begin(), met.end());
    return static_cast<std::size_t>(last - met.begin());
}

/// Returns the median time that all threads compute.
template <typename Work>
double processor_time(int rounds, const Work& work) {
    std::vector<double> times;
    for (int i = 0; i < rounds; ++i) {
        const double before = process_seconds();
        work();
        times.push_back(process_seconds() - before);
    }
    return median(times);
}

Report run_motion_suite(const MotionSuiteOptions& options) {
    Report report;
    report.suite = "motion";
    report.notes.push_back(
        fmt::format("Seconds of processor time; the peer samples {} times", options.samples));
    for (const int cylinders : options.cylinders) {
        const ScratchFolder folder;
        const Assembly assembly = make_assembly(cylinders, folder);
        for (const double clearance : {0.0, 0.006}) {
            MotionReport found;
            Row row{fmt::format("engine of {} parts, {}", assembly.parts.size(),
                                clearance > 0 ? "contacts and gaps below 6 mm" : "contacts"),
                    0,
                    {},
                    {},
                    "s",
                    1,
                    {}};
            row.ours = processor_time(options.rounds, [&] {
                found = find_motion_clashes(assembly, {.clearance = clearance});
            });
            row.counters["pairs"] = static_cast<double>(found.pairs);
            row.counters["measured pairs"] = static_cast<double>(found.near);
            row.counters["measurements"] = static_cast<double>(found.steps);
            row.counters["clashes"] = static_cast<double>(found.clashes.size());
            if (clearance == 0) {
                std::size_t met = 0;
                row.peer = "samples, collide";
                row.theirs = processor_time(
                    options.rounds, [&] { met = sample_contacts(assembly, options.samples); });
                row.counters["pairs that the samples find"] = static_cast<double>(met);
            }
            report.rows.push_back(row);
        }
    }
    return report;
}

const Suite kMotionSuite("motion", "Clashes over time of engines in motion, beside sampling",
                         [](CLI::App& suite) -> RunSuite {
                             const auto options = std::make_shared<MotionSuiteOptions>();
                             suite.add_option("--cylinders", options->cylinders,
                                              "Numbers of cylinders; two parts each");
                             suite.add_option("--samples", options->samples, "Of the peer");
                             add_rounds(suite, options->rounds);
                             return [options] { return run_motion_suite(*options); };
                         });

} // namespace

} // namespace abut::bench
