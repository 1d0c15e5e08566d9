#include <abut/levels.h>

#include "models/scenes.h"
#include "module.h"
#include "stores/open_store.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

void bind_levels(py::module_& module) {
    PlainBinder<LevelReport>(module, "LevelReport", "Returned by build_levels.")
        .field("built", &LevelReport::built, "False: the levels were there and are current")
        .field("chunks", &LevelReport::chunks, "")
        .field("new_chunks", &LevelReport::new_chunks, "made now; others were kept")
        .field("triangles", &LevelReport::triangles, "of all chunks")
        .field("stored_bytes", &LevelReport::stored_bytes, "")
        .field("geometry_bytes", &LevelReport::geometry_bytes, "stored bytes of the meshes")
        .field("seconds", &LevelReport::seconds, "")
        .done();
    module.def(
        "build_levels",
        [](const py::object& store, std::uint64_t memory, const py::object& report) {
            const auto path = to_path(store);
            Work work(report);
            return work.run([&](const Progress& progress) {
                return build_levels(path, {.memory = memory, .progress = progress});
            });
        },
        py::arg("store"), py::kw_only(), py::arg("memory") = std::uint64_t{512} << 20,
        py::arg("progress") = py::none(),
        "Builds the levels of detail of a store, a path, if they are missing or outdated. Work "
        "that\n"
        "was interrupted is continued.\n\n"
        "memory  bytes that the work may use, at least 64 MiB\n\n"
        "Returns a LevelReport. Raises Error: bad_argument, cannot_write, those of open_store;\n"
        "KeyboardInterrupt at Ctrl-C.");
    module.def(
        "has_levels", [](const OpenStore& store) { return has_levels(store.get()); },
        py::arg("store"), "Whether a Store has levels for all its parts as they are now.");
}

} // namespace abut::python
