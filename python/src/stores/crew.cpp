#include <abut/crew.h>
#include <abut/store_clash.h>

#include "models/scenes.h"
#include "module.h"
#include "stores/crews.h"
#include "support/work.h"

namespace abut::python {

void bind_crew(py::module_& module) {
    py::class_<OpenCrew>(module, "Crew",
                         "Processes that do one job together, made by join_crew. Rank 0 is the "
                         "leader. A context manager: leaving\n"
                         "it leaves the crew, which waits until the processes that it exchanges "
                         "messages with have left too.")
        .def_property_readonly("rank", [](const OpenCrew& self) { return self.get()->rank(); })
        .def_property_readonly("size", [](const OpenCrew& self) { return self.get()->size(); })
        .def_property_readonly(
            "threads", [](const OpenCrew& self) { return self.get()->threads(); },
            "number of threads for this process; set_threads takes it")
        .def("leave", &OpenCrew::leave, "Leaves the crew.")
        .def("__enter__", [](const py::object& self) { return self; })
        .def("__exit__", [](OpenCrew& self, const py::args& /*error*/) { self.leave(); });
    module.def(
        "join_crew",
        []() -> py::object {
            auto crew = join_crew();
            return crew ? py::cast(OpenCrew(std::move(crew))) : py::none();
        },
        "The Crew in which `mpirun` started this process; None if it was started alone.\n\n"
        "Raises Error (unsupported) if this build has no MPI, or another one than the one that "
        "started the process.");
    module.def("is_helper", &is_helper,
               "Whether this process was started as one of several and is not the first of them.");
    module.def(
        "help_find_clashes",
        [](const py::object& store, const OpenCrew& crew, const py::object& report) {
            const auto path = to_path(store);
            Crew& processes = *crew.get();
            Work work(report);
            work.run(
                [&](const Progress& progress) { help_find_clashes(path, processes, progress); });
        },
        py::arg("store"), py::arg("crew"), py::kw_only(), py::arg("progress") = py::none(),
        "Takes part in the job of the leader, which calls find_clashes(store, crew=crew). Returns "
        "when the leader has\n"
        "left the crew.\n\nstore  path of the leader's store, or of a copy of it");
}

} // namespace abut::python
