#include "simulator/surfaces.h"

#include <array>
#include <numbers>
#include <string>

namespace simulation {

namespace {

/// Makes a closed surface around the origin from its radius in each direction, given by the angle
/// from the z axis and the angle around it.
template <typename RadiusAt>
abut::Mesh round_surface(std::uint32_t rows, std::uint32_t around, const RadiusAt& radius_at) {
    abut::Mesh mesh;
    for (std::uint32_t row = 0; row <= rows; ++row)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double polar = std::numbers::pi * row / rows,
                         turn = 2 * std::numbers::pi * i / around;
            const bool is_pole = row == 0 || row == rows;
            const double r = radius_at(polar, turn), side = is_pole ? 0 : std::sin(polar);
            mesh.positions.push_back(
                {r * side * std::cos(turn), r * side * std::sin(turn), r * std::cos(polar)});
        }
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t next = (i + 1) % around;
            const std::uint32_t a = row * around + i, b = row * around + next;
            if (row + 1 < rows)
                mesh.triangles.push_back({a, a + around, b + around});
            if (row > 0)
                mesh.triangles.push_back({a, b + around, b});
        }
    return mesh;
}

constexpr std::array kColours{abut::Colour{214, 93, 61},  abut::Colour{66, 125, 190},
                              abut::Colour{232, 178, 63}, abut::Colour{92, 158, 94},
                              abut::Colour{139, 98, 168}, abut::Colour{69, 163, 163}};

abut::Colour colour_of(const Body& body, std::size_t number) {
    if (body.is_static())
        return {170, 170, 170};
    const abut::Colour full = kColours[number % kColours.size()];
    const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>((c + 2 * 225) / 3); };
    return body.asleep ? abut::Colour{pale(full.red), pale(full.green), pale(full.blue)} : full;
}

} // namespace

abut::Mesh surface_of(const abut::Sphere& sphere) {
    abut::Mesh mesh = round_surface(12, 18, [&](double, double) { return sphere.radius; });
    for (Vec3& p : mesh.positions)
        p = p + sphere.centre;
    return mesh;
}

abut::Mesh surface_of(const abut::Capsule& capsule) {
    // A ball whose halves are moved apart, with its poles along the axis.
    abut::Mesh mesh = round_surface(8, 12, [&](double, double) { return capsule.radius; });
    const Vec3 axis = capsule.axis.b - capsule.axis.a;
    const Vec3 z = length(axis) > 0 ? unit(axis) : Vec3{0, 0, 1}, x = across(z), y = cross(z, x);
    for (Vec3& p : mesh.positions)
        p = (p.z >= 0 ? capsule.axis.b : capsule.axis.a) + Matrix{x, y, z} * p;
    return mesh;
}

abut::Mesh surface_of(const abut::Box3& box) {
    abut::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.push_back({(corner & 1) != 0 ? box.upper.x : box.lower.x,
                                  (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                  (corner & 4) != 0 ? box.upper.z : box.lower.z});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

abut::Mesh surface_of(const abut::Convex& convex) {
    return convex.mesh();
}
abut::Mesh surface_of(const abut::Model& model) {
    return model.mesh();
}

abut::Mesh bumpy_ball(double radius) {
    return round_surface(24, 32, [&](double polar, double turn) {
        return radius * (1 + 0.25 * std::sin(2 * polar) * std::sin(polar) * std::cos(4 * turn));
    });
}

abut::Mesh dented_disc(double radius) {
    abut::Mesh mesh = round_surface(24, 32, [](double, double) { return 1; });
    for (Vec3& p : mesh.positions) {
        const double square = p.x * p.x + p.y * p.y; // of the distance from the axis
        p = radius * Vec3{p.x, p.y, (0.2 + 0.9 * square - 0.5 * square * square) * p.z};
    }
    return mesh;
}

abut::Mesh Surfaces::placed(const Simulator& simulator) const {
    abut::Mesh all;
    for (std::size_t i = 0; i < of_body.size(); ++i) {
        const Pose& pose = simulator.bodies()[i].pose;
        const Matrix r = rotation_matrix(normalised(pose.rotation));
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const Vec3& p : of_body[i].positions)
            all.positions.push_back(pose.translation + r * p);
        for (const auto& [a, b, c] : of_body[i].triangles)
            all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
}

abut::Scene Surfaces::scene(const Simulator& simulator) const {
    abut::Scene scene;
    scene.up = abut::UpAxis::z;
    scene.meshes = of_body;
    for (std::size_t i = 0; i < of_body.size(); ++i) {
        const Body& body = simulator.bodies()[i];
        const std::string name = "body-" + std::to_string(i);
        scene.parts.push_back({name, name, body.is_static() ? "static" : "moving",
                               static_cast<std::uint32_t>(i), body.pose, colour_of(body, i)});
    }
    return scene;
}

} // namespace simulation
