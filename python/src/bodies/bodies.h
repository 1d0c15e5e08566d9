#pragma once

#include <abut/world.h>

#include "bodies/surface.h"
#include "queries/queries.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace abut::python {

/// Ids of bodies are integers in Python: the index, and the generation above its 32 bits. A single id is an
/// abut.BodyId, an int that also knows its world. Arrays of ids, and the ids that filters are asked about,
/// are plain integers, which any world takes.
template <>
struct FieldFormat<BodyId> {
    static py::object make() { return py::dtype::of<std::int64_t>(); }
};

inline std::int64_t number_of(BodyId body) {
    return static_cast<std::int64_t>(std::uint64_t{body.generation} << 32 | body.index);
}

inline BodyId body_of(std::int64_t number) {
    const auto bits = static_cast<std::uint64_t>(number);
    return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

/// Adds the class of single ids.
void bind_body_id(py::module_& module);
/// Returns a new reference to an abut.BodyId, or null with an exception set.
PyObject* make_body_id(BodyId body);
/// The number of the world that an id was made by; 0 if the object is a plain integer.
std::uint32_t world_of(PyObject* id);
/// Frees what making the ids of a world needs. Ids that are still there know it all the same.
void forget_ids(std::uint32_t world);

} // namespace abut::python

namespace pybind11::detail {

template <>
struct type_caster<abut::BodyId> {
    PYBIND11_TYPE_CASTER(abut::BodyId, const_name("int"));
    bool load(handle source, bool /*convert*/) {
        // PyNumber_Index would copy an int of a subclass.
        const auto index = PyLong_Check(source.ptr())
                               ? reinterpret_borrow<object>(source)
                               : reinterpret_steal<object>(PyNumber_Index(source.ptr()));
        const std::int64_t number = index ? PyLong_AsLongLong(index.ptr()) : -1;
        if (PyErr_Occurred()) {
            PyErr_Clear();
            return false;
        }
        value = abut::python::body_of(number);
        value.world = abut::python::world_of(source.ptr());
        return true;
    }
    static handle cast(abut::BodyId body, return_value_policy /*policy*/, handle /*parent*/) {
        return abut::python::make_body_id(body);
    }
};

} // namespace pybind11::detail

namespace abut::python {

inline std::function<bool(BodyId, BodyId)> filter_of_bodies(Callback* callback) {
    if (!callback)
        return {};
    return [callback](BodyId a, BodyId b) {
        bool keep = false;
        callback->call([&](const py::object& function) {
            keep = to_bool(function(number_of(a), number_of(b)), "filter");
        });
        return keep;
    };
}

inline std::unique_ptr<Callback> body_callback(const py::object& filter) {
    if (filter.is_none())
        return nullptr;
    if (!PyCallable_Check(filter.ptr()))
        throw py::type_error("filter: a function of two bodies is wanted");
    return std::make_unique<Callback>(filter);
}

/// Calls use(shape) with a rigid shape of the type that a Python object has; nothing if it is none.
template <class Use>
auto try_rigid_shape(const py::object& shape, const Use& use)
    -> std::optional<decltype(use(std::declval<const Sphere&>()))> {
    if (const auto* model = peek<Model>(shape))
        return use(*model);
    if (const auto* convex = peek<Convex>(shape))
        return use(*convex);
    if (const auto* sphere = peek<Sphere>(shape))
        return use(*sphere);
    if (const auto* capsule = peek<Capsule>(shape))
        return use(*capsule);
    if (const auto* box = peek<Box3>(shape))
        return use(*box);
    if (const auto* cylinder = peek<Cylinder>(shape))
        return use(*cylinder);
    if (const auto* cone = peek<Cone>(shape))
        return use(*cone);
    if (const auto* ellipsoid = peek<Ellipsoid>(shape))
        return use(*ellipsoid);
    if (const auto* half_space = peek<HalfSpace>(shape))
        return use(*half_space);
    return std::nullopt;
}

[[noreturn]] inline void refuse_shape(const char* last) {
    throw py::type_error(
        std::string("shape: a Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid, ") +
        last + " is wanted");
}

/// As try_rigid_shape, but raises TypeError if it is none.
///
/// In          last: the last kinds that a caller accepts, for the message.
template <class Use>
auto with_rigid_shape(const py::object& shape, const char* last, const Use& use) {
    if (auto result = try_rigid_shape(shape, use))
        return std::move(*result);
    refuse_shape(last);
}

class Bodies;
void bind_compound(py::module_& module);
void bind_question_results(py::module_& module);
/// Adds the rays, overlaps and sweeps of a World.
void add_world_questions(py::class_<Bodies>& type);

/// A world that keeps its deformables, and is used by one thread at a time.
class Bodies {
public:
    Bodies(BroadPhaseMethod method, const py::object& filter)
        : filter_(body_callback(filter)),
          world_({.broad_phase = method, .filter = filter_of_bodies(filter_.get())}) {}
    ~Bodies() { forget_ids(number_); }
    Bodies(const Bodies&) = delete;
    Bodies& operator=(const Bodies&) = delete;

    /// Calls `use(world)` without the interpreter's lock.
    template <class Use>
    auto run(Use use) {
        const InUse::Change change(use_, kName);
        const auto surfaces = read_surfaces();
        if constexpr (std::is_void_v<decltype(use(world_))>) {
            {
                const py::gil_scoped_release unlocked;
                use(world_);
            }
            check_filter();
        } else {
            auto result = [&] {
                const py::gil_scoped_release unlocked;
                return use(world_);
            }();
            check_filter();
            return result;
        }
    }
    /// Runs a query that can be long: with progress, and stopped by Ctrl-C.
    template <class Query>
    auto query(const py::object& report, Query query) {
        const InUse::Change change(use_, kName);
        const auto surfaces = read_surfaces();
        Work work(report);
        auto result = work.run([&](const Progress& progress) { return query(world_, progress); });
        check_filter();
        return result;
    }
    /// Calls `use(world)` at once: for what is short and calls no filter.
    template <class Use>
    auto quick(Use use) {
        const InUse::Change change(use_, kName);
        return use(world_);
    }

    BodyId add(const py::object& shape, const py::object& pose, const BodyOptions& options) {
        const BodyId body = add_shape(shape, pose, options);
        number_ = body.world;
        return body;
    }
    void move(const py::object& body, const py::object& pose) {
        if (!is_array(body) || py::reinterpret_borrow<py::array>(body).ndim() == 0) {
            const auto id = body.cast<BodyId>();
            const Pose place = to_pose(pose, "pose");
            return quick([&](World& world) { world.move(id, place); });
        }
        if (const char kind = py::reinterpret_borrow<py::array>(body).dtype().kind();
            kind != 'i' && kind != 'u')
            throw py::type_error("body: an array of integers is wanted");
        // Without gaps, whatever strides the caller's array has.
        const auto ids =
            py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(body);
        const auto places = to_pose_list(pose, "pose");
        if (!ids || ids.ndim() != 1 || static_cast<std::size_t>(ids.size()) != places.size())
            throw py::value_error("body: there are not as many bodies as poses");
        run([&](World& world) {
            for (std::size_t i = 0; i < places.size(); ++i)
                world.move(body_of(ids.data()[i]), places[i]);
        });
    }
    void remove(BodyId body) {
        quick([&](World& world) { world.remove(body); });
        surfaces_.erase(body);
    }

private:
    static constexpr const char* kName = "the world";

    BodyId add_shape(const py::object& shape, const py::object& pose, const BodyOptions& options) {
        if (auto* surface = const_cast<Surface*>(peek<Surface>(shape))) {
            if (!pose.is_none())
                throw py::value_error("pose: a deformable has none");
            const InUse::Change change(use_, kName);
            const InUse::Read read(surface->use, "a deformable");
            const BodyId body = world_.add(surface->value, options);
            surfaces_[body] = shape;
            return body;
        }
        const Pose place = to_pose(pose, "pose");
        const auto add = [&](const auto& known) {
            return quick([&](World& world) { return world.add(known, place, options); });
        };
        if (const auto body = try_rigid_shape(shape, add))
            return *body;
        if (const auto* compound = peek<Compound>(shape))
            return add(*compound);
        if (const auto* pieces = peek<ConvexPieces>(shape))
            return add(*pieces);
        refuse_shape("HalfSpace, Compound, ConvexPieces or Deformable");
    }

    [[nodiscard]] std::vector<InUse::Read> read_surfaces() {
        std::vector<InUse::Read> list;
        for (const auto& [body, surface] : surfaces_)
            list.emplace_back(surface.cast<Surface&>().use, "a deformable");
        return list;
    }
    void check_filter() {
        if (filter_)
            filter_->raise();
    }

    std::unique_ptr<Callback> filter_;
    std::map<BodyId, py::object> surfaces_; ///< outlive the world
    World world_;
    InUse use_;
    std::uint32_t number_ = 0; ///< of the world; 0 before it has a body
};

} // namespace abut::python
