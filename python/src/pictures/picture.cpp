#include <abut/picture.h>

#include "models/scenes.h"
#include "module.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

/// The rows of a picture as an array of shape (height, width, 3).
py::array to_pixels(Picture picture) {
    return own(
        std::move(picture.pixels), py::dtype::of<std::uint8_t>(),
        {static_cast<py::ssize_t>(picture.height), static_cast<py::ssize_t>(picture.width), 3});
}

Picture from_pixels(const py::object& object) {
    if (!is_array(object))
        throw py::type_error("picture: an array of shape (height, width, 3) is wanted");
    const py::array any(object);
    if (any.ndim() != 3 || any.shape(2) != 3 || !any.dtype().is(py::dtype::of<std::uint8_t>()))
        throw py::value_error("picture: an array of uint8 of shape (height, width, 3) is wanted");
    const py::array_t<std::uint8_t, py::array::c_style> pixels(any);
    Picture picture{
        static_cast<std::uint32_t>(any.shape(1)), static_cast<std::uint32_t>(any.shape(0)), {}};
    picture.pixels.assign(pixels.data(), pixels.data() + pixels.size());
    return picture;
}

/// A view's name, a Camera, a part's id or a pair of parts.
decltype(PictureOptions::aim) to_aim(const py::object& aim) {
    if (py::isinstance<Camera>(aim))
        return aim.cast<const Camera&>();
    if (py::isinstance<PartAim>(aim))
        return aim.cast<const PartAim&>();
    if (py::isinstance<PairAim>(aim))
        return aim.cast<const PairAim&>();
    if (py::isinstance<NamedClash>(aim)) {
        const auto& clash = aim.cast<const NamedClash&>();
        return PairAim{clash.files, clash.ids, std::array{clash.point_a, clash.point_b}};
    }
    return to_enum<NamedView>(aim);
}

void bind_aims(py::module_& module) {
    bind_enum<NamedView>(module, "NamedView",
                         {"iso", "front", "back", "left", "right", "top", "bottom"},
                         "Directions from which a whole model is seen.");
    bind_enum<ColourBy>(module, "ColourBy", {"material", "type", "file", "part", "storey", "clash"},
                        "What parts take their colours from.");
    PlainBinder<PartAim>(module, "PartAim",
                         "PartAim(part)\n\nOne part, by its id or name, filling a picture; all "
                         "others are ghosts.")
        .field("part", &PartAim::part, "id or name")
        .done()
        .def(py::init([](const std::string& part) { return PartAim{part}; }), py::arg("part"));
    PlainBinder<PairAim>(
        module, "PairAim",
        "PairAim(file, part, points=None)\n\nA pair of parts in red and blue, seen from where most "
        "of both shows.")
        .field("file", &PairAim::file, "names of two files")
        .field("part", &PairAim::part, "ids of two parts")
        .field("points", &PairAim::points, "points of both surfaces, or None: they are computed")
        .done()
        .def(py::init([](const std::array<std::string, 2>& file,
                         const std::array<std::string, 2>& part,
                         const std::optional<std::array<Vec3, 2>>& points) {
                 return PairAim{file, part, points};
             }),
             py::arg("file"), py::arg("part"), py::arg("points") = py::none());
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
}

} // namespace

void bind_picture(py::module_& module) {
    bind_aims(module);
    module.def(
        "picture",
        [](const py::object& models, const py::object& aim, std::uint32_t width,
           std::uint32_t height, ColourBy colour_by, std::uint32_t samples, bool edges,
           bool ambient_occlusion, bool ground, const std::vector<SectionPlane>& sections,
           std::optional<Box3> section_box, const py::object& report) {
            PictureOptions options{to_aim(aim),       width,  height,   colour_by,   samples, edges,
                                   ambient_occlusion, ground, sections, section_box, {}};
            if (py::isinstance<OpenStore>(models)) {
                const Store store = models.cast<const OpenStore&>().get();
                Work work(report);
                return to_pixels(work.run([&](const Progress& progress) {
                    options.progress = progress;
                    return picture(store, options);
                }));
            }
            const std::vector<Scene> scenes = to_scenes(models, report);
            Work work(report);
            return to_pixels(work.run([&](const Progress& progress) {
                options.progress = progress;
                return picture(scenes, options);
            }));
        },
        py::arg("models"), py::arg("aim") = "iso", py::kw_only(), py::arg("width") = 1600U,
        py::arg("height") = 1000U, py::arg("colour_by") = "material", py::arg("samples") = 2U,
        py::arg("edges") = true, py::arg("ambient_occlusion") = true, py::arg("ground") = true,
        py::arg("sections") = std::vector<SectionPlane>{}, py::arg("section_box") = py::none(),
        py::arg("progress") = py::none(),
        "Draws models at full detail, without a window.\n\n"
        "models             a Store, or a Scene or path, or several\n"
        "aim                NamedView or its name, Camera, PartAim, PairAim, or a Clash of these "
        "models\n"
        "width, height      pixels, at most 8192\n"
        "colour_by          ColourBy: 'material', 'type', 'file', 'part', 'storey' or 'clash'\n"
        "samples            along each side of a pixel: 1, 2 or 4\n"
        "edges              dark lines at silhouettes and creases\n"
        "ambient_occlusion  darker corners\n"
        "ground             a grid below the model\n"
        "sections           at most 6 SectionPlane\n"
        "section_box        Box3: what lies outside is cut away\n"
        "progress           function of (stage, fraction)\n\n"
        "Returns a uint8 array of shape (height, width, 3): red, green, blue, rows from the top.\n"
        "Raises Error: unsupported if EGL or OpenGL 3.3 is not available; bad_argument if no part "
        "or\nseveral have the id; those of the files. KeyboardInterrupt at Ctrl-C.");
    module.def(
        "write_png",
        [](const py::object& pixels, const py::object& path) {
            write_png(from_pixels(pixels), to_path(path));
        },
        py::arg("picture"), py::arg("path"),
        "Writes an array of shape (height, width, 3), uint8, as PNG, atomically. Raises Error "
        "(cannot_write).");
    module.def(
        "part_colours",
        [](const OpenStore& store, ColourBy by) { return part_colours(store.get(), by); },
        py::arg("store"), py::arg("by") = "material",
        "The list of Colour of a Store's parts, in the order of View.parts.");
}

} // namespace abut::python
