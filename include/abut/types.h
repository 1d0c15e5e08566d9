#pragma once

#if !(__cplusplus >= 202002L || (defined _MSVC_LANG && _MSVC_LANG >= 202002L))
#error "Abut needs C++20: compile with -std=c++20, or set CMAKE_CXX_STANDARD to 20."
#endif

#include <array>
#include <cstdint>
#include <limits>

namespace abut {

/// A point or a vector, in the model's units. abut/vector.h has products and lengths.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr Vec3() = default;
    /// All three or none: so `Sphere{0.5}` is an error, and not a point at x = 0.5.
    constexpr Vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}

    friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend constexpr Vec3 operator*(const Vec3& a, double s) { return s * a; }
    friend constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
    constexpr Vec3& operator+=(const Vec3& a) { return *this = *this + a; }
    constexpr Vec3& operator-=(const Vec3& a) { return *this = *this - a; }
    constexpr Vec3& operator*=(double s) { return *this = s * *this; }
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Closed axis-aligned box. The default box is empty: `lower > upper`.
struct Box3 {
    Vec3 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
               std::numeric_limits<double>::infinity()};
    Vec3 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity()};
    friend bool operator==(const Box3&, const Box3&) = default;
};

/// A rigid pose: x_world = R(rotation) x_model + translation.
///
/// The quaternion (w, x, y, z) need not be of unit length. Using one of zero length is an Error.
struct Pose {
    Vec3 translation;
    std::array<double, 4> rotation{1, 0, 0, 0};
};

/// An affine map: the upper three rows of a 4x4 matrix in column-major order, as in glTF:
///
///     x' = m[0] x + m[3] y + m[6] z + m[9]
///     y' = m[1] x + m[4] y + m[7] z + m[10]
///     z' = m[2] x + m[5] y + m[8] z + m[11]
///
/// Every query uses the positions that this formula gives, evaluated from left to right in double
/// precision without fused operations. "Exact" means exact for those positions.
struct Transform {
    std::array<double, 12> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

    Transform() = default;
    explicit Transform(const std::array<double, 12>& values) : m(values) {}
    /// Errors      Error{bad_argument} if the quaternion has zero length or a value is not finite.
    Transform(
        const Pose& pose); // NOLINT: a pose is a transform; the conversion is meant to be silent.

    friend bool operator==(const Transform&, const Transform&) = default;
};

/// The points that two triangles share: the corners of a convex polygon, in order.
struct Intersection {
    std::array<Vec3, 6> corners;
    std::uint32_t count = 0; ///< 1: a point; 2: a segment; 3 to 6: coplanar triangles
};

/// The feature of a triangle that a point lies on.
enum class Feature : std::uint8_t { vertex, edge, face };

/// What a result guarantees about its numbers.
enum class Status : std::uint8_t {
    exact,      ///< the answer for the given positions, with numbers to double rounding
    converged,  ///< the answer within the error that was allowed
    bound_only, ///< the numbers are a proven bound of the answer
};

} // namespace abut
