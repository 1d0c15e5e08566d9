#include <abut/renderer.h>

#include "module.h"
#include "pictures/frames.h"
#include "pictures/pixels.h"
#include "pictures/styles.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/meshes.h"
#include "support/records.h"
#include "support/work.h"

#include <memory>
#include <optional>
#include <vector>

namespace abut::python {

namespace {

/// A Renderer with a context of its own, which is current during its calls.
class OwnedRenderer {
public:
    OwnedRenderer(std::uint32_t parts, const Vec3& origin)
        : drawing_(std::make_unique<Drawing>(parts, origin)) {}
    ~OwnedRenderer() {
        if (!thread_.is_this()) {
            // The context may be current on the other thread: nothing may be freed here.
            (void)drawing_.release();
            return;
        }
        try {
            drawing_->context.make_current();
        } catch (const Error&) {
            (void)drawing_.release();
        }
    }
    OwnedRenderer(const OwnedRenderer&) = delete;
    OwnedRenderer& operator=(const OwnedRenderer&) = delete;

    template <class Call>
    auto run(Call&& call) {
        thread_.require("the renderer");
        const InUse::Change change(use_, "the renderer");
        const py::gil_scoped_release unlocked;
        drawing_->context.make_current();
        return call(drawing_->renderer);
    }

private:
    struct Drawing {
        Drawing(std::uint32_t parts, const Vec3& origin) : renderer(parts, origin) {}
        OffscreenContext context;
        Renderer renderer;
    };

    std::unique_ptr<Drawing> drawing_;
    OwnThread thread_;
    InUse use_;
};

using RendererClass = py::class_<OwnedRenderer>;

RendererClass bind_renderer_class(py::module_& module) {
    RendererClass renderer(
        module, "Renderer",
        "Renderer(parts, origin=(0, 0, 0))\n\n"
        "Draws what a View chooses, into pictures in memory, with an OpenGL context of its own. "
        "Only the\nthread that made it may use it. Give it every frame of the View in turn: each "
        "holds only the\nchunks that are new.\n\n"
        "parts   number of parts: len(View.parts)\n"
        "origin  what chunks are relative to: View.origin\n\n"
        "Raises Error: unsupported if EGL or OpenGL 3.3 is not available.");
    renderer.def(py::init([](std::uint32_t parts, const py::object& origin) {
                     return std::make_unique<OwnedRenderer>(parts, to_vec3(origin, "origin"));
                 }),
                 py::arg("parts"), py::arg("origin") = py::make_tuple(0, 0, 0));
    return renderer;
}

void bind_renderer_parts(RendererClass& renderer) {
    renderer
        .def(
            "set_state",
            [](OwnedRenderer& self, std::uint32_t part, const PartState& state) {
                self.run([&](Renderer& drawn) { drawn.set_state(part, state); });
            },
            py::arg("part"), py::arg("state"),
            "Sets the PartState of a part. Raises Error (bad_argument).")
        .def(
            "state",
            [](OwnedRenderer& self, std::uint32_t part) {
                return self.run([&](Renderer& drawn) { return drawn.state(part); });
            },
            py::arg("part"), "The PartState of a part. Raises Error (bad_argument).")
        .def(
            "add_part",
            [](OwnedRenderer& self, const py::object& source, const py::object& pose,
               const PartState& state) {
                const Mesh mesh = to_mesh_value(source, py::none());
                const Transform placed = to_transform(pose, "pose");
                return self.run(
                    [&](Renderer& drawn) { return drawn.add_part(mesh, placed, state); });
            },
            py::arg("mesh"), py::arg("pose") = py::none(), py::arg("state") = PartState{},
            "Draws a mesh beside the view, at most 64 at a time. Returns its number.\n"
            "Raises Error (bad_argument) if there are 64.")
        .def(
            "move_part",
            [](OwnedRenderer& self, std::uint32_t part, const py::object& pose) {
                const Transform placed = to_transform(pose, "pose");
                self.run([&](Renderer& drawn) { drawn.move_part(part, placed); });
            },
            py::arg("part"), py::arg("pose"),
            "Places a part that add_part made. Raises Error (bad_argument).")
        .def(
            "remove_part",
            [](OwnedRenderer& self, std::uint32_t part) {
                self.run([&](Renderer& drawn) { drawn.remove_part(part); });
            },
            py::arg("part"), "Removes a part that add_part made. Raises Error (bad_argument).")
        .def_property_readonly(
            "has_ghosts",
            [](OwnedRenderer& self) {
                return self.run([](Renderer& drawn) { return drawn.has_ghosts(); });
            },
            "whether any part is ghosted and not hidden");
}

void bind_renderer_pictures(RendererClass& renderer) {
    renderer
        .def(
            "picture",
            [](OwnedRenderer& self, const FrameCopy& frame, const Camera& camera,
               const RenderStyle& style, const std::vector<Mark>& marks) {
                return to_pixels(self.run([&](Renderer& drawn) {
                    return drawn.picture(frame.frame(), camera, style, marks);
                }));
            },
            py::arg("frame"), py::arg("camera"), py::arg("style") = RenderStyle{},
            py::arg("marks") = std::vector<Mark>{},
            "Draws a ViewFrame as a Camera sees it. Equal to begin, add, end_picture.\n\n"
            "Returns a uint8 array of shape (height, width, 3). Raises Error: bad_argument if the "
            "camera or\nthe style is not valid, unsupported.")
        .def(
            "begin",
            [](OwnedRenderer& self, const Camera& camera, const RenderStyle& style) {
                self.run([&](Renderer& drawn) { drawn.begin(camera, style); });
            },
            py::arg("camera"), py::arg("style") = RenderStyle{},
            "Begins a picture that is drawn in several steps. Raises Error: as picture.")
        .def(
            "add",
            [](OwnedRenderer& self, const FrameCopy& frame) {
                self.run([&](Renderer& drawn) { drawn.add(frame.frame()); });
            },
            py::arg("frame"),
            "Adds a ViewFrame to the picture. Raises Error (bad_argument) if none was begun.")
        .def(
            "add_ghosts",
            [](OwnedRenderer& self, const FrameCopy& frame) {
                self.run([&](Renderer& drawn) { drawn.add_ghosts(frame.frame()); });
            },
            py::arg("frame"),
            "Adds the ghosted parts of a ViewFrame, after all calls of add. Raises Error "
            "(bad_argument).")
        .def(
            "end_picture",
            [](OwnedRenderer& self, const std::vector<Mark>& marks) {
                return to_pixels(
                    self.run([&](Renderer& drawn) { return drawn.end_picture(marks); }));
            },
            py::arg("marks") = std::vector<Mark>{},
            "Ends a picture. Returns a uint8 array of shape (height, width, 3). Raises Error "
            "(bad_argument)\nif none was begun.");
}

void bind_renderer_answers(RendererClass& renderer) {
    renderer
        .def(
            "part_at",
            [](OwnedRenderer& self, std::uint32_t x, std::uint32_t y) {
                return self.run([&](Renderer& drawn) { return drawn.part_at(x, y); });
            },
            py::arg("x"), py::arg("y"),
            "The part that the last picture shows at a pixel, from the top left corner; None for "
            "the\nbackground and for ghosts.")
        .def(
            "visible_samples",
            [](OwnedRenderer& self, const py::object& parts) {
                const std::vector<std::uint32_t> asked = to_indices(parts, "parts");
                return numbers(
                    self.run([&](Renderer& drawn) { return drawn.visible_samples(asked); }));
            },
            py::arg("parts"),
            "uint64 array of shape (n,): in how many samples of the last picture each part is "
            "visible.")
        .def_property_readonly(
            "statistics",
            [](OwnedRenderer& self) {
                return self.run([](Renderer& drawn) { return drawn.statistics(); });
            },
            "RenderStatistics");
}

} // namespace

void bind_renderer(py::module_& module) {
    bind_render_styles(module);
    RendererClass renderer = bind_renderer_class(module);
    bind_renderer_parts(renderer);
    bind_renderer_pictures(renderer);
    bind_renderer_answers(renderer);
}

} // namespace abut::python
