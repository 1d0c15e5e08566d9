#pragma once

#include <abut/batch.h>
#include <abut/shapes.h>

#include "support/arguments.h"
#include "support/records.h"
#include "support/work.h"

/// What bindings of several headers share.
namespace abut::python {

/// The poses of both models, each one or many; one pose stands for all of the other's.
class PosePair {
public:
    PosePair(const Arguments& arguments, std::size_t place_a, std::size_t place_b)
        : a(to_poses(arguments[place_a], "pose_a")), b(to_poses(arguments[place_b], "pose_b")) {
        size.add(a.many, a.size(), "pose_a");
        size.add(b.many, b.size(), "pose_b");
    }
    [[nodiscard]] bool many() const noexcept { return size.many(); }
    [[nodiscard]] std::vector<Placement> placements() const {
        std::vector<Placement> list(size.size());
        for (std::size_t i = 0; i < list.size(); ++i)
            list[i] = {a.at(i), b.at(i)};
        return list;
    }

    PoseArgument a, b;
    BatchSize size;
};

/// Adds `work` fields to a record: the counters of rigid.h.
template <class T>
RecordBinder<T>& add_counters(RecordBinder<T>& record) {
    return record.field("counters", &T::counters, "Counters: the work that was done");
}

/// A Ray that a caller gave as such, or by origin and direction.
Ray to_ray(const py::object& origin, const py::object& direction, double t_min, double t_max);

/// Many answers of `collide`, bound in batch.cpp.
py::object contacts_of(std::vector<Contacts> contacts);
void bind_batch(py::module_& module);

/// Returns whether the first and the third argument are of this type.
template <class T>
bool both(PyObject* first, PyObject* third) {
    return is_a<T>(first) && is_a<T>(third);
}

py::object intersections(const std::vector<Intersection>& list);

} // namespace abut::python
