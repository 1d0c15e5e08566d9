#include "simulator/mass.h"

#include <abut/error.h>

#include <numbers>

namespace simulation {

namespace {

Matrix diagonal(double x, double y, double z) {
    return {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
}

} // namespace

Mass mass_of(const abut::Sphere& sphere, double density) {
    const double r = sphere.radius, mass = density * 4 / 3 * std::numbers::pi * r * r * r;
    return {mass, sphere.centre, 0.4 * mass * r * r * Matrix{}};
}

Mass mass_of(const abut::Capsule& capsule, double density) {
    const Vec3 axis = capsule.axis.b - capsule.axis.a;
    const double r = capsule.radius, l = length(axis);
    const double rod = density * std::numbers::pi * r * r * l,
                 ends = density * 4 / 3 * std::numbers::pi * r * r * r;
    // A cylinder and two half balls, whose centres of mass lie 3/8 r beyond its ends.
    const double along = rod * r * r / 2 + 0.4 * ends * r * r;
    const double sideways =
        rod * (3 * r * r + l * l) / 12 + ends * (0.4 * r * r + l * l / 4 + 3 * r * l / 8);
    Matrix inertia = sideways * Matrix{};
    if (l > 0)
        inertia = inertia + (along - sideways) * outer_square((1 / l) * axis);
    return {rod + ends, 0.5 * (capsule.axis.a + capsule.axis.b), inertia};
}

Mass mass_of(const abut::Box3& box, double density) {
    const Vec3 d = box.upper - box.lower;
    const double mass = density * d.x * d.y * d.z, k = mass / 12;
    const Vec3 squares{d.x * d.x, d.y * d.y, d.z * d.z};
    return {mass, 0.5 * (box.lower + box.upper),
            k * diagonal(squares.y + squares.z, squares.z + squares.x, squares.x + squares.y)};
}

Mass mass_of(const abut::Cylinder& cylinder, double density) {
    const Vec3 axis = cylinder.axis.b - cylinder.axis.a;
    const double r = cylinder.radius, l = length(axis);
    const double mass = density * std::numbers::pi * r * r * l;
    const double along = mass * r * r / 2, sideways = mass * (3 * r * r + l * l) / 12;
    Matrix inertia = sideways * Matrix{};
    if (l > 0)
        inertia = inertia + (along - sideways) * outer_square((1 / l) * axis);
    return {mass, 0.5 * (cylinder.axis.a + cylinder.axis.b), inertia};
}

Mass mass_of(const abut::Cone& cone, double density) {
    const Vec3 axis = cone.apex - cone.base;
    const double r = cone.radius, l = length(axis);
    const double mass = density * std::numbers::pi * r * r * l / 3;
    // Its centre of mass lies a quarter of the way from the base to the apex.
    const double along = 0.3 * mass * r * r,
                 sideways = 0.15 * mass * r * r + 3.0 / 80 * mass * l * l;
    Matrix inertia = sideways * Matrix{};
    if (l > 0)
        inertia = inertia + (along - sideways) * outer_square((1 / l) * axis);
    return {mass, cone.base + 0.25 * axis, inertia};
}

/// The sum over the tetrahedra between a point and each triangle, with the sign of their volumes.
/// Of a tetrahedron with one corner at the origin and the others a, b, c:
///
///     6 V = a . (b x c)      centre = (a + b + c) / 4
///     integral of x x^T = V / 20 (a a^T + b b^T + c c^T + s s^T)      s = a + b + c
Mass mass_of(const abut::Mesh& mesh, double density) {
    double volume = 0; // six times
    Vec3 moment;       // 24 times
    Matrix second = kZeroMatrix;
    const Vec3 start = mesh.positions.empty() ? Vec3{} : mesh.positions[0];
    for (const auto& corners : mesh.triangles) {
        const Vec3 a = mesh.positions.at(corners[0]) - start,
                   b = mesh.positions.at(corners[1]) - start,
                   c = mesh.positions.at(corners[2]) - start;
        const double part = dot(a, cross(b, c));
        const Vec3 sum = a + b + c;
        volume += part;
        moment = moment + part * sum;
        second =
            second +
            part / 120 * (outer_square(a) + outer_square(b) + outer_square(c) + outer_square(sum));
    }
    if (!(volume > 0))
        throw abut::Error(abut::ErrorCode::bad_argument, "the surface encloses no volume");
    const Vec3 centre = (0.25 / volume) * moment; // from `start`
    const double mass = density * volume / 6;
    const Matrix about_centre = density * second + -mass * outer_square(centre);
    const double trace = about_centre.x.x + about_centre.y.y + about_centre.z.z;
    return {mass, start + centre, trace * Matrix{} + -1 * about_centre};
}
Mass mass_of(const abut::Model& model, double density) {
    return mass_of(model.mesh(), density);
}
Mass mass_of(const abut::Convex& convex, double density) {
    return mass_of(convex.mesh(), density);
}
Mass mass_of(const abut::HalfSpace& /*half_space*/, double /*density*/) {
    throw abut::Error(abut::ErrorCode::bad_argument, "a half-space has no mass: give it density 0");
}

} // namespace simulation
