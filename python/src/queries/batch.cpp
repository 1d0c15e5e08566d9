#include <abut/batch.h>

#include "module.h"
#include "queries/queries.h"

namespace abut::python {

namespace {

/// Many answers of `collide`.
struct ContactsList {
    std::vector<Contacts> list;

    [[nodiscard]] const Contacts& at(py::ssize_t index) const {
        const auto size = static_cast<py::ssize_t>(list.size());
        if (index < -size || index >= size)
            throw py::index_error();
        return list[static_cast<std::size_t>(index < 0 ? index + size : index)];
    }
};

py::array all_pairs(const ContactsList& contacts) {
    std::vector<TrianglePair> pairs;
    for (const Contacts& one : contacts.list)
        pairs.insert(pairs.end(), one.pairs.begin(), one.pairs.end());
    return rows<std::uint32_t>(std::move(pairs));
}

py::array ends(const ContactsList& contacts) {
    std::vector<std::int64_t> offsets{0};
    for (const Contacts& one : contacts.list)
        offsets.push_back(offsets.back() + static_cast<std::int64_t>(one.pairs.size()));
    return numbers(std::move(offsets));
}

py::array which_meet(const ContactsList& contacts) {
    std::vector<bool> meet;
    meet.reserve(contacts.list.size());
    for (const Contacts& one : contacts.list)
        meet.push_back(one.meet());
    return booleans(meet);
}

} // namespace

py::object contacts_of(std::vector<Contacts> contacts) {
    return py::cast(ContactsList{std::move(contacts)});
}

py::object intersections(const std::vector<Intersection>& list) {
    py::list polygons;
    for (const Intersection& one : list)
        polygons.append(from_points({one.corners.begin(), one.corners.begin() + one.count}));
    return polygons;
}

void bind_batch(py::module_& module) {
    py::class_<ContactsList>(module, "ContactsList",
                             "Returned by collide for many poses: a sequence of Contacts.")
        .def_property_readonly("meet", &which_meet, "array of bool of shape (n,)")
        .def_property_readonly("pairs", &all_pairs,
                               "uint32 array of shape (m, 2): the pairs of all poses")
        .def_property_readonly(
            "offsets", &ends,
            "int64 array of shape (n + 1,): those of pose i are pairs[offsets[i]:offsets[i + 1]]")
        .def("__len__", [](const ContactsList& contacts) { return contacts.list.size(); })
        .def("__getitem__", &ContactsList::at, py::return_value_policy::reference_internal)
        .def("__repr__", [](const ContactsList& contacts) {
            std::size_t meet = 0;
            for (const Contacts& one : contacts.list)
                meet += one.meet();
            return "<abut.ContactsList: " + std::to_string(contacts.list.size()) + " poses, " +
                   std::to_string(meet) + " meet>";
        });
}

} // namespace abut::python
