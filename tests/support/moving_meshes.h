#pragma once

#include <abut/deformable.h>

#include "math/vector.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <set>
#include <tuple>
#include <vector>

/// Moving meshes, and brute-force searches for their impacts.
namespace abut {

inline void PrintTo(const FeatureImpact& i, std::ostream* out) {
    *out << (i.kind == ElementaryKind::vertex_face ? "vertex-face " : "edge-edge ") << i.a << ' '
         << i.b << (i.face_first ? " (face first)" : "") << " at " << i.time;
}

} // namespace abut

namespace abut::test {

/// A mesh at the start, and the positions of its vertices at the end.
struct MovingMesh {
    Mesh mesh;
    std::vector<Vec3> end;

    /// The moving mesh as a Deformable.
    [[nodiscard]] Deformable deformable(const DeformableOptions& options = {}) const {
        Deformable surface(mesh, options);
        surface.set_motion(mesh.positions, end);
        return surface;
    }
};

/// Triangles of arbitrary vertices. Some repeat an index, and most edges have many triangles.
inline std::vector<std::array<std::uint32_t, 3>> any_triangles(Random& random, int vertices,
                                                               int triangles) {
    std::vector<std::array<std::uint32_t, 3>> all(static_cast<std::size_t>(triangles));
    for (auto& triangle : all)
        for (std::uint32_t& v : triangle)
            v = static_cast<std::uint32_t>(random.integer(0, vertices - 1));
    return all;
}

/// Coordinates are integers from 0 to n, so that exact contacts are frequent, also in planar
/// motion.
inline MovingMesh lattice_soup(Random& random, int vertices, int triangles, int n) {
    MovingMesh moving;
    const bool planar = random.chance(0.2), still = random.chance(0.2);
    for (int i = 0; i < vertices; ++i)
        for (auto* points : {&moving.mesh.positions, &moving.end}) {
            Vec3 p = random.on_lattice(n);
            if (planar)
                p.z = 0;
            points->push_back(p);
        }
    for (std::size_t i = 0; i < moving.end.size(); ++i)
        if (still || random.chance(0.2))
            moving.end[i] = moving.mesh.positions[i];
    moving.mesh.triangles = any_triangles(random, vertices, triangles);
    return moving;
}

/// Arbitrary positions. The motion is as large as the triangles, or smaller.
inline MovingMesh random_soup(Random& random, int vertices, int triangles) {
    MovingMesh moving;
    const double way = std::pow(10, random.uniform(-2, 0));
    for (int i = 0; i < vertices; ++i) {
        moving.mesh.positions.push_back(random.in_cube());
        moving.end.push_back(moving.mesh.positions.back() + random.in_cube(way));
    }
    moving.mesh.triangles = any_triangles(random, vertices, triangles);
    return moving;
}

/// Triangles with sides from 1e-9 to 1 whose area is near the rounding of their corners, or 0. Many
/// are beside a point of another one, and some have a vertex in common.
inline MovingMesh needle_soup(Random& random, int triangles) {
    MovingMesh moving;
    auto& points = moving.mesh.positions;
    for (int i = 0; i < triangles; ++i) {
        const double size = std::pow(10, random.uniform(-9, 0));
        const double width = random.chance(0.2) ? 0 : size * std::pow(10, -random.uniform(3, 17));
        const Vec3 along = size * random.direction(), aside = width * random.direction();
        Vec3 first = random.in_cube(0.5);
        if (!points.empty() && random.chance(0.7)) {
            const auto other = std::size_t(random.integer(0, int(points.size() / 3) - 1)) * 3;
            const double s = random.uniform(0, 1);
            first = points[other] + s * (points[other + 1] - points[other]) +
                    random.in_cube(random.chance(0.3) ? 0 : std::pow(10, -random.uniform(1, 17))) -
                    random.uniform(0, 1) * along;
        }
        const auto at = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(),
                      {first, first + along, first + random.uniform(-0.2, 1.2) * along + aside});
        std::array<std::uint32_t, 3> t{at, at + 1, at + 2};
        if (at > 0 && random.chance(0.1))
            t[2] = static_cast<std::uint32_t>(random.integer(0, int(at) - 1));
        std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
        moving.mesh.triangles.push_back(t);
    }
    for (const Vec3& p : points)
        moving.end.push_back(p + random.in_cube(std::pow(10, -random.uniform(1, 17))));
    return moving;
}

/// A crumpled sheet of 2 n^2 triangles that crumples further.
inline MovingMesh crumpled_sheet(Random& random, int n, double size = 1) {
    const double bend = random.uniform(2, 5), noise = size / n;
    MovingMesh moving;
    moving.mesh = grid_mesh(n, n, false, false, [&](double u, double v) {
        const Vec3 p{u, 0.2 * std::sin(bend * u) * std::cos(bend * v), v * std::cos(bend * u)};
        return size * p + random.in_cube(0.3 * noise);
    });
    for (const Vec3& p : moving.mesh.positions)
        moving.end.push_back(p + random.in_cube(noise));
    return moving;
}

/// Calls visit for all pairs of features of two surfaces, or of one surface if both are the same
/// object, except neighbours. Arguments: an impact with kind, face_first, a and b set, and the
/// elementary pair.
template <typename Visit>
void for_each_feature_pair(const MovingMesh& first, const MovingMesh& second, const Visit& visit) {
    using Edge = std::array<std::uint32_t, 2>;
    const bool self = &first == &second;
    const auto edges_of = [](const MovingMesh& moving) {
        std::set<Edge> edges; // (higher, lower): the order of Deformable::edges
        for (const auto& t : moving.mesh.triangles)
            for (std::size_t k = 0; k < 3; ++k)
                if (t[k] != t[(k + 1) % 3])
                    edges.insert({std::max(t[k], t[(k + 1) % 3]), std::min(t[k], t[(k + 1) % 3])});
        return std::vector<Edge>(edges.begin(), edges.end());
    };
    const auto set = [](ElementaryPair& pair, std::size_t i, const MovingMesh& of,
                        std::uint32_t v) {
        pair.start[i] = of.mesh.positions[v];
        pair.end[i] = of.end[v];
    };

    const auto edges_a = edges_of(first), edges_b = edges_of(second);
    for (std::uint32_t a = 0; a < edges_a.size(); ++a)
        for (std::uint32_t b = self ? a + 1 : 0; b < edges_b.size(); ++b) {
            const auto& [a1, a0] = edges_a[a];
            const auto& [b1, b0] = edges_b[b];
            if (self && (a0 == b0 || a0 == b1 || a1 == b0 || a1 == b1))
                continue;
            ElementaryPair pair{ElementaryKind::edge_edge, {}, {}};
            set(pair, 0, first, a0), set(pair, 1, first, a1);
            set(pair, 2, second, b0), set(pair, 3, second, b1);
            FeatureImpact impact;
            impact.kind = pair.kind, impact.a = a, impact.b = b;
            visit(impact, pair);
        }
    const auto faces = [&](const MovingMesh& of_vertex, const MovingMesh& of_face,
                           bool face_first) {
        std::set<std::uint32_t> used;
        for (const auto& t : of_vertex.mesh.triangles)
            used.insert(t.begin(), t.end());
        for (const std::uint32_t v : used)
            for (std::uint32_t f = 0; f < of_face.mesh.triangles.size(); ++f) {
                const auto& t = of_face.mesh.triangles[f];
                if (self && std::find(t.begin(), t.end(), v) != t.end())
                    continue;
                ElementaryPair pair{ElementaryKind::vertex_face, {}, {}};
                set(pair, 0, of_vertex, v);
                for (std::size_t k = 0; k < 3; ++k)
                    set(pair, 1 + k, of_face, t[k]);
                FeatureImpact impact;
                impact.kind = pair.kind, impact.face_first = face_first;
                impact.a = v, impact.b = f;
                visit(impact, pair);
            }
    };
    faces(first, second, false);
    if (!self)
        faces(second, first, true);
}

/// The sort key of impacts: kind, face_first, a, b.
inline auto list_order(const FeatureImpact& i) {
    return std::tuple(i.kind, i.face_first, i.a, i.b);
}

/// The impacts found by elementary tests of all pairs, and the number of pairs.
struct BruteForceImpacts {
    std::vector<FeatureImpact> list;
    std::size_t pairs = 0;

    BruteForceImpacts(const MovingMesh& first, const MovingMesh& second,
                      const ElementaryOptions& options = {}) {
        for_each_feature_pair(first, second, [&](FeatureImpact found, const ElementaryPair& pair) {
            ++pairs;
            const ElementaryImpact impact = elementary_impact(pair, options);
            if (!impact.meet)
                return;
            found.status = impact.status;
            found.time = impact.time;
            found.barycentric = impact.barycentric;
            found.normal = impact.normal;
            list.push_back(found);
        });
        std::sort(list.begin(), list.end(), [](const FeatureImpact& a, const FeatureImpact& b) {
            return list_order(a) < list_order(b);
        });
    }
};

} // namespace abut::test
