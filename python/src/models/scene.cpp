#include <abut/scene.h>

#include "models/scenes.h"
#include "module.h"
#include "support/enums.h"
#include "support/meshes.h"
#include "support/records.h"
#include "support/work.h"

namespace abut::python {

namespace {

ReadOptions read_options(double unit, UpAxis up, bool spaces, bool map, double time_limit,
                         std::uint64_t memory_limit, bool allow_outside_files) {
    ReadOptions options;
    options.unit = unit;
    options.up = up;
    options.spaces = spaces;
    options.map = map;
    options.time_limit = time_limit;
    options.memory_limit = memory_limit;
    options.allow_outside_files = allow_outside_files;
    return options;
}

Part make_part(const std::string& id, std::uint32_t mesh, const py::object& pose,
               const py::object& name, const std::string& type, std::optional<Colour> colour) {
    return {id,
            name.is_none() ? id : name.cast<std::string>(),
            type,
            mesh,
            to_transform(pose, "pose"),
            colour};
}

/// From a list with a dict for each part, of names and texts or lists of texts.
Properties make_properties(const py::object& list, std::size_t parts) {
    PropertiesBuilder builder;
    if (list.is_none())
        return {};
    std::size_t count = 0;
    for (const py::handle part : list) {
        for (const auto& [name, value] : part.cast<py::dict>())
            if (PyUnicode_Check(value.ptr()))
                builder.add(name.cast<std::string>(), value.cast<std::string>());
            else
                for (const py::handle each : value)
                    builder.add(name.cast<std::string>(), each.cast<std::string>());
        builder.next_part();
        ++count;
    }
    if (count != parts)
        throw py::value_error("properties of " + std::to_string(count) + " parts for " +
                              std::to_string(parts));
    return builder.finish(parts);
}

py::dict properties_of(const Properties& properties, std::uint32_t part) {
    py::dict result;
    for (const auto& [name, value] : properties.of(part)) {
        const py::str key(properties.names[name]);
        if (!result.contains(key))
            result[key] = py::list();
        result[key].cast<py::list>().append(properties.values[value]);
    }
    return result;
}

void bind_properties(py::module_& module) {
    py::tuple common(kCommonProperties.size());
    for (std::size_t i = 0; i < kCommonProperties.size(); ++i)
        common[i] = std::string(kCommonProperties[i]);
    module.attr("COMMON_PROPERTIES") = common;
    py::class_<Properties>(module, "Properties",
                           "What the parts of a Scene are known to be, as names and texts: "
                           "'storey', 'system', 'Pset_WallCommon.FireRating'.")
        .def_readonly("names", &Properties::names, "list of str, ascending")
        .def_readonly("values", &Properties::values, "list of str: different values")
        .def("of", &properties_of, py::arg("part"),
             "The properties of a part by its index: a dict of names and lists of values.")
        .def(
            "value",
            [](const Properties& self, std::uint32_t part, const std::string& name) {
                return std::string(self.value(part, name));
            },
            py::arg("part"), py::arg("name"),
            "The first value of that name; empty if the part has none.")
        .def("__repr__", [](const Properties& self) {
            return "<abut.Properties: " + std::to_string(self.names.size()) + " names>";
        });
    bind_enum<RelationKind>(module, "RelationKind", {"fills", "connected", "covers", "part_of"},
                            "How two parts of a Scene belong together.");
    PlainBinder<PartRelation>(module, "PartRelation",
                              "Two parts of a Scene that belong together: a fills b, a is a part "
                              "of b.")
        .field("a", &PartRelation::a, "index in Scene.parts")
        .field("b", &PartRelation::b, "index in Scene.parts")
        .field("kind", &PartRelation::kind, "RelationKind")
        .done();
}

Scene make_scene(const py::object& meshes, const std::vector<Part>& parts, const std::string& file,
                 UpAxis up, const py::object& properties) {
    Scene scene;
    scene.file = file;
    scene.up = up;
    for (const py::handle mesh : meshes)
        scene.meshes.push_back(to_mesh_value(py::reinterpret_borrow<py::object>(mesh), py::none()));
    scene.parts = parts;
    scene.properties = make_properties(properties, parts.size());
    for (const Part& part : parts)
        if (part.mesh >= scene.meshes.size())
            throw py::index_error("part '" + part.id + "' has mesh " + std::to_string(part.mesh) +
                                  ", but there are " + std::to_string(scene.meshes.size()) +
                                  " meshes");
    return scene;
}

/// The last arguments of all functions that read, and their defaults.
template <class Function>
void def_read(py::module_& module, const char* name, const char* first, Function function,
              const char* doc) {
    module.def(name, function, py::arg(first), py::kw_only(), py::arg("unit") = 0.0,
               py::arg("up") = "z", py::arg("spaces") = false, py::arg("map") = true,
               py::arg("time_limit") = 600.0, py::arg("memory_limit") = 0U,
               py::arg("allow_outside_files") = false, py::arg("progress") = py::none(), doc);
}

std::string read_doc(const char* head, const char* returns) {
    return std::string(head) +
           "\n\nunit                 metres per unit, for OBJ, OFF, PLY and STL; 0: 1\n"
           "up                   'x', 'y' or 'z': what points up in these\n"
           "spaces               whether IFC's spaces become parts\n"
           "map                  whether IFC parts lie on the map that the file names\n"
           "time_limit           seconds after which a reader is stopped; 0: none\n"
           "memory_limit         bytes that a reader may use; 0: no limit\n"
           "allow_outside_files  whether files outside of the model's folder may be referred to\n"
           "progress             function of (stage, fraction)\n\n" +
           returns +
           "\nThe path may end with a unit and axis: 'pump.stl:mm', 'part.obj:mm:y-up'.\n"
           "Raises Error: file_not_found, unreadable, malformed, unsupported, bad_mesh, "
           "reader_failed.";
}

template <class Result>
auto reader(Result (*read)(const ModelPath&, const ReadOptions&)) {
    return [read](const py::object& path, double unit, UpAxis up, bool spaces, bool map,
                  double time_limit, std::uint64_t memory_limit, bool outside,
                  const py::object& report) {
        auto options = read_options(unit, up, spaces, map, time_limit, memory_limit, outside);
        const ModelPath model = to_model_path(path);
        Work work(report);
        return work.run([&](const Progress& progress) {
            options.progress = progress;
            return read(model, options);
        });
    };
}

bool is_one_path(const py::object& object) {
    return PyUnicode_Check(object.ptr()) || py::hasattr(object, "__fspath__") ||
           py::isinstance<ModelPath>(object);
}

void bind_parts(py::module_& module) {
    bind_enum<UpAxis>(module, "UpAxis", {"x", "y", "z"}, "The axis that points up.");
    bind_enum<NoteKind>(
        module, "NoteKind", {"space", "cut_away", "not_built", "open"},
        "What became of something that a scene does not have as its file means it.");
    PlainBinder<SceneNote>(module, "SceneNote",
                           "Something that a scene does not have as its file means it.")
        .field("kind", &SceneNote::kind, "NoteKind")
        .field("id", &SceneNote::id, "of the part")
        .field("name", &SceneNote::name, "")
        .field("type", &SceneNote::type, "may be empty")
        .field("text", &SceneNote::text, "one line")
        .done();
    PlainBinder<Colour>(
        module, "Colour",
        "Colour(red, green, blue, alpha=255)\n\nAs displays take it: sRGB, each 0 to 255.")
        .field("red", &Colour::red, "")
        .field("green", &Colour::green, "")
        .field("blue", &Colour::blue, "")
        .field("alpha", &Colour::alpha, "0: transparent")
        .done()
        .def(py::init(
                 [](std::uint8_t red, std::uint8_t green, std::uint8_t blue, std::uint8_t alpha) {
                     return Colour{red, green, blue, alpha};
                 }),
             py::arg("red"), py::arg("green"), py::arg("blue"), py::arg("alpha") = 255)
        .def("__eq__", [](const Colour& a, const Colour& b) { return a == b; })
        .def("__str__", [](const Colour& self) { return to_string(self); });
    PlainBinder<Part>(module, "Part",
                      "Part(id, mesh=0, pose=None, *, name=None, type='', colour=None)\n\nA placed "
                      "mesh of a Scene.")
        .field("id", &Part::id, "unique within its scene")
        .field("name", &Part::name, "")
        .field("type", &Part::type, "may be empty")
        .field("mesh", &Part::mesh, "index in Scene.meshes")
        .field("world_from_mesh", &Part::world_from_mesh, "matrix of shape (4, 4)")
        .field("colour", &Part::colour, "Colour of most of its triangles; else None")
        .done()
        .def(py::init(&make_part), py::arg("id"), py::arg("mesh") = 0U,
             py::arg("pose") = py::none(), py::kw_only(), py::arg("name") = py::none(),
             py::arg("type") = "", py::arg("colour") = py::none());
    PlainBinder<ModelPath>(
        module, "ModelPath",
        "ModelPath(path, unit=0, up=None)\n\nA path with the unit and the axis of its file.")
        .field("path", &ModelPath::path, "")
        .field("unit", &ModelPath::unit, "metres per unit of the file; 0: as the format defines")
        .field("up", &ModelPath::up, "UpAxis; None: as the format defines")
        .done()
        .def(py::init([](const py::object& path, double unit, std::optional<UpAxis> up) {
                 return ModelPath{to_path(path), unit, up};
             }),
             py::arg("path"), py::arg("unit") = 0.0, py::arg("up") = py::none());
    module.def(
        "parse_model_path", [](const py::object& text) { return parse_model_path(to_path(text)); },
        py::arg("text"),
        "The ModelPath of 'pump.stl:mm' or 'part.obj:mm:y-up'. Raises Error (bad_argument).");
}

void bind_scene_class(py::module_& module) {
    PlainBinder<ModelPrecision>(module, "ModelPrecision", "What a model tells apart.")
        .field("stated", &ModelPrecision::stated, "metres, as the file states it; 0: it does not")
        .field("single_meshes", &ModelPrecision::single_meshes,
               "whether coordinates of meshes are in single precision")
        .field("single_transforms", &ModelPrecision::single_transforms,
               "whether transforms of parts are, too")
        .done();
    py::class_<Scene>(module, "Scene",
                      "Scene(meshes, parts, *, file='', up='z', properties=None)\n\n"
                      "A file's parts, in metres. Parts may share a mesh. From Python: meshes are "
                      "what Model takes, parts are\n"
                      "Part, properties a list with a dict for each part. Raises IndexError if a "
                      "part's mesh is not there,\n"
                      "ValueError if there are more or fewer dicts than parts.")
        .def(py::init(&make_scene), py::arg("meshes"), py::arg("parts"), py::kw_only(),
             py::arg("file") = "", py::arg("up") = "z", py::arg("properties") = py::none())
        .def_readonly("file", &Scene::file, "path as given")
        .def_property_readonly(
            "meshes",
            [](const py::object& self) {
                py::list list;
                for (const Mesh& mesh : self.cast<const Scene&>().meshes)
                    list.append(py::cast(mesh, py::return_value_policy::reference_internal, self));
                return list;
            },
            "list of Mesh")
        .def_readonly("parts", &Scene::parts, "list of Part")
        .def_readonly("unit", &Scene::unit, "metres per unit of the file; applied already")
        .def_readonly("up", &Scene::up, "UpAxis of the world")
        .def_readonly("notes", &Scene::notes, "list of SceneNote")
        .def_readonly("properties", &Scene::properties, "Properties of the parts")
        .def_readonly("relations", &Scene::relations, "list of PartRelation")
        .def_readonly("project", &Scene::project, "GlobalId of an IFC file's project; else empty")
        .def_property_readonly(
            "map_from_project", [](const Scene& self) { return to_python(self.map_from_project); },
            "matrix of shape (4, 4): from an IFC project to the map that its file names")
        .def_readonly("precision", &Scene::precision, "ModelPrecision")
        .def("__repr__", [](const Scene& scene) {
            return "<abut.Scene: " + (scene.file.empty() ? "" : scene.file + ", ") +
                   std::to_string(scene.parts.size()) + " parts, " +
                   std::to_string(scene.meshes.size()) + " meshes>";
        });
}

void bind_readers(py::module_& module) {
    static const std::string scene_doc =
        read_doc("read_scene(path, ...)\n\nReads a model file: glTF, GLB, OBJ, PLY, STL, OFF, FBX, "
                 "COLLADA, 3MF, IFC.",
                 "Returns a Scene in metres, in the file's axes.");
    static const std::string mesh_doc =
        read_doc("read_mesh(path, ...)\n\nReads a model file as one mesh.",
                 "Returns a Mesh of all parts, in metres.");
    def_read(module, "read_scene", "path",
             reader<Scene>([](const ModelPath& path, const ReadOptions& options) {
                 return read_scene(path, options);
             }),
             scene_doc.c_str());
    def_read(module, "read_mesh", "path",
             reader<Mesh>([](const ModelPath& path, const ReadOptions& options) {
                 return to_mesh(read_scene(path, options));
             }),
             mesh_doc.c_str());
    module.def("read_scenes", &to_scenes, py::arg("paths"), py::kw_only(),
               py::arg("progress") = py::none(),
               "Reads several model files in parallel, with the options' defaults. Returns a list "
               "of Scene. Errors as\n"
               "read_scene.");
}

} // namespace

std::string to_path(py::handle path) {
    return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

ModelPath to_model_path(py::handle path) {
    return py::isinstance<ModelPath>(path) ? path.cast<const ModelPath&>()
                                           : parse_model_path(to_path(path));
}

std::vector<ModelPath> to_model_paths(const py::object& paths) {
    if (is_one_path(paths))
        return {to_model_path(paths)};
    std::vector<ModelPath> list;
    for (const py::handle path : paths)
        list.push_back(to_model_path(path));
    return list;
}

std::vector<Scene> to_scenes(const py::object& models, const py::object& progress) {
    if (py::isinstance<Scene>(models))
        return {models.cast<Scene>()};
    if (is_one_path(models))
        return to_scenes(py::make_tuple(models), progress);
    std::vector<Scene> scenes;
    std::vector<ModelPath> paths; // of the scenes that are to be read
    std::vector<std::size_t> places;
    for (const py::handle model : models) {
        if (py::isinstance<Scene>(model)) {
            scenes.push_back(model.cast<const Scene&>());
            continue;
        }
        paths.push_back(to_model_path(model));
        places.push_back(scenes.size());
        scenes.emplace_back();
    }
    Work work(progress);
    auto read = work.run([&](const Progress& watched) {
        ReadOptions options;
        options.progress = watched;
        return read_scenes(paths, options);
    });
    for (std::size_t i = 0; i < places.size(); ++i)
        scenes[places[i]] = std::move(read[i]);
    return scenes;
}

void bind_scene(py::module_& module) {
    bind_parts(module);
    bind_properties(module);
    bind_scene_class(module);
    bind_readers(module);
    module.def(
        "to_mesh", [](const Scene& scene) { return to_mesh(scene); }, py::arg("scene"),
        "All parts of a scene as one Mesh in the world. Raises Error (bad_mesh) if there are too "
        "many vertices.");
    module.def("turn_up", &turn_up, py::arg("scene"), py::arg("up"),
               "Turns a scene by quarter turns, so that this axis points up.");
    module.def(
        "into_one_frame",
        [](std::vector<Scene> scenes) {
            into_one_frame(scenes);
            return scenes;
        },
        py::arg("scenes"),
        "Returns copies of the scenes, turned so that the axis points up that does in the first "
        "one.");
    module.def(
        "write_glb",
        [](const Scene& scene, const py::object& path) { write_glb(scene, to_path(path)); },
        py::arg("scene"), py::arg("path"),
        "Writes a scene as binary glTF. Raises Error (cannot_write).");
}

} // namespace abut::python
