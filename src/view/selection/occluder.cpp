#include "view/selection/occluder.h"

#include "math/vector.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <unordered_map>

namespace abut {

namespace {

constexpr std::size_t kMostOccluders = 8, kMostOccluderTriangles = 128;

struct ChunkTriangle {
    std::uint32_t part = 0;
    std::uint32_t first = 0; ///< its first index in the chunk
    double area = 0;
};

Vec3 position_of(const ViewChunk& chunk, std::uint16_t vertex) {
    const auto& p = chunk.vertices[vertex].position;
    return {chunk.lower[0] + double{chunk.step[0]} * p[0],
            chunk.lower[1] + double{chunk.step[1]} * p[1],
            chunk.lower[2] + double{chunk.step[2]} * p[2]};
}

/// The triangles of a chunk, sorted by part, then by falling area.
std::vector<ChunkTriangle> sorted_triangles(const ViewChunk& chunk) {
    std::vector<ChunkTriangle> triangles;
    for (std::uint32_t i = 0; i + 2 < chunk.indices.size(); i += 3) {
        const Vec3 a = position_of(chunk, chunk.indices[i]),
                   b = position_of(chunk, chunk.indices[i + 1]),
                   c = position_of(chunk, chunk.indices[i + 2]);
        const double area = 0.5 * length(cross(b - a, c - a));
        if (area > 0)
            triangles.push_back({chunk.vertices[chunk.indices[i]].part, i, area});
    }
    std::ranges::sort(triangles, [](const ChunkTriangle& a, const ChunkTriangle& b) {
        if (a.part != b.part)
            return a.part < b.part;
        return a.area != b.area ? a.area > b.area : a.first < b.first;
    });
    return triangles;
}

/// Lists the edges, joined where two triangles continue each other.
void find_edges(Occluder& occluder) {
    using Key = std::array<std::uint16_t, 2>;
    std::map<Key, std::vector<std::pair<std::uint16_t, bool>>> users; // triangle, is it reversed
    for (std::size_t t = 0; t < occluder.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint16_t a = occluder.triangles[t].at(i),
                                b = occluder.triangles[t].at((i + 1) % 3);
            users[{std::min(a, b), std::max(a, b)}].emplace_back(static_cast<std::uint16_t>(t),
                                                                 a > b);
        }
    for (const auto& [vertices, of] : users) {
        if (of.size() == 2 && of[0].second != of[1].second) {
            occluder.edges.push_back({vertices, {of[0].first, of[1].first}});
            continue;
        }
        occluder.is_open = true;
        for (const auto& user : of)
            occluder.edges.push_back({vertices, {user.first, Occluder::kNoTriangle}});
    }
}

/// Makes an occluder of triangles of one part. Vertices at one position become one.
Occluder occluder_of(const ViewChunk& chunk, const std::vector<ChunkTriangle>& triangles,
                     std::size_t begin, std::size_t end) {
    Occluder occluder;
    occluder.part = triangles[begin].part;
    std::unordered_map<std::uint64_t, std::uint16_t> numbers;
    Box3 box;
    for (std::size_t t = begin; t < std::min(end, begin + kMostOccluderTriangles); ++t) {
        std::array<std::uint16_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint16_t vertex = chunk.indices[triangles[t].first + i];
            const auto& p = chunk.vertices[vertex].position;
            const std::uint64_t key =
                std::uint64_t{p[0]} | std::uint64_t{p[1]} << 16U | std::uint64_t{p[2]} << 32U;
            const auto [found, is_new] =
                numbers.try_emplace(key, static_cast<std::uint16_t>(occluder.vertices.size()));
            if (is_new) {
                const Vec3 at = position_of(chunk, vertex);
                occluder.vertices.push_back(
                    {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)});
                extend(box, at);
            }
            corners.at(i) = found->second;
        }
        occluder.triangles.push_back(corners);
        occluder.area += static_cast<float>(triangles[t].area);
    }
    occluder.lower = {static_cast<float>(box.lower.x), static_cast<float>(box.lower.y),
                      static_cast<float>(box.lower.z)};
    occluder.upper = {static_cast<float>(box.upper.x), static_cast<float>(box.upper.y),
                      static_cast<float>(box.upper.z)};
    find_edges(occluder);
    return occluder;
}

} // namespace

std::vector<Occluder> find_occluders(const ViewChunk& chunk) {
    struct PartRange {
        std::size_t begin = 0, end = 0;
        double area = 0;
    };
    const std::vector<ChunkTriangle> triangles = sorted_triangles(chunk);
    std::vector<PartRange> parts;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (i == 0 || triangles[i].part != triangles[i - 1].part)
            parts.push_back({i, i, 0});
        parts.back().end = i + 1;
        if (i - parts.back().begin < kMostOccluderTriangles)
            parts.back().area += triangles[i].area;
    }
    std::ranges::sort(parts, [](const PartRange& a, const PartRange& b) {
        return a.area != b.area ? a.area > b.area : a.begin < b.begin;
    });
    std::vector<Occluder> occluders;
    for (std::size_t i = 0; i < std::min(parts.size(), kMostOccluders); ++i)
        occluders.push_back(occluder_of(chunk, triangles, parts[i].begin, parts[i].end));
    return occluders;
}

} // namespace abut
