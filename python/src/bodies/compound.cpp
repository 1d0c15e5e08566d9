#include <abut/compound.h>

#include "bodies/bodies.h"
#include "module.h"

#include <vector>

namespace abut::python {

namespace {

RigidShape rigid_shape(const py::object& shape) {
    return with_rigid_shape(shape, "HalfSpace",
                            [](const auto& rigid) { return RigidShape(rigid); });
}

Compound compound_of(const py::object& pieces) {
    if (const auto* solid = peek<ConvexPieces>(pieces)) {
        const py::gil_scoped_release unlocked;
        return {*solid};
    }
    std::vector<Compound::Piece> list;
    for (const py::handle item : pieces) {
        const auto piece = py::reinterpret_borrow<py::object>(item);
        if (!py::isinstance<py::tuple>(piece)) {
            list.push_back({rigid_shape(piece), {}});
            continue;
        }
        const auto parts = py::reinterpret_borrow<py::tuple>(piece);
        if (parts.size() != 2)
            throw py::value_error("pieces: a shape, or a shape and its pose, is wanted");
        list.push_back({rigid_shape(parts[0]), to_pose(parts[1], "pieces")});
    }
    const py::gil_scoped_release unlocked;
    return Compound(list);
}

} // namespace

void bind_compound(py::module_& module) {
    py::class_<Compound>(
        module, "Compound",
        "Compound(pieces)\n\n"
        "Several rigid shapes that move as one body of a World.\n\n"
        "pieces  a list of shapes, each alone or as (shape, pose) in the compound's frame; or a "
        "ConvexPieces\n\n"
        "Raises Error (bad_argument) if there is no piece; the message names a piece that is not "
        "valid.")
        .def(py::init(&compound_of), py::arg("pieces"))
        .def("__len__", &Compound::size)
        .def("__repr__", [](const Compound& self) {
            return "<abut.Compound: " + std::to_string(self.size()) + " pieces>";
        });
}

} // namespace abut::python
