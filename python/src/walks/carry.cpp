#include <abut/carry.h>

#include "module.h"
#include "walks/open_walk.h"

namespace abut::python {

namespace {

/// A part in the hand, which keeps the walk.
class Hand {
public:
    Hand(const py::object& walk, std::int64_t part)
        : walk_(walk), open_(get<OpenWalk>(walk, "walk")),
          carry_(open_.run([&](Walk& open) { return Carry(open, {part}); })) {}

    CarryStep move_to(const Pose& pose, CarryOptions options) {
        return open_.query([&](Walk& /*walk*/, const Progress& progress) -> CarryStep {
            options.progress = progress;
            return carry_.move_to(pose, options);
        });
    }
    /// Calls `use(carry)` while nobody else uses the walk.
    template <class Use>
    auto run(Use use) {
        return open_.run([&](Walk& /*walk*/) { return use(carry_); });
    }

private:
    py::object walk_;
    OpenWalk& open_;
    Carry carry_;
};

void bind_carry_step(py::module_& module) {
    PlainBinder<CarryStep>(module, "CarryStep", "Where a carried part has got to.")
        .field("pose", &CarryStep::pose, "Pose")
        .field("blocked", &CarryStep::blocked, "a part kept it from the pose that was asked for")
        .field("waits", &CarryStep::waits, "parts that are not in memory did")
        .field("complete", &CarryStep::complete,
               "False: parts that are not in memory are missing in the lists")
        .property(
            "contacts", [](const CarryStep& self) { return records(self.contacts); },
            "record array of PartImpact: what blocked it, in order")
        .property(
            "touched", [](const CarryStep& self) { return records(self.touched); },
            "record array of WalkGap: the parts that it overlaps or touches")
        .property(
            "near", [](const CarryStep& self) { return records(self.near); },
            "record array of WalkGap: the others within the clearance")
        .done();
}

} // namespace

void bind_carry(py::module_& module) {
    bind_enum<CarryMode>(module, "CarryMode", {"through", "stop", "slide"},
                         "What a carried part does where it meets another one.");
    bind_carry_step(module);
    py::class_<Hand>(
        module, "Carry",
        "Carry(walk, part)\n\n"
        "A part of a Walk in the hand, by its number. Parts that touch it when it is taken do not\n"
        "hold it until it has left them. It keeps the walk alive. Errors as Walk.model.")
        .def(py::init<py::object, std::int64_t>(), py::arg("walk"), py::arg("part"))
        .def(
            "move_to",
            [](Hand& self, const py::object& pose, CarryMode mode, double clearance, bool depths,
               double skin, MissingParts missing, std::optional<std::uint64_t> depth_steps) {
                return self.move_to(to_pose(pose, "pose"),
                                    {mode, clearance, depths, depth_steps, skin, missing, {}});
            },
            py::arg("pose"), py::kw_only(), py::arg("mode") = "stop", py::arg("clearance") = 0.1,
            py::arg("depths") = true, py::arg("skin") = 1e-3, py::arg("missing") = "wait",
            py::arg("depth_steps") = py::none(),
            "Moves the part towards a rigid pose; no contact on the way is missed.\n\n"
            "mode       a CarryMode\n"
            "clearance  length; parts within it are reported\n"
            "depths     whether depths are computed where parts overlap\n"
            "skin       length of the gap that is kept to parts\n"
            "missing    MissingParts\n"
            "depth_steps most steps of all depths together; None: no limit\n\n"
            "Returns a CarryStep. Raises Error (bad_argument); KeyboardInterrupt at Ctrl-C.")
        .def_property_readonly(
            "part",
            [](Hand& self) { return self.run([](Carry& carry) { return carry.part().number; }); },
            "its number")
        .def_property_readonly(
            "carried",
            [](Hand& self) {
                return self.run([](Carry& carry) -> CarriedPart { return carry.carried(); });
            },
            "CarriedPart")
        .def_property_readonly(
            "probe",
            [](Hand& self) {
                return self.run([](Carry& carry) -> Probe { return carry.probe(); });
            },
            "Probe, in the frame that the pose places")
        .def_property_readonly(
            "state",
            [](Hand& self) {
                return self.run([](Carry& carry) -> CarryStep { return carry.state(); });
            },
            "CarryStep, the last one");
}

} // namespace abut::python
