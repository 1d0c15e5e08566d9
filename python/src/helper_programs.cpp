#include <abut/helper_programs.h>

#include "models/scenes.h"
#include "module.h"

namespace abut::python {

void bind_helper_programs(py::module_& module) {
    module.def(
        "set_helper_folder", [](const py::object& folder) { set_helper_folder(to_path(folder)); },
        py::arg("folder"),
        "Tells where the helper programs lie that read some model files. The package calls it for "
        "those of the wheel.");
}

} // namespace abut::python
