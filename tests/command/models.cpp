#include "tests/command/models.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace abut::test {

Mesh unit_box() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    return mesh;
}

Mesh ball(int rings) {
    Mesh mesh;
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < columns; ++j) {
            const double theta = std::numbers::pi * i / rings;
            const double phi = 2 * std::numbers::pi * j / columns;
            mesh.positions.push_back({std::sin(theta) * std::cos(phi),
                                      std::sin(theta) * std::sin(phi), std::cos(theta)});
        }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(i * columns + j % columns);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < columns; ++j) {
            if (i > 0)
                mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + 1 < rings)
                mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return mesh;
}

Transform placed(double x, double y, double z, double scale) {
    return Transform({scale, 0, 0, 0, scale, 0, 0, 0, scale, x, y, z});
}

Part part(const std::string& id, const std::string& type, std::uint32_t mesh, const Transform& at) {
    return {id, id, type, mesh, at};
}

std::string box_obj() {
    const Mesh box = unit_box();
    std::string text;
    for (const Vec3& p : box.positions)
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                "\n";
    for (const auto& t : box.triangles)
        text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
                std::to_string(t[2] + 1) + "\n";
    return text;
}

Scene one_of_each_kind() {
    Scene scene;
    scene.meshes = {unit_box()};
    scene.parts = {
        part("h1", "Wall", 0, placed(0, 0, 0)),     part("h2", "Pipe", 0, placed(0.9, 0.25, 0.25)),
        part("t1", "Wall", 0, placed(10, 0, 0)),    part("t2", "Slab", 0, placed(11, 0.25, 0.25)),
        part("c1", "Tank", 0, placed(20, 0, 0, 4)), part("c2", "Pump", 0, placed(21, 1, 1)),
        part("d1", "Pump", 0, placed(30, 0, 0)),    part("d2", "Pump", 0, placed(30, 0, 0)),
        part("n1", "Pipe", 0, placed(40, 0, 0)),    part("n2", "Pipe", 0, placed(41.03, 0, 0))};
    return scene;
}

Scene crowd(int balls, int rings) {
    Scene scene;
    for (int i = 0; i < balls; ++i) {
        Mesh mesh = ball(rings);
        for (Vec3& p : mesh.positions)
            p.x *= 1 + 0.001 * i;
        scene.meshes.push_back(std::move(mesh));
        const int row = i / 20, column = i % 20;
        scene.parts.push_back(part("ball" + std::to_string(i), "Ball",
                                   static_cast<std::uint32_t>(i),
                                   placed(1.9 * column, 1.9 * row, 0)));
    }
    return scene;
}

} // namespace abut::test
