#include <abut/broad_phase.h>

#include "module.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/work.h"

namespace abut::python {

namespace {

std::vector<Box3> to_boxes(const py::object& lower, const py::object& upper) {
    const auto low = to_points(lower, "lower"), high = to_points(upper, "upper");
    if (low.size() != high.size())
        throw py::value_error("there are " + std::to_string(low.size()) + " lower and " +
                              std::to_string(high.size()) + " upper corners");
    std::vector<Box3> boxes(low.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        boxes[i] = {low[i], high[i]};
    return boxes;
}

py::array index_pairs(const std::vector<IndexPair>& pairs) {
    std::vector<std::array<std::uint32_t, 2>> list;
    list.reserve(pairs.size());
    for (const IndexPair& pair : pairs)
        list.push_back({pair.a(), pair.b()});
    return rows<std::uint32_t>(std::move(list));
}

/// A filter in Python as the library calls it.
std::function<bool(std::uint32_t, std::uint32_t)> filter_of(Callback* callback) {
    if (!callback)
        return {};
    return [callback](std::uint32_t i, std::uint32_t k) {
        bool keep = false;
        callback->call(
            [&](const py::object& function) { keep = to_bool(function(i, k), "filter"); });
        return keep;
    };
}

std::unique_ptr<Callback> callback_of(const py::object& filter) {
    if (filter.is_none())
        return nullptr;
    if (!PyCallable_Check(filter.ptr()))
        throw py::type_error("filter: a function of (i, k) is wanted");
    return std::make_unique<Callback>(filter);
}

class BoxPairs {
public:
    BoxPairs(BroadPhaseMethod method, const py::object& filter)
        : filter_(callback_of(filter)),
          phase_({.method = method, .filter = filter_of(filter_.get())}) {}

    void update(const py::object& lower, const py::object& upper, const py::object& changed) {
        const auto boxes = to_boxes(lower, upper);
        const auto indices =
            changed.is_none() ? std::vector<std::uint32_t>{} : to_indices(changed, "changed");
        for (const std::uint32_t index : indices)
            if (index >= boxes.size())
                throw py::index_error("changed: there is no box " + std::to_string(index));
        const InUse::Change change(use_, "the broad phase");
        {
            const py::gil_scoped_release unlocked;
            if (changed.is_none())
                phase_.update(boxes);
            else
                phase_.update(boxes, indices);
        }
        if (filter_)
            filter_->raise();
    }
    void forget() {
        const InUse::Change change(use_, "the broad phase");
        phase_.forget();
    }
    template <class List>
    py::array list(List get) {
        const InUse::Change change(use_, "the broad phase");
        return index_pairs(get(phase_));
    }

private:
    std::unique_ptr<Callback> filter_;
    BroadPhase phase_;
    InUse use_;
};

} // namespace

void bind_broad_phase(py::module_& module) {
    bind_enum<BroadPhaseMethod>(module, "BroadPhaseMethod",
                                {"automatic", "tree", "sweep", "sweep_and_prune"},
                                "How pairs of boxes are found.");
    py::class_<BoxPairs>(module, "BroadPhase",
                         "BroadPhase(*, method='automatic', filter=None)\n\n"
                         "The overlapping pairs of boxes that move, and which begin and end. "
                         "Touching boxes overlap.\n\n"
                         "method  a BroadPhaseMethod\n"
                         "filter  function of two indices i < k that tells whether the pair is of "
                         "interest; called from any\n"
                         "        thread. What it says may change only with forget()")
        .def(py::init<BroadPhaseMethod, py::object>(), py::kw_only(),
             py::arg("method") = "automatic", py::arg("filter") = py::none())
        .def("update", &BoxPairs::update, py::arg("lower"), py::arg("upper"),
             py::arg("changed") = py::none(),
             "Takes the boxes of the next step, arrays of shape (n, 3). Only the boxes at the "
             "indices `changed` may differ\n"
             "from those before, if it is given. Raises Error (bad_argument) if a bound is not a "
             "number.")
        .def("forget", &BoxPairs::forget,
             "Finds everything anew in the next update: the filter has changed.")
        .def_property_readonly(
            "pairs",
            [](BoxPairs& self) { return self.list([](const auto& p) { return p.pairs(); }); },
            "uint32 array of shape (n, 2), sorted, the lower index first")
        .def_property_readonly(
            "begun",
            [](BoxPairs& self) { return self.list([](const auto& p) { return p.begun(); }); },
            "pairs that began with the last update")
        .def_property_readonly(
            "ended",
            [](BoxPairs& self) { return self.list([](const auto& p) { return p.ended(); }); },
            "pairs that ended with the last update");
    module.def(
        "overlapping_boxes",
        [](const py::object& lower, const py::object& upper, double gap, const py::object& filter) {
            const auto boxes = to_boxes(lower, upper);
            const auto callback = callback_of(filter);
            std::vector<IndexPair> pairs;
            {
                const py::gil_scoped_release unlocked;
                pairs = overlapping_boxes(boxes, gap, filter_of(callback.get()));
            }
            if (callback)
                callback->raise();
            return index_pairs(pairs);
        },
        py::arg("lower"), py::arg("upper"), py::kw_only(), py::arg("gap") = 0.0,
        py::arg("filter") = py::none(),
        "overlapping_boxes(lower, upper, *, gap=0, filter=None)\n\n"
        "The pairs of boxes at most `gap` apart on every axis.\n\n"
        "lower, upper  corners, arrays of shape (n, 3)\n"
        "filter        function of two indices i < k; called from any thread\n\n"
        "Returns a sorted uint32 array of shape (m, 2). Exact. Raises Error (bad_argument) if a "
        "bound is not a\n"
        "number or the gap is negative.");
}

} // namespace abut::python
