#include <abut/store_clash.h>

#include "module.h"
#include "queries/queries.h"
#include "stores/clashes.h"
#include "stores/crews.h"
#include "stores/open_store.h"

namespace abut::python {

void bind_clash_of_scenes();

namespace {

bool a_store(PyObject* first, PyObject* /*third*/) {
    return is_a<OpenStore>(first);
}

OutOfCoreOptions to_out_of_core(const Arguments& arguments, std::size_t first) {
    OutOfCoreOptions options;
    std::optional<std::uint64_t> memory;
    arguments.take(first, "memory", memory);
    options.memory = memory.value_or(options.memory);
    arguments.take(first + 1, "order", options.order);
    arguments.take(first + 2, "keep", options.keep);
    arguments.take(first + 3, "keep_hierarchies", options.keep_hierarchies);
    if (arguments.has(first + 4))
        options.crew = get<OpenCrew>(arguments[first + 4], "crew").get();
    return options;
}

py::object run_find_in_store(const Arguments& arguments) {
    const Store store = get<OpenStore>(arguments[0], "store").get();
    ClashOptions options = to_clash_options(arguments, 1);
    const OutOfCoreOptions out_of_core = to_out_of_core(arguments, 6);
    take_selection(arguments, 11, options);
    Work work(arguments[5]);
    auto found = work.run([&](const Progress& progress) {
        options.progress = progress;
        return find_clashes(store, options, out_of_core);
    });
    return py::cast(Report{std::move(found.report),
                           std::make_shared<const std::vector<Scene>>(std::move(found.models)),
                           std::move(found.counters), found.question, found.job});
}

py::object run_overlap_graph(const Arguments& arguments) {
    const Store store = get<OpenStore>(arguments[0], "store").get();
    ClashOptions options = to_clash_options(arguments, 1);
    OutOfCoreOptions out_of_core;
    std::optional<std::uint64_t> memory, lines;
    arguments.take(6, "memory", memory);
    out_of_core.memory = memory.value_or(out_of_core.memory);
    arguments.take(7, "lines", lines);
    bool keep = false;
    arguments.take(8, "keep", keep);
    Work work(arguments[5]);
    return py::cast(work.run([&](const Progress& progress) {
        options.progress = progress;
        return overlap_graph(store, options, out_of_core, lines.value_or(0), keep);
    }));
}

void bind_job_counters(py::module_& module) {
    PlainBinder<OutOfCoreCounters::Worker>(module, "WorkerCounters", "The work of one process.")
        .field("units", &OutOfCoreCounters::Worker::units, "work units")
        .field("pairs", &OutOfCoreCounters::Worker::pairs, "of parts")
        .field("mesh_loads", &OutOfCoreCounters::Worker::mesh_loads,
               "each time that a mesh was read")
        .field("blocks", &OutOfCoreCounters::Worker::blocks, "mesh blocks that were needed")
        .field("block_loads", &OutOfCoreCounters::Worker::block_loads,
               "each time that one was read")
        .field("block_bytes_needed", &OutOfCoreCounters::Worker::block_bytes_needed,
               "of those blocks, each once")
        .field("hierarchies_found", &OutOfCoreCounters::Worker::hierarchies_found, "in the store")
        .field("bytes_read", &OutOfCoreCounters::Worker::bytes_read, "from the store")
        .field("peak_bytes", &OutOfCoreCounters::Worker::peak_bytes, "of models in memory at once")
        .field("processor_seconds", &OutOfCoreCounters::Worker::processor_seconds, "of all threads")
        .field("waiting_seconds", &OutOfCoreCounters::Worker::waiting_seconds, "without work")
        .field("peak_rss_mib", &OutOfCoreCounters::Worker::peak_rss_mib, "MiB")
        .done();
    PlainBinder<OutOfCoreCounters>(module, "OutOfCoreCounters", "The work of a job on a store.")
        .field("units", &OutOfCoreCounters::units, "work units")
        .field("meshes", &OutOfCoreCounters::meshes, "that a candidate needs, large ones left out")
        .field("mesh_loads", &OutOfCoreCounters::mesh_loads, "each time that one was read")
        .field("blocks", &OutOfCoreCounters::blocks, "mesh blocks that were needed")
        .field("block_loads", &OutOfCoreCounters::block_loads, "each time that one was read")
        .field("bytes_needed", &OutOfCoreCounters::bytes_needed, "")
        .field("bytes_read", &OutOfCoreCounters::bytes_read, "")
        .field("hierarchies_found", &OutOfCoreCounters::hierarchies_found, "in the store")
        .field("hierarchies_kept", &OutOfCoreCounters::hierarchies_kept, "in the store")
        .field("peak_bytes", &OutOfCoreCounters::peak_bytes, "of models in memory at once")
        .field("kept", &OutOfCoreCounters::kept, "in the store")
        .field("recalled_pairs", &OutOfCoreCounters::recalled_pairs,
               "done before, by an earlier job")
        .field("workers", &OutOfCoreCounters::workers,
               "list of WorkerCounters, in the order of ranks")
        .done();
}

void bind_graph_report(py::module_& module) {
    PlainBinder<GraphReport::Unit>(module, "WorkUnit",
                                   "Parts that a job on a store works on together.")
        .field("parts", &GraphReport::Unit::parts, "")
        .field("edges", &GraphReport::Unit::edges, "")
        .field("meshes", &GraphReport::Unit::meshes,
               "in memory together; large ones are not counted")
        .field("bytes", &GraphReport::Unit::bytes, "of these meshes")
        .field("bounds", &GraphReport::Unit::bounds, "Box3 of the centres of the parts' boxes")
        .field("middle", &GraphReport::Unit::middle, "mean of these centres")
        .done();
    PlainBinder<GraphReport>(module, "GraphReport", "Returned by overlap_graph.")
        .field("nodes", &GraphReport::nodes, "parts")
        .field("edges", &GraphReport::edges, "pairs of parts whose boxes are near")
        .field("components", &GraphReport::components, "")
        .field("isolated", &GraphReport::isolated, "parts without an edge")
        .field("largest_component", &GraphReport::largest_component, "")
        .field("highest_valence", &GraphReport::highest_valence, "")
        .field("mean_valence", &GraphReport::mean_valence, "")
        .field("bytes", &GraphReport::bytes, "of the models that an edge needs, each once")
        .field("large_meshes", &GraphReport::large_meshes, "")
        .field("large_bytes", &GraphReport::large_bytes, "")
        .field("units", &GraphReport::units, "list of WorkUnit, in the order of work")
        .field("cut_edges", &GraphReport::cut_edges, "between parts that a partition put apart")
        .property(
            "lines",
            [](const GraphReport& self) {
                std::vector<std::array<Vec3, 2>> lines;
                for (const GraphReport::Line& line : self.lines)
                    lines.push_back({line.a, line.b});
                const auto size = static_cast<py::ssize_t>(lines.size());
                return own(std::move(lines), py::dtype::of<double>(), {size, 2, 3});
            },
            "array of shape (n, 2, 3): ends of some of the edges")
        .field("seconds", &GraphReport::seconds, "")
        .done();
}

} // namespace

void bind_store_clash(py::module_& module) {
    bind_enum<WorkOrder>(module, "WorkOrder", {"partition", "random"},
                         "How the work on a store is put into an order.");
    bind_job_counters(module);
    bind_graph_report(module);
    add_overload("find_clashes",
                 {a_store,
                  {"store * clearance touch_tolerance self rules progress memory "
                   "order keep keep_hierarchies crew only a b matrix leave_out sort",
                   1},
                  run_find_in_store});
    bind_clash_of_scenes();
    add_verb(
        module, "overlap_graph",
        "overlap_graph(store, *, clearance=0, touch_tolerance=None, self=False, rules=[], "
        "progress=None,\n"
        "              memory=512 MiB, lines=0, keep=False)\n--\n\n"
        "The graph of a store's parts: an edge where boxes are at most the clearance apart.\n\n"
        "lines  of about how many edges the ends are wanted\n"
        "keep   whether edges and work units are kept in the store for SQL\n"
        "Others as find_clashes. Returns a GraphReport.");
    add_overload("overlap_graph",
                 {a_store,
                  {"store * clearance touch_tolerance self rules progress memory lines keep", 1},
                  run_overlap_graph});
}

} // namespace abut::python
