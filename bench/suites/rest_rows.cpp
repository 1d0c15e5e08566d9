#include "suites/rest_rows.h"

#include <abut/deformable.h>
#include <abut/progress.h>
#include <abut/vector.h>
#include <abut/world.h>

#include "measure.h"
#include "peers/peer_rest.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

constexpr std::uint32_t kCells = 141; ///< along a side of the cloth: 39,762 triangles

std::vector<Vec3> waving(double phase) {
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i <= kCells; ++i)
        for (std::uint32_t k = 0; k <= kCells; ++k) {
            const double u = 2.0 * i / kCells - 1, v = 2.0 * k / kCells - 1;
            points.push_back({u, v, 0.2 * std::sin(3 * u + phase) * std::cos(2 * v)});
        }
    return points;
}

Mesh cloth() {
    Mesh mesh{waving(0), {}};
    for (std::uint32_t i = 0; i < kCells; ++i)
        for (std::uint32_t k = 0; k < kCells; ++k) {
            const std::uint32_t a = i * (kCells + 1) + k, b = a + 1, c = a + kCells + 1, d = c + 1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, d});
        }
    return mesh;
}

/// Two waving layers, one above the other. Features of both layers and within a layer are near.
Mesh two_layers(double gap) {
    Mesh mesh = cloth();
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t triangles = mesh.triangles.size();
    for (std::uint32_t v = 0; v < vertices; ++v)
        mesh.positions.push_back(mesh.positions[v] + Vec3{0.3 / kCells, 0.2 / kCells, gap});
    for (std::size_t i = 0; i < triangles; ++i) {
        const auto& t = mesh.triangles[i];
        mesh.triangles.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
    }
    return mesh;
}

double mean_edge(const Deformable& surface, const std::vector<Vec3>& positions) {
    double sum = 0;
    for (const auto& [a, b] : surface.edges())
        sum += length(positions[b] - positions[a]);
    return surface.edges().empty() ? 0 : sum / static_cast<double>(surface.edges().size());
}

Model tetrahedron() {
    return Model(Mesh{{{0, 0, 0.5}, {0.1, 0, 0.5}, {0, 0.1, 0.5}, {0, 0, 0.6}},
                      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
}

} // namespace

Row at_rest_row(const CcdStep& step, int rounds) {
    const Deformable surface(step.start);
    const CgalSelfIntersections peer(step.start);
    std::size_t found = 0;
    std::optional<std::size_t> pairs;
    set_threads(1);
    const Turns turns = take_turns(
        rounds, [&] { found = self_intersections(surface).size(); }, [&] { pairs = peer.count(); });
    Row row{step.name + ", edges through faces at rest",
            kMilliseconds * turns.ours,
            {},
            {},
            "ms",
            1,
            {}};
    row.counters["edges through faces"] = static_cast<double>(found);
    if (pairs) {
        row.peer = "CGAL, triangles that intersect";
        row.theirs = kMilliseconds * turns.theirs;
        row.counters["pairs of triangles of the peer"] = static_cast<double>(*pairs);
    }
    return row;
}

Row near_row(const CcdStep& step, int rounds) {
    constexpr double kShareOfEdge = 0.3; // the usual thickness of cloth
    Deformable surface(step.start);
    const double distance = kShareOfEdge * mean_edge(surface, step.start.positions);
    std::size_t pairs = 0, impacts = 0;
    set_threads(1);
    const Turns turns = take_turns(
        rounds, [&] { pairs = self_within(surface, distance).size(); },
        [&] { impacts = self_impacts(surface, {.thickness = distance}).list.size(); });
    set_threads(0);
    Row row{step.name + ", near pairs at rest",
            kMilliseconds * turns.ours,
            "abut, impacts with that thickness",
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
    row.counters["near pairs"] = static_cast<double>(pairs);
    row.counters["impacts"] = static_cast<double>(impacts);
    row.counters["distance"] = distance;
    return row;
}

namespace {

/// One vertex that is as thick as a tenth of the cloth, and all others without thickness, beside
/// all without.
Row thick_vertex_row(int rounds) {
    const Mesh mesh = cloth();
    const Deformable surface(mesh);
    const double distance = 0.3 * mean_edge(surface, mesh.positions);
    const std::vector<double> thin(surface.vertex_count(), 0.0);
    std::vector<double> one_thick = thin;
    one_thick[one_thick.size() / 2 + kCells / 2] = 0.2;
    std::size_t pairs = 0;
    const auto near = [&](const std::vector<double>& thickness) {
        return self_within(surface, distance, {.vertices = {.thickness = thickness}}).size();
    };
    set_threads(1);
    const Turns turns = take_turns(
        rounds, [&] { pairs = near(one_thick); }, [&] { near(thin); });
    set_threads(0);
    Row row{"a cloth of 39,762 triangles with one thick vertex, near pairs at rest",
            kMilliseconds * turns.ours,
            "abut, without the thick vertex",
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
    row.counters["near pairs"] = static_cast<double>(pairs);
    return row;
}

} // namespace

void add_near_rows(Report& report, int rounds) {
    report.rows.push_back(near_row({"a cloth of 39,762 triangles", cloth(), {}}, rounds));
    report.rows.push_back(
        near_row({"two layers of 39,762 triangles each", two_layers(0.003), {}}, rounds));
    report.rows.push_back(thick_vertex_row(rounds));
}

void add_refresh_row(Report& report, int steps) {
    set_threads(1);
    Mesh mesh = cloth();
    Deformable surface(mesh);
    World world;
    const BodyId body = world.add(surface);
    world.add(tetrahedron(), Pose{});
    constexpr double kReach = 0.5;
    world.within(kReach);
    std::vector<double> advance, refresh, build;
    for (int step = 1; step <= steps; ++step) {
        mesh.positions = waving(0.02 * step);
        const double start = process_seconds();
        surface.advance(mesh.positions);
        const double advanced = process_seconds();
        world.refresh(body);
        world.within(kReach);
        const double answered = process_seconds();
        const Model model{mesh};
        build.push_back(process_seconds() - answered);
        advance.push_back(advanced - start);
        refresh.push_back(answered - advanced);
    }
    set_threads(0);
    Row row{"a deformable of 39,762 triangles, refresh and within",
            kMilliseconds * median(refresh),
            "our own build of a model",
            kMilliseconds * median(build),
            "ms/step",
            1,
            {}};
    row.counters["its own step (advance), ms"] = kMilliseconds * median(advance);
    report.rows.push_back(std::move(row));
}

} // namespace abut::bench
