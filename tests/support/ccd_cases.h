#pragma once

#include <abut/elementary_impact.h>

#include "math/vector.h"
#include "tests/support/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

/// Elementary pairs of all sorts, and different ways to write the same pair.
namespace abut::test {

inline ElementaryKind any_kind(Random& random) {
    return random.chance(0.5) ? ElementaryKind::vertex_face : ElementaryKind::edge_edge;
}

template <typename Change>
ElementaryPair changed(ElementaryPair pair, const Change& change) {
    for (auto* points : {&pair.start, &pair.end})
        for (Vec3& p : *points)
            p = change(p);
    return pair;
}

/// Coordinates are integers from 0 to n, so that exact contacts of all kinds are frequent. Some
/// pairs move within one plane, are partly or wholly at rest, or have coincident vertices.
inline ElementaryPair lattice_pair(Random& random, int n) {
    ElementaryPair pair{any_kind(random), {}, {}};
    pair = changed(pair, [&](const Vec3&) { return random.on_lattice(n); });
    const auto any = [&] { return static_cast<std::size_t>(random.integer(0, 3)); };
    switch (random.integer(0, 9)) {
    case 0: // in the plane z = 0
        return changed(pair, [](const Vec3& p) { return Vec3{p.x, p.y, 0}; });
    case 1: // in an oblique plane
        return changed(pair, [](const Vec3& p) { return Vec3{p.x, p.y, p.x + p.y}; });
    case 2: // on a line
        return changed(pair, [](const Vec3& p) { return Vec3{p.x, p.x, 0}; });
    case 3:
        pair.end = pair.start;
        return pair;
    case 4: {
        const std::size_t i = any();
        pair.end[i] = pair.start[i];
        return pair;
    }
    case 5: { // a feature degenerates to a point, or an edge of the face does
        const std::size_t i = any(), k = any();
        pair.start[i] = pair.start[k], pair.end[i] = pair.end[k];
        return pair;
    }
    case 6: { // vertices that meet at the end
        pair.end[any()] = pair.end[any()];
        return pair;
    }
    default:
        return pair;
    }
}

/// Arbitrary positions. The motion is as large as the features, or smaller.
inline ElementaryPair random_pair(Random& random) {
    ElementaryPair pair{any_kind(random), {}, {}};
    const double way = std::pow(10, random.uniform(-3, 0));
    for (std::size_t i = 0; i < 4; ++i) {
        pair.start[i] = random.in_cube();
        pair.end[i] = pair.start[i] + random.in_cube(way);
    }
    return pair;
}

/// Features that meet, up to rounding, at a random time and place: in their interiors or on a
/// border.
inline ElementaryPair meeting_pair(Random& random) {
    ElementaryPair pair = random_pair(random);
    const bool face = pair.kind == ElementaryKind::vertex_face;
    const double t = random.chance(0.2) ? random.integer(0, 1) : random.uniform(0, 1);
    const auto parameter = [&] {
        return random.chance(0.2) ? random.integer(0, 1) : random.uniform(0, 1);
    };
    double x = parameter(), y = parameter();
    if (face && x + y > 1)
        x = 1 - x, y = 1 - y;
    const auto at = [&](std::size_t i) { return (1 - t) * pair.start[i] + t * pair.end[i]; };
    const Vec3 gap = face ? (1 - x - y) * at(1) + x * at(2) + y * at(3) - at(0)
                          : (1 - y) * at(2) + y * at(3) - ((1 - x) * at(0) + x * at(1));
    for (std::size_t i = 0; i < (face ? 1U : 2U); ++i) {
        pair.start[i] = pair.start[i] + gap;
        pair.end[i] = pair.end[i] + gap;
    }
    return pair;
}

/// Moves some coordinates by a few units in the last place, and makes some exactly equal.
inline ElementaryPair mutated(Random& random, ElementaryPair pair) {
    const int kind = random.integer(0, 3);
    return changed(pair, [&](Vec3 p) {
        if (kind == 0 && random.chance(0.5))
            p = random.nudge(p, 2);
        if (kind == 1 && random.chance(0.5))
            p.z = 0;
        if (kind == 2 && random.chance(0.3))
            p = pair.start[static_cast<std::size_t>(random.integer(0, 3))];
        return p;
    });
}

/// Writes the same pair of moving features differently.
inline ElementaryPair rewritten(Random& random, ElementaryPair pair) {
    const auto permute = [&](std::size_t i, std::size_t k) {
        std::swap(pair.start[i], pair.start[k]);
        std::swap(pair.end[i], pair.end[k]);
    };
    if (pair.kind == ElementaryKind::vertex_face) {
        permute(1, 1 + random.bits() % 3);
        permute(2, 2 + random.bits() % 2);
    } else {
        if (random.chance(0.5))
            permute(0, 1);
        if (random.chance(0.5))
            permute(2, 3);
        if (random.chance(0.5))
            permute(0, 2), permute(1, 3);
    }
    const int axis = random.integer(0, 2);
    const double sign = random.chance(0.5) ? 1 : -1;
    // Scaling by powers of two and rotation by right angles do not round.
    const double scale = std::ldexp(sign, random.integer(-40, 40));
    return changed(pair, [&](const Vec3& p) {
        return scale * (axis == 0 ? p : axis == 1 ? Vec3{p.y, p.z, p.x} : Vec3{-p.y, p.x, p.z});
    });
}

inline ElementaryPair reversed(ElementaryPair pair) {
    std::swap(pair.start, pair.end);
    return pair;
}

/// The points of impact on both features at the time of impact.
inline std::array<Vec3, 2> impact_points(const ElementaryPair& pair,
                                         const ElementaryImpact& impact) {
    const double t = impact.time;
    const auto& b = impact.barycentric;
    const auto at = [&](std::size_t i) { return (1 - t) * pair.start[i] + t * pair.end[i]; };
    if (pair.kind == ElementaryKind::vertex_face)
        return {at(0), b[0] * at(1) + b[1] * at(2) + b[2] * at(3)};
    return {(1 - b[0]) * at(0) + b[0] * at(1), (1 - b[1]) * at(2) + b[1] * at(3)};
}

/// The largest magnitude of all coordinates.
inline double size_of(const ElementaryPair& pair) {
    double size = 0;
    for (const auto* points : {&pair.start, &pair.end})
        for (const Vec3& p : *points)
            size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return size;
}

} // namespace abut::test

namespace abut {

inline std::ostream& operator<<(std::ostream& out, const ElementaryPair& pair) {
    out << (pair.kind == ElementaryKind::vertex_face ? "vertex-face" : "edge-edge")
        << std::hexfloat;
    for (const auto* points : {&pair.start, &pair.end})
        for (const Vec3& p : *points)
            out << "\n{" << p.x << ", " << p.y << ", " << p.z << "}";
    return out << std::defaultfloat;
}

} // namespace abut
