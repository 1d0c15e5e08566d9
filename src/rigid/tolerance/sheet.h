#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/face_polygon.h"

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace abut {

/// A surface as a list of triangles whose vertices at equal positions are one vertex. Its triangles may
/// be replaced by pieces of them.
class Sheet {
public:
    using Edge = std::pair<std::uint32_t, std::uint32_t>; ///< two vertices, the lower number first

    explicit Sheet(const WorldSolid& surface);

    [[nodiscard]] std::size_t vertices() const { return positions_.size(); }
    [[nodiscard]] std::size_t triangles() const { return triangles_.size(); }
    [[nodiscard]] const Triangle& triangle(std::uint32_t i) const { return triangles_[i]; }
    [[nodiscard]] const Vec3& position(std::uint32_t vertex) const { return positions_[vertex]; }
    /// The first of the vertices that only pieces have.
    [[nodiscard]] std::uint32_t first_new_vertex() const {
        return static_cast<std::uint32_t>(sorted_);
    }
    /// The vertices of a triangle.
    [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t i) const {
        return corners_[i];
    }
    /// The edge from corner `k` to the next.
    [[nodiscard]] Edge edge(std::uint32_t i, std::size_t k) const {
        return std::minmax(corners_[i][k], corners_[i][(k + 1) % 3]);
    }
    /// The edges of all triangles, sorted. Triangles of the same vertices count once.
    [[nodiscard]] std::vector<Edge> edges_of_faces() const;
    /// The triangles that stand for a triangle of the surface: itself, or its pieces.
    [[nodiscard]] std::vector<std::uint32_t> pieces_of(std::uint32_t number) const;

    /// Replaces a triangle of the surface by convex pieces of it, unless there are none.
    void replace(std::uint32_t number, const std::vector<FacePolygon>& pieces);

private:
    std::uint32_t vertex_at(const Vec3& position);
    void add(const Triangle& t);

    std::vector<Vec3> positions_; ///< those of the surface are sorted; others follow
    std::size_t sorted_ = 0;
    std::vector<Triangle> triangles_; ///< by number in the whole mesh; more pieces follow
    std::vector<std::array<std::uint32_t, 3>> corners_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> more_pieces_; ///< by number of a triangle
};

} // namespace abut
