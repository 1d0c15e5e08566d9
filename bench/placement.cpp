#include "placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abut::bench {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

} // namespace

double unit(scenes::Random& random) {
    return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

std::array<double, 4> random_rotation(scenes::Random& random) {
    const double u = unit(random), v = kTurn * unit(random), w = kTurn * unit(random);
    const double p = std::sqrt(1 - u), q = std::sqrt(u);
    return {p * std::sin(v), p * std::cos(v), q * std::sin(w), q * std::cos(w)};
}

std::array<double, 4> turned(const std::array<double, 4>& q, const Vec3& axis, double degrees) {
    const double half = 0.5 * degrees * std::numbers::pi / 180, c = std::cos(half),
                 s = std::sin(half);
    return {c * q[0] - s * (axis.x * q[1] + axis.y * q[2] + axis.z * q[3]),
            c * q[1] + s * (axis.x * q[0] + axis.y * q[3] - axis.z * q[2]),
            c * q[2] + s * (axis.y * q[0] + axis.z * q[1] - axis.x * q[3]),
            c * q[3] + s * (axis.z * q[0] + axis.x * q[2] - axis.y * q[1])};
}

Vec3 random_direction(scenes::Random& random) {
    const double z = 2 * unit(random) - 1, angle = kTurn * unit(random);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

Vec3 placed(const Transform& t, const Vec3& p) {
    const auto& m = t.m;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

void extend(Box3& box, const Vec3& p) {
    box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y),
                 std::min(box.lower.z, p.z)};
    box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y),
                 std::max(box.upper.z, p.z)};
}

Box3 box_of(const Mesh& mesh, const Transform& placement) {
    Box3 box;
    for (const Vec3& p : mesh.positions)
        extend(box, placed(placement, p));
    return box;
}

void normalise(Mesh& mesh) {
    const Box3 box = box_of(mesh, {});
    const Vec3 size{box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                    box.upper.z - box.lower.z};
    const double scale = 1 / std::hypot(size.x, size.y, size.z);
    for (Vec3& p : mesh.positions)
        p = {scale * (p.x - box.lower.x - 0.5 * size.x), scale * (p.y - box.lower.y - 0.5 * size.y),
             scale * (p.z - box.lower.z - 0.5 * size.z)};
}

} // namespace abut::bench
