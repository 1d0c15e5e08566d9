#include "suites/any_culling_rows.h"

#include <abut/broad_phase.h>
#include <abut/deformable.h>
#include <abut/progress.h>
#include <abut/representatives.h>

#include "measure.h"
#include "placement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace abut::bench {

namespace {

std::vector<TrianglePair> swept_pairs(const CcdStep& step) {
    std::vector<Box3> boxes;
    for (const auto& triangle : step.start.triangles) {
        Box3 box;
        for (const std::uint32_t v : triangle) {
            extend(box, step.start.positions[v]);
            extend(box, step.end[v]);
        }
        boxes.push_back(box);
    }
    std::vector<TrianglePair> pairs;
    for (const IndexPair& pair : overlapping_boxes(boxes))
        pairs.push_back({pair.a(), pair.b()});
    return pairs;
}

/// The coordinates of a vertex along the three axes and the six diagonals of two axes.
using Along = std::array<double, 9>;
Along along(const Vec3& p) {
    return {p.x, p.y, p.z, p.x + p.y, p.y + p.z, p.z + p.x, p.x - p.y, p.y - p.z, p.z - p.x};
}

/// 18-DOPs of features at both ends of the motion, made of those of their vertices when they are
/// compared. Coordinates are rounded once, which keeps their order.
class Dops {
public:
    explicit Dops(const CcdStep& step) {
        for (std::size_t i = 0; i < step.end.size(); ++i)
            vertices_.push_back({along(step.start.positions[i]), along(step.end[i])});
    }

    /// Whether, along one direction, one feature lies below the other at both ends.
    [[nodiscard]] bool are_apart(const FeatureTest& test) const {
        const std::size_t second = test.kind == ElementaryKind::vertex_face ? 1 : 2;
        for (std::size_t k = 0; k < std::tuple_size_v<Along>; ++k) {
            bool below = true, above = true;
            for (std::size_t end = 0; end < 2; ++end) {
                const auto range = [&](std::size_t first, std::size_t last) {
                    double least = vertices_[test.vertices.at(first)].at(end).at(k), most = least;
                    for (std::size_t i = first + 1; i < last; ++i) {
                        const double value = vertices_[test.vertices.at(i)].at(end).at(k);
                        least = std::min(least, value), most = std::max(most, value);
                    }
                    return std::pair(least, most);
                };
                const auto a = range(0, second), b = range(second, 4);
                below = below && a.second < b.first;
                above = above && b.second < a.first;
            }
            if (below || above)
                return true;
        }
        return false;
    }

private:
    std::vector<std::array<Along, 2>> vertices_;
};

std::vector<ElementaryPair> elementary_pairs(const CcdStep& step,
                                             const std::vector<FeatureTest>& tests) {
    std::vector<ElementaryPair> pairs;
    pairs.reserve(tests.size());
    for (const FeatureTest& test : tests) {
        ElementaryPair pair{test.kind, {}, {}};
        for (std::size_t i = 0; i < 4; ++i) {
            pair.start.at(i) = step.start.positions[test.vertices.at(i)];
            pair.end.at(i) = step.end[test.vertices.at(i)];
        }
        pairs.push_back(pair);
    }
    return pairs;
}

/// Pairs that boxes at both ends leave go to the elementary tests, at once or after 18-DOPs.
Row dops_row(const CcdStep& step, const std::vector<TrianglePair>& pairs, int rounds) {
    Representatives surface(step.start.positions.size(), step.start.triangles);
    const std::size_t without = self_feature_tests(surface, pairs).size();
    const std::size_t topology = surface.bytes();
    surface.set_motion(step.start.positions, step.end);
    const std::vector<FeatureTest> tests = self_feature_tests(surface, pairs);
    const std::vector<ElementaryPair> all = elementary_pairs(step, tests);
    const Dops dops(step);
    std::size_t left = 0, impacts = 0;
    const Turns turns = take_turns(
        rounds,
        [&] {
            impacts = 0;
            for (const ElementaryImpact& impact : elementary_impacts(all))
                impacts += impact.meet ? 1 : 0;
        },
        [&] {
            std::vector<ElementaryPair> near;
            for (std::size_t i = 0; i < tests.size(); ++i)
                if (!dops.are_apart(tests[i]))
                    near.push_back(all[i]);
            left = near.size();
            elementary_impacts(near);
        });
    Row row{step.name + ", elementary tests of what boxes leave",
            kMilliseconds * turns.ours,
            "abut, 18-DOPs at both ends first",
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
    const auto triangles = static_cast<double>(step.start.triangles.size());
    row.counters["triangle pairs"] = static_cast<double>(pairs.size());
    row.counters["tests without boxes of features"] = static_cast<double>(without);
    row.counters["tests left by boxes"] = static_cast<double>(tests.size());
    row.counters["tests left by 18-DOPs"] = static_cast<double>(left);
    row.counters["impacts"] = static_cast<double>(impacts);
    row.counters["bytes a triangle, topology"] = static_cast<double>(topology) / triangles;
    row.counters["bytes a triangle, with boxes"] = static_cast<double>(surface.bytes()) / triangles;
    return row;
}

/// The triangles around each vertex and each edge.
class Around {
public:
    Around(const Representatives& surface, const Deformable& edges)
        : surface_(surface), vertices_(surface.vertex_count()), edges_(edges.edges().size()) {
        const auto& list = edges.edges();
        const auto less = [](const auto& e, const auto& f) {
            return std::pair(e[1], e[0]) < std::pair(f[1], f[0]);
        };
        for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
            const auto& triangle = surface.triangles()[t];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = triangle.at(k), w = triangle.at((k + 1) % 3);
                vertices_[v].push_back(t);
                const std::array<std::uint32_t, 2> edge{std::min(v, w), std::max(v, w)};
                const auto found = std::lower_bound(list.begin(), list.end(), edge, less);
                edges_[static_cast<std::size_t>(found - list.begin())].push_back(t);
            }
        }
    }
    /// The pairs of triangles that hold both features of an impact, and the tests of what both
    /// triangles of each represent.
    [[nodiscard]] std::pair<double, double> pairs_and_tests(const FeatureImpact& impact) const {
        double pairs = 0, tests = 0;
        const std::vector<std::uint32_t> face{impact.b};
        const bool faces = impact.kind == ElementaryKind::vertex_face;
        for (const std::uint32_t t : faces ? vertices_[impact.a] : edges_[impact.a])
            for (const std::uint32_t u : faces ? face : edges_[impact.b]) {
                const unsigned a = surface_.represented()[t], b = surface_.represented()[u];
                ++pairs;
                tests += std::popcount(a >> 3) * std::popcount(b >> 3) + std::popcount(a & 7U) +
                         std::popcount(b & 7U);
            }
        return {pairs, tests};
    }

private:
    const Representatives& surface_;
    std::vector<std::vector<std::uint32_t>> vertices_, edges_;
};

/// A triangle of a regular mesh represents half a vertex and one and a half edges. So two triangles
/// lead to 2 / 2 + 9 / 4 = 3.25 tests; 6 pairs hold a vertex and a face, and 4 pairs two edges.
std::vector<Row> contact_rows(const CcdStep& step) {
    constexpr double kTestsOfAPair = 3.25;
    Deformable surface(step.start);
    surface.set_motion(step.start.positions, step.end);
    const Representatives representatives(step.start.positions.size(), step.start.triangles);
    const Around around(representatives, surface);
    std::vector<Row> rows;
    const Impacts all = self_impacts(surface);
    for (const auto kind : {ElementaryKind::vertex_face, ElementaryKind::edge_edge}) {
        double contacts = 0, pairs = 0, tests = 0;
        for (const FeatureImpact& impact : all.list)
            if (impact.kind == kind) {
                const auto [p, t] = around.pairs_and_tests(impact);
                pairs += p, tests += t, ++contacts;
            }
        const bool faces = kind == ElementaryKind::vertex_face;
        Row row{step.name + (faces ? ", tests around a vertex-face contact"
                                   : ", tests around an edge-edge contact"),
                contacts > 0 ? tests / contacts : 0,
                "a regular mesh",
                (faces ? 6 : 4) * kTestsOfAPair,
                "tests",
                1,
                {}};
        row.counters["triangle pairs a contact"] = contacts > 0 ? pairs / contacts : 0;
        row.counters["tests a triangle pair"] = pairs > 0 ? tests / pairs : 0;
        rows.push_back(row);
    }
    return rows;
}

CcdStep soup_of(const CcdStep& step) {
    constexpr double kSize = 0.9;
    CcdStep soup{step.name + " as a soup", {}, {}};
    const auto add = [&](const std::array<std::uint32_t, 3>& triangle,
                         const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        Vec3 middle;
        for (const std::uint32_t v : triangle)
            middle = {middle.x + from[v].x / 3, middle.y + from[v].y / 3, middle.z + from[v].z / 3};
        for (const std::uint32_t v : triangle) {
            const Vec3& p = from[v];
            to.push_back({middle.x + kSize * (p.x - middle.x), middle.y + kSize * (p.y - middle.y),
                          middle.z + kSize * (p.z - middle.z)});
        }
    };
    for (const auto& triangle : step.start.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.start.positions.size());
        soup.start.triangles.push_back({first, first + 1, first + 2});
        add(triangle, step.start.positions, soup.start.positions);
        add(triangle, step.end, soup.end);
    }
    return soup;
}

Row soup_row(const CcdStep& step, int rounds) {
    const CcdStep soup = soup_of(step);
    Deformable whole(step.start), parts(soup.start);
    Impacts impacts;
    const Turns turns = take_turns(
        rounds,
        [&] {
            whole.set_motion(step.start.positions, step.end);
            self_impacts(whole);
        },
        [&] {
            parts.set_motion(soup.start.positions, soup.end);
            impacts = self_impacts(parts);
        });
    Row row{step.name + ", all impacts",
            kMilliseconds * turns.ours,
            "abut, as a soup of smaller triangles",
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
    row.counters["triangle pairs"] = static_cast<double>(impacts.counters.triangle_pairs);
    row.counters["candidates"] = static_cast<double>(impacts.counters.candidates.vertex_face +
                                                     impacts.counters.candidates.edge_edge);
    row.counters["impacts"] = static_cast<double>(impacts.list.size());
    row.counters["bytes a triangle"] =
        static_cast<double>(parts.bytes()) / static_cast<double>(soup.start.triangles.size());
    return row;
}

/// A hundred triangles far from each other change: only what is around them is done anew.
Row topology_row(const CcdStep& step, int rounds) {
    constexpr std::size_t kChanges = 100;
    const auto& triangles = step.start.triangles;
    auto changed = triangles;
    const std::size_t apart = std::max<std::size_t>(1, triangles.size() / kChanges);
    for (std::size_t i = 0; i < changed.size(); i += apart)
        std::rotate(changed[i].begin(), changed[i].begin() + 1, changed[i].end());
    const std::size_t vertices = step.start.positions.size();
    Representatives surface(vertices, triangles);
    bool is_changed = false;
    const Turns turns = take_turns(
        rounds,
        [&] {
            is_changed = !is_changed;
            surface.set_triangles(vertices, is_changed ? changed : triangles);
        },
        [&] { const Representatives anew(vertices, changed); });
    return {step.name + ", representatives of 100 changed triangles",
            kMilliseconds * turns.ours,
            "abut, all anew",
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
}

} // namespace

std::vector<Row> any_culling_rows(const CcdStep& step, int rounds) {
    set_threads(1);
    std::vector<Row> rows = contact_rows(step);
    rows.push_back(dops_row(step, swept_pairs(step), rounds));
    rows.push_back(topology_row(step, rounds));
    rows.push_back(soup_row(step, rounds));
    set_threads(0);
    return rows;
}

} // namespace abut::bench
