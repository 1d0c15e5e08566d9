#include "pictures/styles.h"

#include <abut/renderer.h>

#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"

#include <optional>
#include <vector>

namespace abut::python {

namespace {

void bind_drawn_extras(py::module_& module) {
    PlainBinder<SectionPlane>(
        module, "SectionPlane",
        "SectionPlane(normal, offset)\n\nCuts away the points with dot(normal, point) > offset.")
        .field("normal", &SectionPlane::normal, "array of shape (3,)")
        .field("offset", &SectionPlane::offset, "length")
        .done()
        .def(py::init([](const py::object& normal, double offset) {
                 return SectionPlane{to_vec3(normal, "normal"), offset};
             }),
             py::arg("normal"), py::arg("offset"));
    PlainBinder<Mark>(module, "Mark",
                      "Mark(a, b, *, colour=Colour(255, 120, 0), width=2)\n\n"
                      "A segment or, if both ends are equal, a dot, drawn over a picture.")
        .field("a", &Mark::a, "array of shape (3,), world frame")
        .field("b", &Mark::b, "array of shape (3,), world frame")
        .field("colour", &Mark::colour, "Colour")
        .field("width", &Mark::width, "pixels; the diameter of a dot")
        .done()
        .def(py::init(
                 [](const py::object& a, const py::object& b, const Colour& colour, float width) {
                     return Mark{to_vec3(a, "a"), to_vec3(b, "b"), colour, width};
                 }),
             py::arg("a"), py::arg("b"), py::kw_only(), py::arg("colour") = Mark{}.colour,
             py::arg("width") = Mark{}.width);
    PlainBinder<Ground>(module, "Ground",
                        "Ground(middle, reach=100)\n\nA horizontal plane with a grid.")
        .field("middle", &Ground::middle, "array of shape (3,), world frame")
        .field("reach", &Ground::reach, "length from the middle where it has faded")
        .done()
        .def(py::init([](const py::object& middle, double reach) {
                 return Ground{to_vec3(middle, "middle"), reach};
             }),
             py::arg("middle"), py::arg("reach") = Ground{}.reach);
}

void bind_part_state(py::module_& module) {
    PlainBinder<PartState>(
        module, "PartState",
        "PartState(colour=Colour(200, 200, 200), *, hidden=False, ghosted=False, "
        "highlighted=False)\n\nHow a Renderer draws a part.")
        .field("colour", &PartState::colour, "Colour; its alpha has no effect")
        .field("hidden", &PartState::hidden, "")
        .field("ghosted", &PartState::ghosted, "transparent grey, whatever its colour")
        .field("highlighted", &PartState::highlighted, "with a bright outline")
        .done()
        .def(py::init([](const Colour& colour, bool hidden, bool ghosted, bool highlighted) {
                 return PartState{colour, hidden, ghosted, highlighted};
             }),
             py::arg("colour") = PartState{}.colour, py::kw_only(), py::arg("hidden") = false,
             py::arg("ghosted") = false, py::arg("highlighted") = false)
        .def("__eq__", [](const PartState& a, const PartState& b) { return a == b; });
}

void bind_distance_colours(py::module_& module) {
    PlainBinder<DistanceColours>(
        module, "DistanceColours",
        "Colours surfaces by their distance from a part; made by distances_from. Red where it is "
        "0, blue\nat the reach; what is farther keeps its part's colour.")
        .field("reach", &DistanceColours::reach, "length")
        .field("grid", &DistanceColours::grid,
               "the distance is computed for one pixel in grid x grid and at borders of parts")
        .done()
        .def(
            "distance",
            [](const DistanceColours& self, std::uint32_t part, const py::object& point) {
                return self.distance(part, to_vec3(point, "point"));
            },
            py::arg("part"), py::arg("point"),
            "The distance of a point on a part's surface, at most the reach.");
    module.def("distance_colour", &distance_colour, py::arg("fraction"),
               "The Colour of a fraction of the reach, in [0, 1]; for a legend.");
    module.def(
        "distances_from",
        [](std::uint32_t part, const Model& model, const py::object& pose, double reach,
           std::uint32_t grid) {
            if (grid < 1)
                throw py::value_error("grid: at least 1 is wanted");
            DistanceColours colours =
                distances_from(part, model, to_transform(pose, "pose"), reach);
            colours.grid = grid;
            return colours;
        },
        py::arg("part"), py::arg("model"), py::arg("pose"), py::arg("reach"), py::kw_only(),
        py::arg("grid") = DistanceColours{}.grid,
        "The DistanceColours by the exact distance from the surface of a part, which itself keeps "
        "its\ncolour.\n\n"
        "part   its number in the renderer\n"
        "model  Model of the part, placed by pose\n"
        "reach  length, positive\n"
        "grid   1: the distance is computed for every pixel\n\n"
        "Raises Error (bad_argument).");
}

RenderStyle make_style(const py::object& up, bool edges, bool ambient_occlusion,
                       const std::optional<Ground>& ground, std::uint32_t samples, double detail,
                       bool leave_out_backs, bool quick, const std::vector<SectionPlane>& sections,
                       const std::optional<Box3>& section_box,
                       const std::optional<DistanceColours>& distances,
                       const Colour& background_low, const Colour& background_high) {
    return {to_vec3(up, "up"), edges, ambient_occlusion, ground,      samples,   detail,
            leave_out_backs,   quick, sections,          section_box, distances, background_low,
            background_high};
}

void bind_style(py::module_& module) {
    const RenderStyle usual;
    PlainBinder<RenderStyle>(
        module, "RenderStyle",
        "RenderStyle(*, up=(0, 0, 1), edges=True, ambient_occlusion=True, ground=None, samples=1,\n"
        "            detail=0.5, leave_out_backs=False, quick=False, sections=[], "
        "section_box=None,\n            distances=None, background_low=Colour(236, 239, 242),\n"
        "            background_high=Colour(171, 189, 208))\n\nHow a Renderer draws. It checks the "
        "values when it draws.")
        .field("up", &RenderStyle::up, "array of shape (3,), for the light from the sky")
        .field("edges", &RenderStyle::edges, "dark lines at silhouettes and creases")
        .field("ambient_occlusion", &RenderStyle::ambient_occlusion, "darker corners")
        .field("ground", &RenderStyle::ground, "Ground; else None")
        .field("samples", &RenderStyle::samples, "along each side of a pixel: 1, 2 or 4")
        .field("detail", &RenderStyle::detail,
               "length, about the size of a common part: how far occlusion reaches")
        .field("leave_out_backs", &RenderStyle::leave_out_backs,
               "whether backs of closed surfaces are left out; faster in software")
        .field("quick", &RenderStyle::quick,
               "whether shading takes fewer steps, with samples=1 and without ambient_occlusion; "
               "faster in software")
        .field("sections", &RenderStyle::sections, "list of SectionPlane, at most 7")
        .field("section_box", &RenderStyle::section_box,
               "Box3; what lies outside is cut away; else None")
        .field("distances", &RenderStyle::distances, "DistanceColours; else None")
        .field("background_low", &RenderStyle::background_low, "Colour")
        .field("background_high", &RenderStyle::background_high, "Colour")
        .done()
        .def(py::init(&make_style), py::kw_only(), py::arg("up") = py::make_tuple(0, 0, 1),
             py::arg("edges") = usual.edges, py::arg("ambient_occlusion") = usual.ambient_occlusion,
             py::arg("ground") = py::none(), py::arg("samples") = usual.samples,
             py::arg("detail") = usual.detail, py::arg("leave_out_backs") = usual.leave_out_backs,
             py::arg("quick") = usual.quick, py::arg("sections") = usual.sections,
             py::arg("section_box") = py::none(), py::arg("distances") = py::none(),
             py::arg("background_low") = usual.background_low,
             py::arg("background_high") = usual.background_high);
}

} // namespace

void bind_render_styles(py::module_& module) {
    bind_drawn_extras(module);
    bind_part_state(module);
    bind_distance_colours(module);
    bind_style(module);
    module.def("on_screen", &on_screen, py::arg("camera"), py::arg("point"),
               "An array of shape (3,): where a Camera sees a point, in pixels from the top left "
               "corner, and\nthe depth along the viewing direction. None if it is not in front of "
               "the camera.\nRaises Error (bad_argument).");
    PlainBinder<RenderStatistics>(module, "RenderStatistics", "Work of a Renderer.")
        .field("triangles", &RenderStatistics::triangles, "of the last picture")
        .field("draw_calls", &RenderStatistics::draw_calls, "of the last picture")
        .field("hidden_triangles", &RenderStatistics::hidden_triangles,
               "of the last picture: left out in software, because others hide them or they are "
               "outside")
        .field("chunks", &RenderStatistics::chunks, "on the graphics card now")
        .field("bytes", &RenderStatistics::bytes, "in vertex and index buffers now")
        .field("uploaded_bytes", &RenderStatistics::uploaded_bytes, "of all pictures")
        .done();
}

} // namespace abut::python
