#include <abut/walker.h>

#include "module.h"
#include "walks/open_walk.h"

namespace abut::python {

namespace {

/// A person, who keeps the walk.
class Person {
public:
    Person(const py::object& walk, const Vec3& feet, const WalkerOptions& options)
        : walk_(walk), open_(get<OpenWalk>(walk, "walk")),
          walker_(open_.run([&](Walk& open) { return Walker(open, feet, options); })) {}

    /// Calls `use(walker)` while nobody else uses the walk.
    template <class Use>
    auto run(Use use) {
        return open_.run([&](Walk& /*walk*/) { return use(walker_); });
    }

private:
    py::object walk_;
    OpenWalk& open_;
    Walker walker_;
};

WalkerOptions walker_options(const py::kwargs& names) {
    WalkerOptions options;
    for (const auto& [key, value] : names) {
        const auto name = key.cast<std::string>();
        const auto number = [&, &value = value](const char* which, double& member) {
            if (name == which)
                member = to_double(value, which);
            return name == which;
        };
        if (name == "up")
            options.up = to_enum<UpAxis>(value);
        else if (name == "mode")
            options.mode = to_enum<WalkerMode>(value);
        else if (name == "missing")
            options.missing = to_enum<MissingParts>(value);
        else if (name == "except_part")
            options.except = {value.cast<std::int64_t>()};
        else if (!(number("height", options.height) || number("radius", options.radius) ||
                   number("ducked_height", options.ducked_height) ||
                   number("eye_height", options.eye_height) ||
                   number("ducked_eye_height", options.ducked_eye_height) ||
                   number("step_height", options.step_height) ||
                   number("steepest", options.steepest) || number("gravity", options.gravity) ||
                   number("jump_speed", options.jump_speed) || number("skin", options.skin)))
            throw py::type_error("Walker() got an unexpected keyword argument '" + name + "'");
    }
    return options;
}

void bind_walker_state(py::module_& module) {
    PlainBinder<WalkerState>(module, "WalkerState", "Where a person is after a step.")
        .field("feet", &WalkerState::feet, "array of shape (3,), world frame")
        .field("eye", &WalkerState::eye, "array of shape (3,), world frame")
        .field("velocity", &WalkerState::velocity, "array of shape (3,): mean of the last step")
        .property(
            "way", [](const WalkerState& self) { return from_points(self.way); },
            "float64 array of shape (n, 3): the corners of the feet's way in the last step")
        .field("on_ground", &WalkerState::on_ground, "")
        .field("ducked", &WalkerState::ducked, "")
        .field("blocked", &WalkerState::blocked, "a part kept the person from its way")
        .field("waits", &WalkerState::waits, "stopped at parts that are not in memory")
        .field("squeezed", &WalkerState::squeezed, "overlaps a part and cannot be pushed out")
        .done();
}

void add_person_members(py::class_<Person>& type) {
    type.def_property_readonly("state",
                               [](Person& self) {
                                   return self.run(
                                       [](Walker& w) -> WalkerState { return w.state(); });
                               })
        .def_property_readonly(
            "capsule", [](Person& self) { return self.run([](Walker& w) { return w.capsule(); }); },
            "a Capsule around the person now, world frame")
        .def_property_readonly(
            "mode", [](Person& self) { return self.run([](Walker& w) { return w.mode(); }); },
            "WalkerMode")
        .def(
            "set_mode",
            [](Person& self, WalkerMode mode) {
                self.run([=](Walker& walker) { walker.set_mode(mode); });
            },
            py::arg("mode"), "Walks or flies from now on.")
        .def(
            "set_except",
            [](Person& self, std::int64_t part) {
                self.run([=](Walker& walker) { walker.set_except({part}); });
            },
            py::arg("part"), "A part to pass through, for example one that is carried. 0: none.")
        .def(
            "move_to",
            [](Person& self, const py::object& feet) {
                const Vec3 place = to_vec3(feet, "feet");
                self.run([&](Walker& walker) { walker.move_to(place); });
            },
            py::arg("feet"), "Puts the person elsewhere.");
}

} // namespace

void bind_walker(py::module_& module) {
    bind_enum<WalkerMode>(module, "WalkerMode", {"walk", "fly"}, "How a person moves.");
    bind_walker_state(module);
    py::class_<Person> type(
        module, "Walker",
        "Walker(walk, feet, *, up='z', mode='walk', height=1.8, radius=0.3, ducked_height=1.0,\n"
        "       eye_height=1.7, ducked_eye_height=0.9, step_height=0.35, steepest=0.785398,\n"
        "       gravity=9.81, jump_speed=3.5, skin=0.01, missing='skip', except_part=0)\n\n"
        "A person, as a capsule, who walks or flies through a Walk and never passes through a "
        "part.\n"
        "Lengths in metres, angles in radians. It keeps the walk alive.\n\n"
        "feet      the lowest point of the person, shape (3,), world frame\n"
        "steepest  slope of the steepest floor that can be stood on\n"
        "skin      length of the gap that is kept to parts\n"
        "missing   'skip': waits at parts that are not in memory; 'wait': reads them in step\n\n"
        "Raises Error (bad_argument) if a value is not finite or a length not as its name says.");
    type.def(py::init([](const py::object& walk, const py::object& feet, const py::kwargs& names) {
                 return std::make_unique<Person>(walk, to_vec3(feet, "feet"),
                                                 walker_options(names));
             }),
             py::arg("walk"), py::arg("feet"))
        .def(
            "step",
            [](Person& self, const py::object& wish, double seconds, bool duck, bool jump) {
                const Vec3 velocity = to_vec3(wish, "wish");
                return self.run([&](Walker& walker) -> WalkerState {
                    return walker.step(velocity, seconds, duck, jump);
                });
            },
            py::arg("wish"), py::arg("seconds"), py::kw_only(), py::arg("duck") = false,
            py::arg("jump") = false,
            "Moves the person for some time; returns the WalkerState.\n\n"
            "wish  velocity that is asked for, shape (3,), world frame");
    add_person_members(type);
}

} // namespace abut::python
