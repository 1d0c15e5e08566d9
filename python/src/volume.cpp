#include <abut/volume.h>

#include "module.h"
#include "support/enums.h"

namespace abut::python {

void bind_volume(py::module_& module) {
    std::vector<std::string> names;
    names.reserve(kVolumes.size());
    for (const Volume volume : kVolumes)
        names.emplace_back(to_string(volume));
    bind_enum<Volume>(module, "Volume", names,
                      "The bounding volume that a model's hierarchy is made of.");
    module.def("common_volume", &common_volume, py::arg("a"), py::arg("b"),
               "The Volume that a query of two models of these kinds tests: their own if it is the "
               "same,\nssv for different swept spheres (sphere, pss, lss, rss, ssv), and else the "
               "boxes that every\nmodel has, automatic.");
}

} // namespace abut::python
