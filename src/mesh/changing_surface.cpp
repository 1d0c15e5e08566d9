#include "mesh/changing_surface.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

constexpr IndexTriangle kNoTriangle{kNoEdge, kNoEdge, kNoEdge};

std::size_t after(std::size_t k) {
    return k == 2 ? 0 : k + 1;
}
std::size_t before(std::size_t k) {
    return k == 0 ? 2 : k - 1;
}

/// The bit of the first side of a triangle that is this edge; 0 if there is none.
Represented edge_bit(const IndexTriangle& edges, std::uint32_t edge) {
    for (std::size_t k = 0; k < 3; ++k)
        if (edges[k] == edge)
            return static_cast<Represented>(1U << (3 + k));
    return 0;
}

} // namespace

ChangingSurface::ChangingSurface(std::size_t vertices, std::vector<IndexTriangle> triangles,
                                 Assignment assignment)
    : triangles_(std::move(triangles)), features_(make_surface_features(vertices, triangles_)),
      represented_(assign_features({vertices, triangles_, features_}, assignment)),
      first_(vertices, kNoCorner), next_(3 * triangles_.size(), kNoCorner) {
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        link(i);
}

void ChangingSurface::link(std::uint32_t triangle) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Corner corner = 3 * triangle + k;
        next_[corner] = std::exchange(first_[triangles_[triangle][k]], corner);
    }
}

void ChangingSurface::unlink(std::uint32_t triangle) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Corner corner = 3 * triangle + k;
        Corner* place = &first_[triangles_[triangle][k]];
        while (*place != corner)
            place = &next_[*place];
        *place = next_[corner];
    }
}

std::uint32_t ChangingSurface::find_edge(std::uint32_t v, std::uint32_t w) const {
    for (Corner corner = first_[v]; corner != kNoCorner; corner = next_[corner]) {
        const std::uint32_t triangle = corner / 3;
        const std::size_t k = corner % 3;
        if (triangles_[triangle][after(k)] == w)
            return features_.edges_of[triangle][k];
        if (triangles_[triangle][before(k)] == w)
            return features_.edges_of[triangle][before(k)];
    }
    return kNoEdge;
}

std::uint32_t ChangingSurface::new_edge(std::uint32_t v, std::uint32_t w) {
    const std::array ends{std::min(v, w), std::max(v, w)};
    if (free_edges_.empty()) {
        features_.edges.push_back(ends);
        return static_cast<std::uint32_t>(features_.edges.size() - 1);
    }
    const std::uint32_t edge = free_edges_.back();
    free_edges_.pop_back();
    features_.edges[edge] = ends;
    return edge;
}

void ChangingSurface::remove(std::uint32_t triangle) {
    unlink(triangle);
    for (const std::uint32_t edge : features_.edges_of[triangle]) {
        if (edge == kNoEdge || features_.edges[edge][0] == kNoEdge)
            continue;
        if (find_edge(features_.edges[edge][0], features_.edges[edge][1]) != kNoEdge)
            continue;
        features_.edges[edge] = {kNoEdge, kNoEdge};
        free_edges_.push_back(edge);
    }
    features_.edges_of[triangle] = kNoTriangle;
    represented_[triangle] = 0;
}

void ChangingSurface::add(std::uint32_t triangle, const IndexTriangle& vertices) {
    triangles_[triangle] = vertices;
    IndexTriangle& edges = features_.edges_of[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = vertices[k], w = vertices[after(k)];
        if (v == w)
            continue;
        edges[k] = find_edge(v, w);
        for (std::size_t i = 0; i < k; ++i) // a repeated index makes a repeated edge
            if (vertices[i] == w && vertices[after(i)] == v)
                edges[k] = edges[i];
        if (edges[k] == kNoEdge)
            edges[k] = new_edge(v, w);
    }
    link(triangle);
}

/// Gives a feature at a vertex to its first triangle, unless it is represented. bit_at(triangle, k)
/// is the feature's bit in a triangle whose corner k is the vertex, or 0.
template <typename Bit>
void ChangingSurface::represent(std::uint32_t vertex, const Bit& bit_at) {
    std::uint32_t least = kNoCorner;
    for (Corner corner = first_[vertex]; corner != kNoCorner; corner = next_[corner]) {
        const Represented bit = bit_at(corner / 3, corner % 3);
        if ((represented_[corner / 3] & bit) != 0)
            return;
        if (bit != 0)
            least = std::min(least, corner);
    }
    if (least != kNoCorner)
        represented_[least / 3] |= bit_at(least / 3, least % 3);
}

void ChangingSurface::represent(const IndexTriangle& triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = triangle[k], w = triangle[after(k)];
        if (v >= vertices())
            continue;
        represent(v,
                  [](std::uint32_t, std::size_t at) { return static_cast<Represented>(1U << at); });
        if (const std::uint32_t edge = v == w ? kNoEdge : find_edge(v, w); edge != kNoEdge)
            represent(v, [&](std::uint32_t other, std::size_t) {
                return edge_bit(features_.edges_of[other], edge);
            });
    }
}

void ChangingSurface::set(std::size_t vertices, std::span<const IndexTriangle> triangles) {
    const std::size_t count = triangles.size();
    std::vector<std::uint32_t> added;
    std::vector<IndexTriangle> removed;
    for (std::uint32_t i = 0; i < std::max(count, triangles_.size()); ++i) {
        if (i < count && i < triangles_.size() && triangles[i] == triangles_[i])
            continue;
        if (i < triangles_.size()) {
            removed.push_back(triangles_[i]);
            remove(i);
        }
        if (i < count)
            added.push_back(i);
    }
    triangles_.resize(count);
    features_.edges_of.resize(count, kNoTriangle);
    represented_.resize(count);
    next_.resize(3 * count, kNoCorner);
    first_.resize(vertices, kNoCorner);
    for (const std::uint32_t i : added)
        add(i, triangles[i]);
    for (const IndexTriangle& each : removed)
        represent(each);
    for (const std::uint32_t i : added)
        represent(triangles_[i]);
}

std::size_t ChangingSurface::bytes() const {
    return triangles_.size() * sizeof(IndexTriangle) +
           features_.edges.size() * sizeof(features_.edges[0]) +
           features_.edges_of.size() * sizeof(IndexTriangle) + represented_.size() +
           (first_.size() + next_.size() + free_edges_.size()) * sizeof(Corner);
}

} // namespace abut
