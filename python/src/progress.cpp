#include <abut/progress.h>

#include "module.h"

namespace abut::python {

void bind_progress(py::module_& module) {
    module.def(
        "set_threads", &set_threads, py::arg("count"),
        "Sets the number of threads of parallel work in this process. 0: all of the machine's.");
    module.def(
        "peak_resident_mib", &peak_resident_mib,
        "The largest resident memory of this process, or of an ended child if larger, in MiB.");
}

} // namespace abut::python
