#include "support/arrays.h"

#include <abut/error.h>

#include <cmath>
#include <cstring>

namespace abut::python {

namespace {

constexpr int kNumpyDouble = 12; // NPY_DOUBLE

[[noreturn]] void wrong_shape(const char* name, const std::string& wanted, const py::array& array) {
    std::string shape = "(";
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        shape += (i ? ", " : "") + std::to_string(array.shape(i));
    throw py::value_error(std::string(name) + ": an array of shape " + wanted + " is wanted, not " +
                          shape + ")");
}

/// The array's memory, if it is one of doubles that can be read as they lie; else null.
const char* aligned_doubles(py::handle object) {
    if (!is_array(object))
        return nullptr;
    const auto* array = py::detail::array_proxy(object.ptr());
    const auto* type = py::detail::array_descriptor_proxy(array->descr);
    constexpr int kAligned = py::detail::npy_api::NPY_ARRAY_ALIGNED_;
    if (type->type_num != kNumpyDouble || type->byteorder == '>' || !(array->flags & kAligned))
        return nullptr;
    return array->data;
}

double load(const char* address) {
    double value = 0;
    std::memcpy(&value, address, sizeof value);
    return value;
}

/// Errors: ValueError, for a value that would otherwise be blamed on the form of the matrix.
void require_finite(double value, const char* name) {
    if (!std::isfinite(value))
        throw py::value_error(std::string(name) + ": the matrix has a value that is not finite");
}

/// One matrix of an array; `row` and `column` are its strides.
Transform read_matrix(const char* data, py::ssize_t row, py::ssize_t column, const char* name) {
    Transform transform;
    for (py::ssize_t j = 0; j < 4; ++j)
        for (py::ssize_t i = 0; i < 3; ++i)
            transform.m[static_cast<std::size_t>(3 * j + i)] = load(data + i * row + j * column);
    const char* last = data + 3 * row;
    if (load(last) != 0 || load(last + column) != 0 || load(last + 2 * column) != 0 ||
        load(last + 3 * column) != 1) {
        for (py::ssize_t j = 0; j < 4; ++j)
            require_finite(load(last + j * column), name);
        throw py::value_error(std::string(name) + ": the last row of a matrix must be 0 0 0 1");
    }
    return transform;
}

bool is_pair(py::handle object) {
    return PyTuple_Check(object.ptr()) && PyTuple_GET_SIZE(object.ptr()) == 2;
}

Pose read_pose(const double* translation, const double* quaternion) {
    return {{translation[0], translation[1], translation[2]},
            {quaternion[0], quaternion[1], quaternion[2], quaternion[3]}};
}

/// The poses that (translations, quaternions) tell, of which each may be one for all.
std::vector<Pose> read_pairs(py::handle pair, bool& many, const char* name) {
    const auto translation = double_array(PyTuple_GET_ITEM(pair.ptr(), 0), name);
    const auto quaternion = double_array(PyTuple_GET_ITEM(pair.ptr(), 1), name);
    if (translation.ndim() < 1 || translation.ndim() > 2 ||
        translation.shape(translation.ndim() - 1) != 3)
        wrong_shape(name, "(3,) or (n, 3) for translations", translation);
    if (quaternion.ndim() < 1 || quaternion.ndim() > 2 ||
        quaternion.shape(quaternion.ndim() - 1) != 4)
        wrong_shape(name, "(4,) or (n, 4) for quaternions (w, x, y, z)", quaternion);
    const bool many_t = translation.ndim() == 2, many_q = quaternion.ndim() == 2;
    many = many_t || many_q;
    if (many_t && many_q && translation.shape(0) != quaternion.shape(0))
        throw py::value_error(std::string(name) + ": there are " +
                              std::to_string(translation.shape(0)) + " translations and " +
                              std::to_string(quaternion.shape(0)) + " quaternions");
    const auto count = many_t ? translation.shape(0) : many_q ? quaternion.shape(0) : 1;
    std::vector<Pose> poses;
    poses.reserve(static_cast<std::size_t>(count));
    for (py::ssize_t i = 0; i < count; ++i)
        poses.push_back(read_pose(translation.data() + (many_t ? 3 * i : 0),
                                  quaternion.data() + (many_q ? 4 * i : 0)));
    return poses;
}

/// A unit quaternion of a matrix that is a rotation.
Pose rigid(const Transform& transform, const char* name) {
    const auto& m = transform.m;
    const auto column = [&m](std::size_t j) { return Vec3{m[3 * j], m[3 * j + 1], m[3 * j + 2]}; };
    const auto dot = [](const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const Vec3 x = column(0), y = column(1), z = column(2);
    const Vec3 cross{x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x};
    constexpr double kTolerance = 1e-6;
    const bool rotation =
        std::abs(dot(x, x) - 1) < kTolerance && std::abs(dot(y, y) - 1) < kTolerance &&
        std::abs(dot(x, y)) < kTolerance && std::abs(cross.x - z.x) < kTolerance &&
        std::abs(cross.y - z.y) < kTolerance && std::abs(cross.z - z.z) < kTolerance;
    if (!rotation) {
        for (std::size_t i = 0; i < 9; ++i)
            require_finite(m[i], name);
        throw py::value_error(std::string(name) +
                              ": the matrix must be a rotation and a translation");
    }
    // [Shepperd 1978]: the largest component is the one that is divided by.
    const double r00 = x.x, r10 = x.y, r20 = x.z, r01 = y.x, r11 = y.y, r21 = y.z, r02 = z.x,
                 r12 = z.y, r22 = z.z;
    std::array<double, 4> q{};
    if (const double trace = r00 + r11 + r22; trace > 0)
        q = {1 + trace, r21 - r12, r02 - r20, r10 - r01};
    else if (r00 >= r11 && r00 >= r22)
        q = {r21 - r12, 1 + r00 - r11 - r22, r01 + r10, r02 + r20};
    else if (r11 >= r22)
        q = {r02 - r20, r01 + r10, 1 - r00 + r11 - r22, r12 + r21};
    else
        q = {r10 - r01, r02 + r20, r12 + r21, 1 - r00 - r11 + r22};
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& value : q)
        value /= length;
    return {{m[9], m[10], m[11]}, q};
}

} // namespace

bool is_array(py::handle object) {
    return py::isinstance<py::array>(object);
}

py::array_t<double> double_array(py::handle object, const char* name) {
    if (!is_array(object) || py::reinterpret_borrow<py::array>(object).dtype().kind() != 'c')
        if (auto array =
                py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object))
            return array;
    PyErr_Clear();
    throw py::type_error(std::string(name) + ": an array of numbers is wanted");
}

double to_double(py::handle object, const char* name) {
    const double value = PyFloat_AsDouble(object.ptr());
    if (value == -1 && PyErr_Occurred()) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": a number is wanted");
    }
    return value;
}

bool to_bool(py::handle object, const char* name) {
    const int value = PyObject_IsTrue(object.ptr());
    if (value < 0) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": True or False is wanted");
    }
    return value != 0;
}

Vec3 to_vec3(py::handle object, const char* name) {
    if (const char* data = aligned_doubles(object)) {
        const auto* array = py::detail::array_proxy(object.ptr());
        if (array->nd == 1 && array->dimensions[0] == 3) {
            const py::ssize_t stride = array->strides[0];
            return {load(data), load(data + stride), load(data + 2 * stride)};
        }
    }
    const auto array = double_array(object, name);
    if (array.ndim() != 1 || array.shape(0) != 3)
        wrong_shape(name, "(3,)", array);
    return {array.at(0), array.at(1), array.at(2)};
}

std::vector<Vec3> to_points(py::handle object, const char* name) {
    // One copy, from whatever type and order the array has.
    const auto source = py::reinterpret_steal<py::array>(
        is_array(object) ? py::reinterpret_borrow<py::object>(object).release()
                         : py::array::ensure(object).release());
    if (!source) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": an array of numbers is wanted");
    }
    if (source.ndim() == 1 && source.shape(0) == 0)
        return {};
    if (source.ndim() != 2 || source.shape(1) != 3)
        wrong_shape(name, "(n, 3)", source);
    std::vector<Vec3> points(static_cast<std::size_t>(source.shape(0)));
    const auto fill = [&]<class Number>(Number /*type*/) {
        const char* data = static_cast<const char*>(source.data());
        const py::ssize_t row = source.strides(0), column = source.strides(1);
        for (Vec3& point : points) {
            Number values[3];
            for (int i = 0; i < 3; ++i)
                std::memcpy(&values[i], data + i * column, sizeof(Number));
            point = {static_cast<double>(values[0]), static_cast<double>(values[1]),
                     static_cast<double>(values[2])};
            data += row;
        }
    };
    const auto type = source.dtype();
    if (type.is(py::dtype::of<double>()))
        fill(double{});
    else if (type.is(py::dtype::of<float>()))
        fill(float{});
    else {
        const auto doubles = double_array(source, name);
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] = {doubles.data()[3 * i], doubles.data()[3 * i + 1],
                         doubles.data()[3 * i + 2]};
    }
    return points;
}

std::vector<std::array<std::uint32_t, 3>> to_triangles(py::handle object, std::size_t vertices) {
    const auto source = py::array::ensure(object);
    if (!source) {
        PyErr_Clear();
        throw py::type_error("faces: an array of integers is wanted");
    }
    if (source.ndim() == 1 && source.shape(0) == 0)
        return {};
    if (source.ndim() != 2 || source.shape(1) != 3)
        wrong_shape("faces", "(n, 3)", source);
    std::vector<std::array<std::uint32_t, 3>> triangles(static_cast<std::size_t>(source.shape(0)));
    const auto fill = [&]<class Number>(Number /*type*/, const py::array& array) {
        const char* data = static_cast<const char*>(array.data());
        const py::ssize_t row = array.strides(0), column = array.strides(1);
        for (std::size_t t = 0; t < triangles.size(); ++t, data += row)
            for (std::size_t i = 0; i < 3; ++i) {
                Number value;
                std::memcpy(&value, data + static_cast<py::ssize_t>(i) * column, sizeof value);
                if (std::cmp_less(value, 0) || std::cmp_greater_equal(value, vertices))
                    throw Error(ErrorCode::bad_mesh, "triangle " + std::to_string(t) +
                                                         " has vertex " + std::to_string(value) +
                                                         ", but there are " +
                                                         std::to_string(vertices) + " vertices");
                triangles[t][i] = static_cast<std::uint32_t>(value);
            }
    };
    const auto type = source.dtype();
    if (type.is(py::dtype::of<std::int32_t>()))
        fill(std::int32_t{}, source);
    else if (type.is(py::dtype::of<std::uint32_t>()))
        fill(std::uint32_t{}, source);
    else if (type.is(py::dtype::of<std::int64_t>()))
        fill(std::int64_t{}, source);
    else if (type.is(py::dtype::of<std::uint64_t>()))
        fill(std::uint64_t{}, source);
    else if (type.kind() == 'i' || type.kind() == 'u')
        fill(std::int64_t{}, source.attr("astype")("int64"));
    else
        throw py::type_error("faces: an array of integers is wanted");
    return triangles;
}

std::vector<std::uint32_t> to_indices(py::handle object, const char* name) {
    const auto source = py::array::ensure(object);
    if (!source ||
        (source.size() && source.dtype().kind() != 'i' && source.dtype().kind() != 'u')) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": an array of integers is wanted");
    }
    if (source.ndim() != 1)
        wrong_shape(name, "(n,)", source);
    std::vector<std::uint32_t> indices;
    const auto wide = py::array_t<std::int64_t>::ensure(source);
    for (py::ssize_t i = 0; i < wide.size(); ++i) {
        const std::int64_t value = wide.at(i);
        if (value < 0 || value > 0xffffffff)
            throw py::value_error(std::string(name) + ": " + std::to_string(value) +
                                  " is no index");
        indices.push_back(static_cast<std::uint32_t>(value));
    }
    return indices;
}

Transform to_transform(py::handle object, const char* name) {
    auto poses = to_poses(object, name);
    if (poses.many)
        throw py::value_error(std::string(name) + ": one pose is wanted, not many");
    return poses.one;
}

std::size_t PoseArgument::size() const {
    if (!matrices)
        return list.size();
    return static_cast<std::size_t>(py::detail::array_proxy(matrices.ptr())->dimensions[0]);
}

Transform PoseArgument::at(std::size_t index) const {
    if (!many)
        return one;
    if (!matrices)
        return list[index];
    const auto* array = py::detail::array_proxy(matrices.ptr());
    return read_matrix(array->data + static_cast<py::ssize_t>(index) * array->strides[0],
                       array->strides[1], array->strides[2], name);
}

PoseArgument to_poses(py::handle object, const char* name) {
    if (object.is_none())
        return {};
    PoseArgument result;
    result.name = name;
    if (const char* data = aligned_doubles(object)) {
        const auto* array = py::detail::array_proxy(object.ptr());
        if (array->nd == 2 && array->dimensions[0] == 4 && array->dimensions[1] == 4) {
            result.one = read_matrix(data, array->strides[0], array->strides[1], name);
            return result;
        }
        if (array->nd == 3 && array->dimensions[1] == 4 && array->dimensions[2] == 4) {
            result.many = true;
            result.matrices = py::reinterpret_borrow<py::object>(object);
            return result;
        }
    }
    if (py::isinstance<Pose>(object)) {
        result.one = Transform(object.cast<const Pose&>());
        return result;
    }
    if (is_pair(object)) {
        const auto poses = read_pairs(object, result.many, name);
        if (result.many)
            result.list.assign(poses.begin(), poses.end());
        else
            result.one = Transform(poses.front());
        return result;
    }
    if (PyList_Check(object.ptr()) && PyList_GET_SIZE(object.ptr()) > 0 &&
        (py::isinstance<Pose>(PyList_GET_ITEM(object.ptr(), 0)) ||
         is_pair(PyList_GET_ITEM(object.ptr(), 0)))) {
        result.many = true;
        for (const py::handle item : object)
            result.list.push_back(to_transform(item, name));
        return result;
    }
    const auto array = double_array(object, name);
    const bool matrix = array.ndim() == 2 && array.shape(0) == 4 && array.shape(1) == 4;
    const bool matrices = array.ndim() == 3 && array.shape(1) == 4 && array.shape(2) == 4;
    if (!matrix && !matrices)
        wrong_shape(name, "(4, 4) or (n, 4, 4), a Pose or (translation, quaternion)", array);
    return to_poses(array, name);
}

Pose to_pose(py::handle object, const char* name) {
    if (object.is_none())
        return {};
    if (py::isinstance<Pose>(object))
        return object.cast<const Pose&>();
    if (is_pair(object)) {
        bool many = false;
        const auto poses = read_pairs(object, many, name);
        if (many)
            throw py::value_error(std::string(name) + ": one pose is wanted, not many");
        return poses.front();
    }
    return rigid(to_transform(object, name), name);
}

std::vector<Pose> to_pose_list(py::handle object, const char* name) {
    std::vector<Pose> list;
    if (is_pair(object)) {
        bool many = false;
        return read_pairs(object, many, name);
    }
    if (PyList_Check(object.ptr())) {
        for (const py::handle item : object)
            list.push_back(to_pose(item, name));
        return list;
    }
    const auto poses = to_poses(object, name);
    if (!poses.many)
        throw py::value_error(std::string(name) +
                              ": many poses are wanted, as an array of shape (n, 4, 4)");
    for (std::size_t i = 0; i < poses.size(); ++i)
        list.push_back(rigid(poses.at(i), name));
    return list;
}

PointArgument to_point_or_points(py::handle object, const char* name) {
    PointArgument result;
    if (const char* data = aligned_doubles(object)) {
        const auto* array = py::detail::array_proxy(object.ptr());
        if (array->nd == 1 && array->dimensions[0] == 3) {
            const py::ssize_t stride = array->strides[0];
            result.one = {load(data), load(data + stride), load(data + 2 * stride)};
            return result;
        }
    }
    const auto array = py::array::ensure(object);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": an array of numbers is wanted");
    }
    if (array.ndim() == 1 && array.shape(0) == 3) {
        result.one = to_vec3(array, name);
        return result;
    }
    if (array.ndim() != 2 || array.shape(1) != 3)
        wrong_shape(name, "(3,) or (n, 3)", array);
    result.many = true;
    result.list = to_points(array, name);
    return result;
}

py::array from_vec3(const Vec3& vector) {
    return py::array_t<double>(3, &vector.x);
}

py::array from_transform(const Transform& transform) {
    py::array_t<double> matrix({4, 4});
    auto values = matrix.mutable_unchecked<2>();
    for (py::ssize_t j = 0; j < 4; ++j) {
        for (py::ssize_t i = 0; i < 3; ++i)
            values(i, j) = transform.m[static_cast<std::size_t>(3 * j + i)];
        values(3, j) = j == 3;
    }
    return matrix;
}

py::array booleans(const std::vector<bool>& values) {
    py::array_t<bool> array(static_cast<py::ssize_t>(values.size()));
    bool* data = array.mutable_data();
    for (std::size_t i = 0; i < values.size(); ++i)
        data[i] = values[i];
    return array;
}

} // namespace abut::python
