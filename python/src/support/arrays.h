#pragma once

#include <abut/motion.h>
#include <abut/types.h>

#include "support/python.h"

#include <cstdint>
#include <string>
#include <vector>

/// Arguments of Python as values of C++, and back. A wrong shape is a ValueError, a wrong type a
/// TypeError.
namespace abut::python {

/// Returns whether the object is a numpy array.
bool is_array(py::handle object);
/// The object as an array of doubles; `name` stands in the message of an error.
py::array_t<double> double_array(py::handle object, const char* name);

double to_double(py::handle object, const char* name);
bool to_bool(py::handle object, const char* name);
Vec3 to_vec3(py::handle object, const char* name);
/// From an array of shape (n, 3).
std::vector<Vec3> to_points(py::handle object, const char* name);
/// From an array of integers of shape (n, columns), each at least 0 and below 2^32; negative and
/// larger ones are an Error{bad_mesh}, as are those of triangles.
std::vector<std::array<std::uint32_t, 3>> to_triangles(py::handle object, std::size_t vertices);
/// From any sequence of integers.
std::vector<std::uint32_t> to_indices(py::handle object, const char* name);

/// A pose or many of them.
struct PoseArgument {
    bool many = false;
    Transform one;
    /// If many, the poses are in one of these two. An array of matrices is not copied: with the copy,
    /// a call of thousands of queries frees more memory than glibc keeps, and the next one pays for
    /// mapping it anew.
    py::object matrices;
    std::vector<Transform> list;
    const char* name = ""; ///< of the argument, for errors

    [[nodiscard]] std::size_t size() const;
    /// Raises ValueError if the last row of the matrix is not 0 0 0 1. With the interpreter's lock.
    [[nodiscard]] Transform at(std::size_t index) const;
};

/// From None (where the model is), a Pose, (translation, quaternion) or a matrix of shape (4, 4).
Transform to_transform(py::handle object, const char* name);
/// From all of these, or an array of shape (n, 4, 4), (translations, quaternions) of shapes (n, 3) and
/// (n, 4), or a list of poses.
PoseArgument to_poses(py::handle object, const char* name);
/// From the same, for what takes rigid poses only: a matrix must be a rotation and a translation, to
/// 1e-6.
Pose to_pose(py::handle object, const char* name);
std::vector<Pose> to_pose_list(py::handle object, const char* name);

/// A point or many of them.
struct PointArgument {
    bool many = false;
    Vec3 one;
    std::vector<Vec3> list; ///< if many

    [[nodiscard]] const Vec3& at(std::size_t index) const { return many ? list[index] : one; }
};

/// From an array of shape (3,) or (n, 3).
PointArgument to_point_or_points(py::handle object, const char* name);

py::array from_vec3(const Vec3& vector);
/// The matrix of shape (4, 4).
py::array from_transform(const Transform& transform);

/// An array that owns the vector's memory.
template <class T>
py::array own(std::vector<T> values, const py::dtype& type, std::vector<py::ssize_t> shape) {
    auto kept = std::make_unique<std::vector<T>>(std::move(values));
    const void* data = kept->data();
    py::capsule owner(kept.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    (void)kept.release();
    return {type, std::move(shape), data, owner};
}

/// An array of numbers.
template <class T>
py::array numbers(std::vector<T> values) {
    const auto size = static_cast<py::ssize_t>(values.size());
    return own(std::move(values), py::dtype::of<T>(), {size});
}

/// An array of shape (n, columns) of structs that hold so many numbers and nothing else.
template <class Number, class Row>
py::array rows(std::vector<Row> values) {
    constexpr std::size_t kColumns = sizeof(Row) / sizeof(Number);
    static_assert(sizeof(Row) == kColumns * sizeof(Number));
    const auto size = static_cast<py::ssize_t>(values.size());
    return own(std::move(values), py::dtype::of<Number>(), {size, kColumns});
}

inline py::array from_points(std::vector<Vec3> points) {
    return rows<double>(std::move(points));
}

/// A view, that cannot be written to, of rows that `owner` keeps.
template <class Number, class Row>
py::array view_rows(const Row* data, std::size_t size, py::handle owner) {
    constexpr std::size_t kColumns = sizeof(Row) / sizeof(Number);
    static_assert(sizeof(Row) == kColumns * sizeof(Number));
    py::array array(
        py::dtype::of<Number>(),
        {static_cast<py::ssize_t>(size), static_cast<py::ssize_t>(kColumns)},
        {static_cast<py::ssize_t>(sizeof(Row)), static_cast<py::ssize_t>(sizeof(Number))}, data,
        owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

/// An array of booleans.
py::array booleans(const std::vector<bool>& values);

} // namespace abut::python

namespace pybind11::detail {

template <>
struct type_caster<abut::Vec3> {
    PYBIND11_TYPE_CASTER(abut::Vec3, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        value = abut::python::to_vec3(source, "point");
        return true;
    }
    static handle cast(const abut::Vec3& vector, return_value_policy /*policy*/,
                       handle /*parent*/) {
        return abut::python::from_vec3(vector).release();
    }
};

template <>
struct type_caster<abut::Transform> {
    PYBIND11_TYPE_CASTER(abut::Transform, const_name("numpy.ndarray"));
    bool load(handle source, bool /*convert*/) {
        value = abut::python::to_transform(source, "pose");
        return true;
    }
    static handle cast(const abut::Transform& transform, return_value_policy /*policy*/,
                       handle /*parent*/) {
        return abut::python::from_transform(transform).release();
    }
};

} // namespace pybind11::detail
