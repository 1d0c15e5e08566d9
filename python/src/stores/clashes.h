#pragma once

#include <abut/clash.h>
#include <abut/store_clash.h>

#include "support/arguments.h"

#include <memory>
#include <optional>
#include <vector>

namespace abut::python {

/// A report with the models that it names, without their meshes.
struct Report {
    ClashReport report;
    std::shared_ptr<const std::vector<Scene>> models;
    std::optional<OutOfCoreCounters> counters; ///< of a store's job
    std::int64_t question = 0, job = 0;        ///< as StoreClashReport has them
};

/// A clash with the names of its parts.
struct NamedClash : Clash {
    std::array<std::string, 2> ids, names, types, files;
};

/// In: arguments `first` to `first` + 3: clearance, touch_tolerance, self, rules.
ClashOptions to_clash_options(const Arguments& arguments, std::size_t first);
/// In: arguments `first` to `first` + 5: only, a, b, matrix, leave_out, sort.
void take_selection(const Arguments& arguments, std::size_t first, ClashOptions& options);
void bind_rules(py::module_& module);
std::vector<NamedClash> named_clashes(const Report& report);

} // namespace abut::python
