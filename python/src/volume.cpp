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
}

} // namespace abut::python
