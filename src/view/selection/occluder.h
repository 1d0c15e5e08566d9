#pragma once

#include <abut/view.h>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// The largest faces of a part: a mesh of few triangles that may hide what is behind it.
struct Occluder {
    /// An edge of one or two triangles. An edge where triangles do not continue each other (more
    /// than two meet, or their windings differ) is listed once for each of them.
    struct Edge {
        std::array<std::uint16_t, 2> vertices{};
        std::array<std::uint16_t, 2> triangles{};
    };
    static constexpr std::uint16_t kNoTriangle = 0xffff;

    std::vector<std::array<float, 3>> vertices; ///< world minus the tree's origin
    std::vector<std::array<std::uint16_t, 3>> triangles;
    std::vector<Edge> edges;
    std::array<float, 3> lower{}, upper{};
    float area = 0;
    std::uint32_t part = 0;
    bool is_open = false; ///< an edge has one triangle only

    [[nodiscard]] std::uint64_t bytes() const {
        return sizeof(Occluder) + vertices.capacity() * sizeof(vertices[0]) +
               triangles.capacity() * sizeof(triangles[0]) + edges.capacity() * sizeof(Edge);
    }
};

/// At most the bytes of all occluders of a chunk.
inline constexpr std::uint64_t kMostOccluderBytes = std::uint64_t{64} << 10;

/// Returns the occluders of the parts with the largest surfaces in a chunk that is not instanced:
/// at most 8, of at most 128 triangles each.
std::vector<Occluder> find_occluders(const ViewChunk& chunk);

} // namespace abut
