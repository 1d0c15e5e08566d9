#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/line_piece.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut {

/// A side of a face or of a piece of one.
struct FaceSide {
    LinePiece line;
    Vec3 inward;             ///< unit vector in the face, square to the line, towards the face
    std::uint32_t owner = 0; ///< the face or the piece
};

/// A surface as a list of triangles whose vertices at equal positions are one vertex.
///
/// Frame       the world, with its origin moved to one that is given.
class Sheet {
public:
    /// In      thin: faces that are not higher than that are no part of the sheet; what is on both sides
    ///         of them is as near.
    Sheet(const WorldSolid& surface, const Vec3& origin, double thin);

    [[nodiscard]] std::size_t triangles() const { return triangles_.size(); }
    [[nodiscard]] const Triangle& triangle(std::uint32_t i) const { return triangles_[i]; }
    /// The unit normal of a triangle; zero if it is thin.
    [[nodiscard]] const Vec3& normal(std::uint32_t i) const { return normals_[i]; }

    /// Calls visit(sides) for each edge, with the sides of all triangles there that are not thin.
    template <typename Visit>
    void for_each_edge(const Visit& visit) const {
        for (std::size_t first = 0, last = 0; first < edges_.size(); first = last) {
            while (last < edges_.size() && edges_[last].vertices == edges_[first].vertices)
                ++last;
            std::vector<FaceSide> sides;
            for (std::size_t i = first; i < last; ++i)
                sides.push_back(side(edges_[i].triangle, edges_[i].corner));
            visit(std::span<const FaceSide>(sides));
        }
    }

private:
    struct EdgeOfTriangle {
        std::pair<std::uint32_t, std::uint32_t> vertices; ///< the lower number first
        std::uint32_t triangle = 0, corner = 0;           ///< the edge's first corner
    };
    [[nodiscard]] FaceSide side(std::uint32_t triangle, std::uint32_t corner) const;

    std::vector<Triangle> triangles_; ///< by number in the whole mesh
    std::vector<Vec3> normals_;
    std::vector<EdgeOfTriangle> edges_; ///< sorted by their vertices
};

/// The unit vector in a face with a normal, square to a line in it, that points to the left of the
/// line: inward, if the face's corners are in order.
inline Vec3 left_of(const LinePiece& line, const Vec3& normal) {
    return normalized_or_zero(cross(normal, line.q - line.p));
}

/// Returns whether faces at a line extend from it to the same side.
inline bool same_side(const Vec3& inward, const Vec3& other) {
    constexpr double kAngle = 1e-6;
    return length_sq(inward - other) < kAngle * kAngle;
}

/// The edges, or parts of them, beyond which a sheet does not go on: all faces there extend to one
/// side. Where a vertex of one face lies on the edge of another one, the sheet goes on.
///
/// In          near: positions that are no farther apart are one.
std::vector<FaceSide> border_of(const Sheet& sheet, double near);

} // namespace abut
