#include "suites/contact_rows.h"

#include <abut/progress.h>
#include <abut/surface_contacts.h>
#include <abut/vector.h>

#include "measure.h"
#include "scenes/bodies.h"

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

constexpr std::uint32_t kContactTriangles = 2000;

/// Triangles whose middles are above the unit sphere by random heights, and whose planes are
/// parallel to it there.
Deformable triangles_around(double size, double lowest, double highest) {
    std::mt19937_64 engine(7);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    };
    Mesh mesh;
    for (std::uint32_t i = 0; i < kContactTriangles; ++i) {
        Vec3 up{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        up = (1 / length(up)) * up;
        Vec3 u = cross(up, {0.3, 0.5, 0.7});
        u = (1 / length(u)) * u;
        const Vec3 v = cross(up, u), middle = (1 + uniform(lowest, highest)) * up;
        const double turn = uniform(0, 6);
        for (std::uint32_t k = 0; k < 3; ++k)
            mesh.positions.push_back(middle + size * std::cos(turn + 2 * k) * u +
                                     size * std::sin(turn + 2 * k) * v);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return Deformable(std::move(mesh));
}

} // namespace

void add_contact_rows(Report& report, int rounds) {
    const std::vector<std::pair<std::string, RigidShape>> bodies{
        {"a model of 20,000 triangles", Model(scenes::sphere(20000))},
        {"a hull of 500 triangles", Convex(scenes::sphere(500).positions)},
        {"a box", Box3{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}}},
        {"a cylinder", Cylinder{{{0, 0, -0.7}, {0, 0, 0.7}}, 0.7}},
        {"an ellipsoid", Ellipsoid{{}, {1, 0.9, 0.8}}}};
    struct Case {
        const char* name;
        double size, lowest, highest;
    };
    set_threads(1);
    for (const auto& [name, body] : bodies)
        for (const Case& c : {Case{"large triangles over ", 3, 0, 0.01},
                              Case{"large triangles through ", 3, -0.5, -0.01},
                              Case{"small triangles over ", 0.03, 0, 0.01},
                              Case{"small triangles through ", 0.03, -0.01, 0.01}}) {
            const Deformable surface = triangles_around(c.size, c.lowest, c.highest);
            constexpr double kLimit = 0.02;
            std::size_t found = 0;
            std::vector<double> seconds;
            for (int round = 0; round < rounds; ++round) {
                const double start = wall_seconds();
                found = within(surface, body, Pose{}, kLimit).size();
                seconds.push_back(wall_seconds() - start);
            }
            Row row{c.name + name, 1e6 * median(seconds) / kContactTriangles, {}, {}, "us", 1, {}};
            row.counters["contacts"] = static_cast<double>(found);
            report.rows.push_back(std::move(row));
        }
    set_threads(0);
}

} // namespace abut::bench
