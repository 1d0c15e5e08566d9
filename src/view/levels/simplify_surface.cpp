#include "view/levels/simplify_surface.h"

#include "core/disjoint_sets.h"
#include "view/levels/packed_normal.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <meshoptimizer.h>
#include <numeric>
#include <tuple>

namespace abut {

namespace {

/// A surface whose vertices are joined where part and position are equal.
struct JoinedSurface {
    std::vector<std::uint32_t> first;   ///< by joined vertex: its first in `members`; one more
    std::vector<std::uint32_t> members; ///< vertices of the surface, sorted by joined vertex
    std::vector<unsigned int> indices;  ///< three joined vertices for each triangle, none flat
};

JoinedSurface join(const LevelSurface& surface) {
    JoinedSurface joined;
    const auto key = [&](std::uint32_t i) {
        const SurfaceVertex& v = surface.vertices[i];
        return std::tuple(v.part, v.position.x, v.position.y, v.position.z, i);
    };
    joined.members.resize(surface.vertices.size());
    std::iota(joined.members.begin(), joined.members.end(), 0U);
    std::sort(joined.members.begin(), joined.members.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<unsigned int> number_of(surface.vertices.size());
    for (std::uint32_t i = 0; i < joined.members.size(); ++i) {
        const SurfaceVertex& v = surface.vertices[joined.members[i]];
        const SurfaceVertex* last = i > 0 ? &surface.vertices[joined.members[i - 1]] : nullptr;
        if (last == nullptr || last->part != v.part || !(last->position == v.position))
            joined.first.push_back(i);
        number_of[joined.members[i]] = static_cast<unsigned int>(joined.first.size() - 1);
    }
    joined.first.push_back(static_cast<std::uint32_t>(joined.members.size()));
    for (const auto& t : surface.triangles) {
        const std::array<unsigned int, 3> c{number_of[t[0]], number_of[t[1]], number_of[t[2]]};
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
            joined.indices.insert(joined.indices.end(), c.begin(), c.end());
    }
    return joined;
}

/// Writes the simplified triangles with, at each vertex, the normal that is nearest to the face.
LevelSurface with_normals(const LevelSurface& from, const JoinedSurface& joined,
                          const std::vector<unsigned int>& indices) {
    LevelSurface to;
    to.parts = from.parts;
    std::vector<std::uint32_t> number_of(from.vertices.size(), 0xffffffff);
    const auto position = [&](unsigned int v) -> const Vec3& {
        return from.vertices[joined.members[joined.first[v]]].position;
    };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vec3 &a = position(indices[i]), &b = position(indices[i + 1]),
                   &c = position(indices[i + 2]);
        const Vec3 face = normalized_or_zero(cross(b - a, c - a));
        auto& triangle = to.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned int v = indices[i + k];
            std::uint32_t best = joined.members[joined.first[v]];
            double most = -2;
            for (std::uint32_t m = joined.first[v]; m < joined.first[v + 1]; ++m) {
                const std::uint32_t member = joined.members[m];
                const double agrees = dot(face, unpack_normal(from.vertices[member].normal));
                if (agrees > most)
                    most = agrees, best = member;
            }
            if (number_of[best] == 0xffffffff) {
                number_of[best] = static_cast<std::uint32_t>(to.vertices.size());
                to.vertices.push_back(from.vertices[best]);
            }
            triangle.at(k) = number_of[best];
        }
    }
    return to;
}

struct Pieces {
    std::vector<std::uint32_t> of_vertex; ///< by joined vertex: the piece's least vertex
    std::vector<double> size;             ///< by least vertex
};

Pieces find_pieces(const JoinedSurface& joined, const std::vector<Vec3>& positions) {
    DisjointSets sets(positions.size());
    for (std::size_t i = 0; i + 2 < joined.indices.size(); i += 3) {
        sets.unite(joined.indices[i], joined.indices[i + 1]);
        sets.unite(joined.indices[i], joined.indices[i + 2]);
    }
    Pieces pieces;
    pieces.of_vertex = std::move(sets).roots();
    std::vector<Box3> boxes(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v)
        extend(boxes[pieces.of_vertex[v]], positions[v]);
    for (const Box3& box : boxes)
        pieces.size.push_back(is_empty(box) ? 0 : length(box.upper - box.lower));
    return pieces;
}

/// Leaves out the smallest pieces until at most `target` triangles are left. Returns the size of
/// the largest one that was left out.
double leave_out_pieces(std::vector<unsigned int>& indices, const Pieces& pieces,
                        std::size_t target) {
    std::vector<std::uint32_t> count(pieces.size.size(), 0);
    for (std::size_t i = 0; i < indices.size(); i += 3)
        ++count[pieces.of_vertex[indices[i]]];
    std::vector<std::uint32_t> order;
    for (std::uint32_t p = 0; p < count.size(); ++p)
        if (count[p] > 0)
            order.push_back(p);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(pieces.size[a], a) < std::pair(pieces.size[b], b);
    });
    std::size_t triangles = indices.size() / 3;
    std::vector<bool> is_out(count.size());
    double largest = 0;
    for (const std::uint32_t p : order) {
        if (triangles <= target)
            break;
        triangles -= count[p];
        is_out[p] = true;
        largest = pieces.size[p];
    }
    std::vector<unsigned int> kept;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        if (!is_out[pieces.of_vertex[indices[i]]])
            kept.insert(kept.end(), indices.begin() + static_cast<std::ptrdiff_t>(i),
                        indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    indices = std::move(kept);
    return largest;
}

} // namespace

SimplifiedSurface simplify(const LevelSurface& surface, std::uint32_t target) {
    SimplifiedSurface result;
    const JoinedSurface joined = join(surface);
    std::vector<Vec3> positions;
    Box3 box;
    for (std::size_t v = 0; v + 1 < joined.first.size(); ++v) {
        positions.push_back(surface.vertices[joined.members[joined.first[v]]].position);
        extend(box, positions.back());
    }
    std::vector<unsigned int> indices = joined.indices;
    if (indices.size() / 3 > target) {
        // Single precision is enough for the choice of vertices, which keep their places.
        const Vec3 middle = 0.5 * (box.lower + box.upper);
        const double extent = std::max(max_abs(box.upper - box.lower), 1e-30);
        std::vector<float> near;
        for (const Vec3& p : positions) {
            const Vec3 q = (1 / extent) * (p - middle);
            for (int k = 0; k < 3; ++k)
                near.push_back(static_cast<float>(component(q, k)));
        }
        float error = 0;
        std::vector<unsigned int> fewer(indices.size());
        const std::size_t size = meshopt_simplify(fewer.data(), indices.data(), indices.size(),
                                                  near.data(), positions.size(), 3 * sizeof(float),
                                                  std::size_t{3} * target, 1, 0, &error);
        fewer.resize(size);
        indices = std::move(fewer);
        result.estimate = double{error} * extent;
        result.left_out =
            leave_out_pieces(indices, find_pieces(joined, positions), target + target / 4);
    }
    result.surface = with_normals(surface, joined, indices);
    return result;
}

} // namespace abut
