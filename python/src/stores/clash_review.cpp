#include <abut/clash_review.h>

#include "module.h"
#include "stores/open_store.h"
#include "support/records.h"

namespace abut::python {

namespace {

std::vector<std::uint64_t> to_clash_ids(const std::vector<std::string>& texts) {
    std::vector<std::uint64_t> ids;
    for (const std::string& text : texts) {
        const auto id = parse_clash_id(text);
        if (!id)
            throw py::value_error("'" + text + "' is no id of a clash");
        ids.push_back(*id);
    }
    return ids;
}

/// The keyword arguments of find_clashes that ask the question of the last job again.
py::dict last_options(const OpenStore& store) {
    const ClashOptions options = last_clash_options(store.get());
    py::dict result;
    result["clearance"] = options.clearance;
    result["touch_tolerance"] = options.touch_tolerance;
    result["self"] = options.self;
    result["rules"] = options.rules;
    result["only"] = options.only;
    result["a"] = options.a;
    result["b"] = options.b;
    result["matrix"] = options.matrix;
    result["leave_out"] = options.leave_out;
    return result;
}

} // namespace

void bind_clash_review(py::module_& module) {
    const auto statuses = [](const ClashReview& self) {
        py::dict counts;
        for (const ClashStatus status : kClashStatuses)
            counts[to_string(status)] = self.statuses[static_cast<std::size_t>(status)];
        return counts;
    };
    PlainBinder<ClashReview>(module, "ClashReview",
                             "The clashes of one question, as its last job left them.")
        .field("clearance", &ClashReview::clearance, "metres")
        .field("touch_tolerance", &ClashReview::touch_tolerance,
               "metres; None: what the files tell apart")
        .field("self", &ClashReview::self, "")
        .field("rules", &ClashReview::rules, "how many")
        .field("finished", &ClashReview::finished, "when the job ended, in seconds since 1970")
        .property("statuses", statuses, "dict of status to number")
        .field("clashes", &ClashReview::clashes, "list of ListedClash, resolved ones too")
        .done();
    module.def(
        "to_json", [](const ClashReview& review) { return to_json(review); }, py::arg("review"));
    module.def(
        "to_json",
        [](const std::vector<ClashReview>& reviews, const std::string& store) {
            return to_json(reviews, store);
        },
        py::arg("reviews"), py::arg("store"));
    using Ids = std::vector<std::string>;
    module.def(
        "review_clashes", [](const OpenStore& store) { return review_clashes(store.get()); },
        py::arg("store"),
        "One ClashReview for each question that the store has been asked. Raises Error "
        "(malformed).");
    module.def("last_clash_options", &last_options, py::arg("store"),
               "The options of the last job that finished, as keyword arguments of find_clashes.\n"
               "Raises Error: bad_argument if there is none, or if the store did not keep its "
               "rules.");
    module.def(
        "mark_clashes",
        [](const OpenStore& store, const Ids& reviewed, const Ids& approved, const Ids& cleared,
           std::string note) {
            mark_clashes(store.get(), {to_clash_ids(reviewed), to_clash_ids(approved),
                                       to_clash_ids(cleared), std::move(note)});
        },
        py::arg("store"), py::kw_only(), py::arg("reviewed") = Ids{}, py::arg("approved") = Ids{},
        py::arg("cleared") = Ids{}, py::arg("note") = "",
        "Marks clashes by their ids, all of them or, after an error, none. The store is opened "
        "with read_only=False.\n\n"
        "Raises Error: bad_argument, naming the clash, cannot_write.");
    module.def(
        "forget_resolved_clashes",
        [](const OpenStore& store) { return forget_resolved_clashes(store.get()); },
        py::arg("store"), "Removes resolved clashes and their marks. Returns how many.");
    module.def(
        "verify_jobs", [](const OpenStore& store) { verify_jobs(store.get()); }, py::arg("store"),
        "Checks what the store keeps of jobs and clashes. Raises Error (malformed).");
}

} // namespace abut::python
