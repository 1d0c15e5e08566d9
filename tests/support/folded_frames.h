#pragma once

#include "tests/support/moving_meshes.h"
#include "tests/support/oracle/ccd_oracle.h"

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <vector>

/// Two frames of a cloth that folds hard, and which of its features meet between them, decided by
/// integers. They take the place of the large frames in the shared data folder, which a clone of
/// the repository does not have.
namespace abut::test {

/// The numbers in which the frames' positions are written.
enum class FrameNumbers : std::uint8_t {
    lattice, ///< multiples of 1/32, so that features often meet exactly at an edge or a vertex
    floats,  ///< multiples of 2^-22; some vertices end on a face or an edge, or miss it by rounding
    far,     ///< as floats, a million from the origin
};

inline void PrintTo(FrameNumbers numbers, std::ostream* out) {
    constexpr std::array<const char*, 3> kNames{"lattice", "floats", "far"};
    *out << kNames.at(static_cast<std::size_t>(numbers));
}

/// A sheet of 2 n^2 triangles, folded as a map into 3 by 3 layers that lie close together. In the
/// step it is pressed flat and pinched, so that its layers go through each other.
///
/// In      n: a multiple of 3.
inline MovingMesh folded_sheet(Random& random, int n, FrameNumbers numbers) {
    constexpr int kFolds = 3;
    constexpr double kGap = 0.125; // between layers that are 1 wide
    const double cell = double(kFolds) / n;
    // A way to and fro between 0 and 1, and how many times it has turned.
    const auto turns = [&](double along) {
        return std::min(kFolds - 1, static_cast<int>(along * kFolds));
    };
    const auto fold = [&](double along) {
        const double in_layer = along * kFolds - turns(along);
        return turns(along) % 2 == 0 ? in_layer : 1 - in_layer;
    };
    MovingMesh moving;
    moving.mesh = grid_mesh(n, n, false, false, [&](double u, double v) {
        const double along = turns(v) % 2 == 0 ? u * kFolds : kFolds - u * kFolds;
        return Vec3{fold(u), fold(v), kGap * (along + kFolds * turns(v))} +
               random.in_cube(0.3 * cell);
    });
    // Some vertices lie on a face, an edge or a vertex, as far as rounding allows.
    const auto place = [&](std::vector<Vec3>& points) {
        for (Vec3& p : points) {
            const auto& t = moving.mesh.triangles[static_cast<std::size_t>(
                random.integer(0, static_cast<int>(moving.mesh.triangles.size()) - 1))];
            const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
            const double s = random.integer(0, 4) / 4.0, h = random.integer(0, 4) / 4.0 * (1 - s);
            const Vec3 to = a + s * (b - a) + h * (c - a);
            if (random.chance(0.5) && length(to - p) < cell)
                p = to;
        }
    };
    const bool places = numbers != FrameNumbers::lattice;
    if (places)
        place(moving.mesh.positions);
    for (const Vec3& p : moving.mesh.positions) {
        const double pinch = 1 - 0.3 * std::exp(-4 * (p.x - 0.5) * (p.x - 0.5));
        moving.end.push_back(Vec3{p.x + 0.2 * p.z, 0.5 + pinch * (p.y - 0.5), 0.2 * p.z} +
                             random.in_cube(0.2 * cell));
    }
    for (int round = 0; places && round < 3; ++round)
        place(moving.end);
    const double steps = numbers == FrameNumbers::lattice ? 32 : 0x1p22;
    const Vec3 origin = numbers == FrameNumbers::far ? Vec3{1e6, -1e6, 1e6} : Vec3{};
    for (auto* points : {&moving.mesh.positions, &moving.end})
        for (Vec3& p : *points)
            p = origin + Vec3{std::round(steps * p.x) / steps, std::round(steps * p.y) / steps,
                              std::round(steps * p.z) / steps};
    return moving;
}

/// A pair of features that meet, and when: an interval about 2^-50 wide.
struct TrueImpact {
    FeatureImpact ids; ///< kind, a and b
    OracleTime first;
};

/// The features of a moving surface that meet, each pair tested in integers by its definition. Only
/// exact boxes save work: features are left out if the boxes of their ways are apart.
struct SymbolicTruth {
    std::vector<TrueImpact> impacts;   ///< in the order of Impacts::list
    std::vector<ElementaryPair> pairs; ///< those whose boxes overlap
    std::vector<bool> meets;           ///< of each pair
    std::size_t near_misses = 0;       ///< pairs that come to lie in one plane, and yet do not meet
    TestCounts counts;                 ///< of the impacts

    explicit SymbolicTruth(const MovingMesh& moving) {
        for_each_feature_pair(
            moving, moving, [&](const FeatureImpact& ids, const ElementaryPair& pair) {
                if (boxes_are_apart(pair))
                    return;
                const CcdOracle<AnyInt> oracle(pair);
                const auto first = oracle.first();
                pairs.push_back(pair);
                meets.push_back(first.has_value());
                if (!first) {
                    near_misses += oracle.comes_into_a_plane() ? 1 : 0;
                    return;
                }
                impacts.push_back({ids, *first});
                ++(ids.kind == ElementaryKind::vertex_face ? counts.vertex_face : counts.edge_edge);
            });
        std::sort(impacts.begin(), impacts.end(), [](const TrueImpact& a, const TrueImpact& b) {
            return list_order(a.ids) < list_order(b.ids);
        });
    }

private:
    static bool boxes_are_apart(const ElementaryPair& pair) {
        const std::size_t first = pair.kind == ElementaryKind::vertex_face ? 1 : 2;
        Box3 a, b;
        for (std::size_t i = 0; i < 4; ++i)
            for (const auto* points : {&pair.start, &pair.end})
                extend(i < first ? a : b, (*points)[i]);
        return a.lower.x > b.upper.x || b.lower.x > a.upper.x || a.lower.y > b.upper.y ||
               b.lower.y > a.upper.y || a.lower.z > b.upper.z || b.lower.z > a.upper.z;
    }
};

} // namespace abut::test
