#include <abut/view.h>

#include "module.h"
#include "pictures/frames.h"
#include "stores/open_store.h"
#include "support/arrays.h"
#include "support/enums.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

/// A View, and the lock against use by two threads.
struct OpenView {
    View view;
    InUse use;

    explicit OpenView(View made) : view(std::move(made)) {}
    template <class Query>
    auto run(Query&& query) {
        const InUse::Change change(use, "the view");
        return query(view);
    }
};

py::array chunk_vertices(const ViewChunk& chunk) {
    std::vector<Vec3> points;
    points.reserve(chunk.vertices.size());
    for (const ChunkVertex& vertex : chunk.vertices) {
        const auto place = [&](std::size_t axis) {
            return static_cast<double>(chunk.lower[axis]) +
                   static_cast<double>(chunk.step[axis]) * vertex.position[axis];
        };
        points.push_back({place(0), place(1), place(2)});
    }
    return from_points(std::move(points));
}

py::array chunk_parts(const ViewChunk& chunk) {
    std::vector<std::uint32_t> parts;
    parts.reserve(chunk.vertices.size());
    for (const ChunkVertex& vertex : chunk.vertices)
        parts.push_back(vertex.part);
    return numbers(std::move(parts));
}

FrameCopy copy_of(const ViewFrame& frame) {
    return {{frame.drops.begin(), frame.drops.end()},
            {frame.uploads.begin(), frame.uploads.end()},
            {frame.draws.begin(), frame.draws.end()},
            {frame.instances.begin(), frame.instances.end()},
            frame.complete,
            frame.loaded,
            frame.pixel_error};
}

void bind_frames(py::module_& module) {
    PlainBinder<ViewChunk>(module, "ViewChunk", "A piece of geometry that is drawn at once.")
        .property("vertices", &chunk_vertices,
                  "float64 array of shape (n, 3): of an instanced mesh, or world minus View.origin")
        .property(
            "faces",
            [](const ViewChunk& chunk) {
                std::vector<std::array<std::uint32_t, 3>> faces(chunk.indices.size() / 3);
                for (std::size_t i = 0; i < 3 * faces.size(); ++i)
                    faces[i / 3][i % 3] = chunk.indices[i];
                return rows<std::uint32_t>(std::move(faces));
            },
            "uint32 array of shape (m, 3)")
        .field("closed_triangles", &ViewChunk::closed_triangles,
               "the first triangles, of closed surfaces whose fronts are outside")
        .property("parts", &chunk_parts,
                  "uint32 array of shape (n,): of each vertex, the index in View.parts")
        .done();
    RecordBinder<ChunkDraw>(module, "ChunkDraw", "A draw call.")
        .field("chunk", &ChunkDraw::chunk, "number of the chunk")
        .field("first_instance", &ChunkDraw::first_instance, "in ViewFrame.instances")
        .field("instances", &ChunkDraw::instances, "how many; 0: the chunk is drawn once")
        .done();
    RecordBinder<ChunkInstance>(module, "ChunkInstance", "A part that shows a shared mesh.")
        .field("rows", &ChunkInstance::rows,
               "float32 array of shape (12,): three rows, from the mesh to world minus View.origin")
        .field("part", &ChunkInstance::part, "index in View.parts")
        .done();
}

void bind_frame_copy(py::module_& module) {
    PlainBinder<FrameCopy>(module, "ViewFrame", "Returned by View.frame: what to draw.")
        .property(
            "drops", [](const FrameCopy& frame) { return numbers(frame.drops); },
            "uint32 array of shape (n,): chunks that are no longer needed")
        .property(
            "uploads",
            [](const FrameCopy& frame) {
                py::dict chunks;
                for (const ChunkUpload& upload : frame.uploads)
                    chunks[py::int_(upload.chunk)] = py::cast(*upload.data);
                return chunks;
            },
            "dict of number and ViewChunk: chunks that are needed from this frame on")
        .property(
            "draws", [](const FrameCopy& frame) { return records(frame.draws); },
            "record array of ChunkDraw, nearest first")
        .property(
            "instances", [](const FrameCopy& frame) { return records(frame.instances); },
            "record array of ChunkInstance")
        .field("complete", &FrameCopy::complete, "every chunk is at the level asked for")
        .field("loaded", &FrameCopy::loaded, "nothing that was wanted is missing")
        .field("pixel_error", &FrameCopy::pixel_error, "largest error of what is drawn")
        .done();
}

void bind_view_statistics(py::module_& module) {
    PlainBinder<ViewStatistics>(module, "ViewStatistics", "Work of a View.")
        .field("triangles", &ViewStatistics::triangles, "of the last frame")
        .field("draw_calls", &ViewStatistics::draw_calls, "of the last frame")
        .field("wanted", &ViewStatistics::wanted, "chunks of the last cut")
        .field("missing", &ViewStatistics::missing, "chunks of the last cut not in memory")
        .field("lookups", &ViewStatistics::lookups, "chunks wanted, of all frames")
        .field("misses", &ViewStatistics::misses, "chunks missing, of all frames")
        .field("culled_by_frustum", &ViewStatistics::culled_by_frustum, "nodes of the last frame")
        .field("culled_by_occlusion", &ViewStatistics::culled_by_occlusion,
               "nodes of the last frame")
        .field("bytes_loaded", &ViewStatistics::bytes_loaded, "of all frames")
        .field("bytes", &ViewStatistics::bytes, "in memory")
        .field("peak_bytes", &ViewStatistics::peak_bytes, "at most View's memory")
        .field("gpu_bytes", &ViewStatistics::gpu_bytes, "of the renderer's buffers")
        .field("peak_gpu_bytes", &ViewStatistics::peak_gpu_bytes, "at most View's gpu_memory")
        .field("seconds_selecting", &ViewStatistics::seconds_selecting, "of the last frame")
        .done();
}

void bind_parts_of_view(py::module_& module) {
    PlainBinder<ViewPart>(module, "ViewPart", "A part of a View.")
        .field("number", &ViewPart::number, "its row in the store's table part")
        .field("file", &ViewPart::file, "")
        .field("id", &ViewPart::id, "")
        .field("name", &ViewPart::name, "")
        .field("type", &ViewPart::type, "")
        .field("box", &ViewPart::box, "Box3, world frame")
        .field("colour", &ViewPart::colour, "Colour; else None")
        .done();
    PlainBinder<FoundParts>(module, "FoundParts", "Returned by View.find_parts.")
        .property(
            "parts", [](const FoundParts& found) { return numbers(found.parts); },
            "uint32 array of shape (n,): indices in View.parts")
        .field("next", &FoundParts::next,
               "where to go on; the number of parts if all were compared")
        .done();
}

py::class_<OpenView> bind_view_class(py::module_& module) {
    return py::class_<OpenView>(
               module, "View",
               "View(store, *, memory=2**28, gpu_memory=2**29, pixel_error=1, "
               "triangle_budget=500000,\n"
               "     draw_budget=1500, upload_budget=2**22, look_ahead=1, background=True)\n\n"
               "Chooses and loads what a renderer draws of a Store that has levels (build_levels). "
               "One "
               "thread\nat a time may use it.\n\n"
               "memory           bytes for the tree of levels and for chunks on their way\n"
               "gpu_memory       bytes of the renderer's buffers\n"
               "pixel_error      largest error in pixels; more if the budgets demand it\n"
               "triangle_budget  triangles of a frame\n"
               "draw_budget      draw calls of a frame\n"
               "upload_budget    bytes that one frame hands over\n"
               "look_ahead       seconds of the path for which chunks are read ahead\n"
               "background       whether a second thread reads\n\n"
               "Raises Error: bad_argument if the store has no current levels.")
        .def(py::init([](const OpenStore& store, std::uint64_t memory, std::uint64_t gpu_memory,
                         double pixel_error, std::uint64_t triangle_budget,
                         std::uint32_t draw_budget, std::uint64_t upload_budget, double look_ahead,
                         bool background) {
                 return std::make_unique<OpenView>(
                     View(store.get(), {memory, gpu_memory, pixel_error, triangle_budget,
                                        draw_budget, upload_budget, look_ahead, background}));
             }),
             py::arg("store"), py::kw_only(), py::arg("memory") = std::uint64_t{256} << 20,
             py::arg("gpu_memory") = std::uint64_t{512} << 20, py::arg("pixel_error") = 1.0,
             py::arg("triangle_budget") = std::uint64_t{500'000}, py::arg("draw_budget") = 1'500U,
             py::arg("upload_budget") = std::uint64_t{4} << 20, py::arg("look_ahead") = 1.0,
             py::arg("background") = true);
}

void bind_view_frames(py::class_<OpenView>& view_class) {
    view_class
        .def(
            "frame",
            [](OpenView& self, const Camera& camera, const Vec3& velocity) {
                return self.run([&](View& view) { return copy_of(view.frame(camera, velocity)); });
            },
            py::arg("camera"), py::arg("velocity") = py::make_tuple(0, 0, 0),
            "Chooses what a Camera sees. Returns a ViewFrame.\n\n"
            "velocity  of the eye, in units a second, for loading ahead\n\n"
            "Raises Error: bad_argument, malformed if a chunk is damaged.")
        .def(
            "wait",
            [](OpenView& self) {
                self.run([](View& view) {
                    const py::gil_scoped_release unlocked;
                    view.wait();
                });
            },
            "Waits until all that the last frame wanted is loaded, or memory is full.")
        .def(
            "set_hidden",
            [](OpenView& self, std::uint32_t part, bool hidden) {
                self.run([&](View& view) { view.set_hidden(part, hidden); });
            },
            py::arg("part"), py::arg("hidden"),
            "Leaves a part out of the picture, or brings it back.")
        .def(
            "set_occlusion",
            [](OpenView& self, bool on) { self.run([&](View& view) { view.set_occlusion(on); }); },
            py::arg("on"), "Sets whether parts that others hide are left out; at first they are.")
        .def(
            "set_budgets",
            [](OpenView& self, std::uint64_t triangles, std::uint32_t draws) {
                self.run([&](View& view) { view.set_budgets(triangles, draws); });
            },
            py::arg("triangles"), py::arg("draws"),
            "Changes triangle_budget and draw_budget from the next frame on.")
        .def_property_readonly(
            "statistics",
            [](OpenView& self) {
                return self.run([](View& view) -> ViewStatistics { return view.statistics(); });
            },
            "ViewStatistics");
}

void bind_view_parts(py::class_<OpenView>& view_class) {
    view_class
        .def_property_readonly(
            "origin", [](OpenView& self) { return self.view.origin(); },
            "array of shape (3,): chunks are relative to it")
        .def_property_readonly(
            "bounds", [](OpenView& self) { return self.view.bounds(); }, "Box3, world frame")
        .def_property_readonly(
            "up", [](OpenView& self) { return self.view.up(); }, "UpAxis")
        .def_property_readonly(
            "parts",
            [](OpenView& self) {
                const auto parts = self.view.parts();
                return numbers(std::vector<std::int64_t>(parts.begin(), parts.end()));
            },
            "int64 array of shape (n,): rows of the store's table part")
        .def(
            "index_of",
            [](OpenView& self, std::int64_t number) { return self.view.index_of(number); },
            py::arg("number"), "The index in parts of a row; None if there is no such part.")
        .def(
            "part",
            [](OpenView& self, std::uint32_t index) {
                return self.run([&](View& view) { return view.part(index); });
            },
            py::arg("index"), "The ViewPart of an index in parts. Raises Error (bad_argument).")
        .def(
            "find_parts",
            [](OpenView& self, const std::string& text, std::size_t most, std::uint32_t from,
               double seconds) {
                return self.run(
                    [&](View& view) { return view.find_parts(text, most, from, seconds); });
            },
            py::arg("text"), py::arg("most") = std::size_t{1000}, py::arg("from_part") = 0U,
            py::arg("seconds") = 10.0,
            "Finds parts whose id, name or type contains a text. Returns FoundParts.");
}

} // namespace

void bind_view(py::module_& module) {
    bind_frames(module);
    bind_frame_copy(module);
    bind_view_statistics(module);
    bind_parts_of_view(module);
    py::class_<OpenView> view_class = bind_view_class(module);
    bind_view_frames(view_class);
    bind_view_parts(view_class);
}

} // namespace abut::python
