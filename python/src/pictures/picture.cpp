#include <abut/picture.h>

#include "models/scenes.h"
#include "module.h"
#include "pictures/pixels.h"
#include "stores/clashes.h"
#include "stores/open_store.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"
#include "support/work.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::python {

py::array to_pixels(Picture picture) {
    return own(
        std::move(picture.pixels), py::dtype::of<std::uint8_t>(),
        {static_cast<py::ssize_t>(picture.height), static_cast<py::ssize_t>(picture.width), 3});
}

Picture from_pixels(const py::object& object) {
    if (!is_array(object))
        throw py::type_error("picture: an array of shape (height, width, 3) is wanted");
    const py::array any(object);
    if (any.ndim() != 3 || any.shape(2) != 3 || any.dtype().kind() != 'u' || any.itemsize() != 1)
        throw py::value_error("picture: an array of uint8 of shape (height, width, 3) is wanted");
    const py::array_t<std::uint8_t, py::array::c_style> pixels(any);
    Picture picture{
        static_cast<std::uint32_t>(any.shape(1)), static_cast<std::uint32_t>(any.shape(0)), {}};
    picture.pixels.assign(pixels.data(), pixels.data() + pixels.size());
    return picture;
}

namespace {

/// A view's name, a Camera, a part's id or a pair of parts.
decltype(PictureOptions::aim) to_aim(const py::object& aim) {
    if (py::isinstance<Camera>(aim))
        return aim.cast<const Camera&>();
    if (py::isinstance<PartAim>(aim))
        return aim.cast<const PartAim&>();
    if (py::isinstance<PairAim>(aim))
        return aim.cast<const PairAim&>();
    if (py::isinstance<SidesAim>(aim))
        return aim.cast<const SidesAim&>();
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
    PlainBinder<SidesAim>(
        module, "SidesAim",
        "SidesAim(camera, sides, around=[])\n\nTwo sets of parts in red and blue, as a Camera sees "
        "them; the parts\naround them are ghosts. No other part is drawn.")
        .field("camera", &SidesAim::camera, "Camera; its size is ignored")
        .field("sides", &SidesAim::sides, "two lists of NamedPart")
        .field("around", &SidesAim::around, "list of NamedPart")
        .done()
        .def(py::init([](const Camera& camera, const std::array<std::vector<NamedPart>, 2>& sides,
                         const std::vector<NamedPart>& around) {
                 return SidesAim{camera, sides, around};
             }),
             py::arg("camera"), py::arg("sides"), py::arg("around") = std::vector<NamedPart>{});
    PlainBinder<PartDistances>(
        module, "PartDistances",
        "PartDistances(part, reach=1)\n\nColours surfaces by their exact distance from a part.")
        .field("part", &PartDistances::part, "id or name")
        .field("reach", &PartDistances::reach, "length up to which surfaces are coloured")
        .done()
        .def(py::init([](const std::string& part, double reach) {
                 return PartDistances{part, reach};
             }),
             py::arg("part"), py::arg("reach") = PartDistances{}.reach);
}

void bind_colouring(py::module_& module) {
    PlainBinder<PartColouring::Group>(module, "ColourGroup", "A row of the legend of colours.")
        .field("word", &PartColouring::Group::word, "a type, a file, a storey, a kind, or 'none'")
        .field("colour", &PartColouring::Group::colour, "Colour")
        .field("parts", &PartColouring::Group::parts, "how many")
        .done();
    PlainBinder<PartColouring>(module, "PartColouring",
                               "The colours of the parts of a Store or of models.")
        .field("colours", &PartColouring::colours,
               "list of Colour, in the order of View.parts or of models")
        .property(
            "groups", [](const PartColouring& self) { return numbers(self.groups); },
            "uint32 array of shape (n,): of each part, its row in legend")
        .field("legend", &PartColouring::legend,
               "list of ColourGroup, the largest first; of 'type', 'file', 'storey' and 'clash'")
        .done();
    module.def(
        "part_colouring",
        [](const OpenStore& store, ColourBy by) {
            const Store opened = store.get();
            const py::gil_scoped_release unlocked;
            return part_colouring(opened, by);
        },
        py::arg("store"), py::arg("by") = "material",
        "The PartColouring of the parts of a Store, or of models, model by model. Raises Error: "
        "those of the\nstore; bad_argument for models by 'clash'.");
    module.def(
        "part_colouring",
        [](const py::object& models, ColourBy by) {
            const std::vector<Scene> scenes = to_scenes(models, py::none());
            const py::gil_scoped_release unlocked;
            return part_colouring(scenes, by);
        },
        py::arg("models"), py::arg("by") = "material", "Of a Scene or path, or several.");
    module.def(
        "part_colours",
        [](const OpenStore& store, ColourBy by) {
            const Store opened = store.get();
            const py::gil_scoped_release unlocked;
            return part_colours(opened, by);
        },
        py::arg("store"), py::arg("by") = "material",
        "The list of Colour of a Store's parts, in the order of View.parts, or of some ViewPart. "
        "Equal\nwords get equal colours in every model.");
    module.def(
        "part_colours",
        [](const std::vector<ViewPart>& parts, ColourBy by) { return part_colours(parts, by); },
        py::arg("parts"), py::arg("by") = "material",
        "Of ViewParts, all are grey by 'storey' and 'clash'.");
    module.def(
        "part_colours",
        [](const py::object& models, ColourBy by) {
            const std::vector<Scene> scenes = to_scenes(models, py::none());
            const py::gil_scoped_release unlocked;
            return part_colours(scenes, by);
        },
        py::arg("models"), py::arg("by") = "material",
        "Of a Scene or path, or several. Raises Error (bad_argument) by 'clash'.");
}

/// Models that pictures are made of: a store, or scenes.
struct PictureSource {
    std::optional<Store> store;
    std::vector<Scene> scenes;

    PictureSource(const py::object& models, const py::object& report) {
        if (py::isinstance<OpenStore>(models))
            store = models.cast<const OpenStore&>().get();
        else
            scenes = to_scenes(models, report);
    }
};

/// A PictureMaker with the models that it draws. Its context belongs to one thread.
class OwnedPictureMaker {
public:
    OwnedPictureMaker(const py::object& models, const py::object& report)
        : source_(std::make_unique<PictureSource>(models, report)) {
        const py::gil_scoped_release unlocked;
        maker_ = source_->store ? std::make_unique<PictureMaker>(*source_->store)
                                : std::make_unique<PictureMaker>(source_->scenes);
    }
    ~OwnedPictureMaker() {
        if (thread_.is_this())
            return;
        // The context may be current on the other thread: nothing may be freed here.
        (void)maker_.release();
        (void)source_.release();
    }
    OwnedPictureMaker(const OwnedPictureMaker&) = delete;
    OwnedPictureMaker& operator=(const OwnedPictureMaker&) = delete;

    py::array make(PictureOptions& options, const py::object& report) {
        thread_.require("the picture maker");
        const InUse::Change change(use_, "the picture maker");
        Work work(report);
        return to_pixels(work.run([&](const Progress& progress) {
            options.progress = progress;
            return maker_->make(options);
        }));
    }

private:
    std::unique_ptr<PictureSource> source_;
    std::unique_ptr<PictureMaker> maker_;
    OwnThread thread_;
    InUse use_;
};

/// Defines a function that takes the options of a picture as keywords. `draw` takes a first
/// argument, the options and the progress.
template <class First, class Scope, class Draw, class... Leading>
void def_picture(Scope& scope, const char* name, Draw draw, const char* doc,
                 const Leading&... leading) {
    const PictureOptions usual;
    scope.def(
        name,
        [draw](First first, const py::object& aim, std::uint32_t width, std::uint32_t height,
               ColourBy colour_by, std::uint32_t samples, bool edges, bool ambient_occlusion,
               bool ground, const std::vector<SectionPlane>& sections,
               const std::optional<Box3>& section_box,
               const std::optional<PartDistances>& distances, const py::object& progress) {
            PictureOptions options{
                to_aim(aim),       width,  height,   colour_by,   samples,  edges,
                ambient_occlusion, ground, sections, section_box, distances};
            return draw(first, options, progress);
        },
        leading..., py::arg("aim") = "iso", py::kw_only(), py::arg("width") = usual.width,
        py::arg("height") = usual.height, py::arg("colour_by") = "material",
        py::arg("samples") = usual.samples, py::arg("edges") = usual.edges,
        py::arg("ambient_occlusion") = usual.ambient_occlusion, py::arg("ground") = usual.ground,
        py::arg("sections") = usual.sections, py::arg("section_box") = py::none(),
        py::arg("distances") = py::none(), py::arg("progress") = py::none(), doc);
}

py::array draw_once(const py::object& models, PictureOptions& options, const py::object& report) {
    const PictureSource source(models, report);
    Work work(report);
    return to_pixels(work.run([&](const Progress& progress) {
        options.progress = progress;
        return source.store ? picture(*source.store, options) : picture(source.scenes, options);
    }));
}

} // namespace

void bind_picture(py::module_& module) {
    bind_aims(module);
    bind_colouring(module);
    def_picture<const py::object&>(
        module, "picture", &draw_once,
        "Draws models at full detail, without a window.\n\n"
        "models             a Store, or a Scene or path, or several\n"
        "aim                NamedView or its name, Camera, PartAim, PairAim, SidesAim, or a\n"
        "                   Clash of these models\n"
        "width, height      pixels, at most 8192\n"
        "colour_by          ColourBy: 'material', 'type', 'file', 'part', 'storey' or, of a Store, "
        "'clash'\n"
        "samples            along each side of a pixel: 1, 2 or 4\n"
        "edges              dark lines at silhouettes and creases\n"
        "ambient_occlusion  darker corners\n"
        "ground             a grid below the model\n"
        "sections           at most 6 SectionPlane\n"
        "section_box        Box3: what lies outside is cut away\n"
        "distances          PartDistances: surfaces are coloured by their distance from a part\n"
        "progress           function of (stage, fraction)\n\n"
        "Returns a uint8 array of shape (height, width, 3): red, green, blue, rows from the top.\n"
        "Raises Error: unsupported if EGL or OpenGL 3.3 is not available; bad_argument if no part "
        "or\nseveral have the id; those of the files. KeyboardInterrupt at Ctrl-C.",
        py::arg("models"));
    py::class_<OwnedPictureMaker> maker(
        module, "PictureMaker",
        "PictureMaker(models, *, progress=None)\n\n"
        "Makes several pictures of the same models: a Store, or a Scene or path, or several. The "
        "OpenGL\ncontext and the list of parts are made once, which is most of the time of a small "
        "picture. Only the\nthread that made it may use it.\n\n"
        "Raises Error: unsupported if EGL or OpenGL 3.3 is not available; those of the files.");
    maker.def(py::init<const py::object&, const py::object&>(), py::arg("models"), py::kw_only(),
              py::arg("progress") = py::none());
    def_picture<OwnedPictureMaker&>(
        maker, "make",
        [](OwnedPictureMaker& self, PictureOptions& options, const py::object& report) {
            return self.make(options, report);
        },
        "As picture, with the same result.");
    module.def(
        "write_png",
        [](const py::object& pixels, const py::object& path) {
            write_png(from_pixels(pixels), to_path(path));
        },
        py::arg("picture"), py::arg("path"),
        "Writes an array of shape (height, width, 3), uint8, as PNG, atomically. Raises Error "
        "(cannot_write).");
    module.def(
        "png_bytes",
        [](const py::object& pixels) { return py::bytes(png_bytes(from_pixels(pixels))); },
        py::arg("picture"),
        "The bytes of a PNG file of an array of shape (height, width, 3), uint8. Raises Error "
        "(bad_argument)\nif it has no pixels.");
}

} // namespace abut::python
