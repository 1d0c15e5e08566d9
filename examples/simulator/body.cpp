#include "simulator/body.h"

#include <limits>

namespace simulation {

namespace {

/// Returns the angular velocity at the end of a step of free rotation, in the body's frame.
///
/// It solves  J (w1 - w0) + h m x J m = 0,  m = (w0 + w1) / 2, by Newton's method. Each iteration
/// squares the error, so that eight are enough if they converge at all.
Vec3 free_spin(const Matrix& inertia, const Vec3& start, double h) {
    Vec3 end = start;
    for (int i = 0; i < 8; ++i) {
        const Vec3 middle = 0.5 * (start + end), momentum = inertia * middle;
        const Vec3 residual = inertia * (end - start) + h * cross(middle, momentum);
        if (length(residual) <=
            4 * std::numeric_limits<double>::epsilon() * length(inertia * start))
            break;
        const Matrix slope =
            inertia + 0.5 * h * (cross_matrix(middle) * inertia + -1 * cross_matrix(momentum));
        end = end - inverse(slope) * residual;
    }
    return end;
}

} // namespace

Pose current_pose(const Body& body) {
    const Matrix r = rotation_matrix(body.rotation);
    return {body.position - r * body.mass.centre, body.rotation};
}

Matrix world_inertia(const Body& body) {
    const Matrix r = rotation_matrix(body.rotation);
    return r * body.mass.inertia * transposed(r);
}

void update_inertia(Body& body) {
    if (body.is_static())
        return;
    const Matrix r = rotation_matrix(body.rotation);
    body.inverse_inertia = r * inverse(body.mass.inertia) * transposed(r);
}

void drift(Body& body, double seconds) {
    const Vec3 move = seconds * body.velocity;
    body.position = body.position + move;
    body.moved = body.moved + move;

    const Matrix r = rotation_matrix(body.rotation);
    const Vec3 start = transposed(r) * body.spin;
    const Vec3 end = free_spin(body.mass.inertia, start, seconds);
    const Vec3 half = 0.25 * seconds * (start + end);
    body.turned = body.turned + 2 * (r * half);
    body.rotation = normalised(product(body.rotation, {1, half.x, half.y, half.z}));
    body.spin = rotation_matrix(body.rotation) * end;
}

double kinetic_energy(const Body& body) {
    const Vec3 spin = transposed(rotation_matrix(body.rotation)) * body.spin;
    return 0.5 * (body.mass.mass * dot(body.velocity, body.velocity) +
                  dot(spin, body.mass.inertia * spin));
}

} // namespace simulation
