#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/box_index.h"
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

    /// The triangles that share an edge with one; itself and thin ones are not among them.
    [[nodiscard]] std::span<const std::uint32_t> neighbours(std::uint32_t i) const {
        return std::span(neighbours_)
            .subspan(first_neighbour_[i], first_neighbour_[i + 1] - first_neighbour_[i]);
    }
    /// The sides of triangles at edges where all triangles extend to one side. There the sheet ends, or
    /// goes on at the edge of a triangle with other vertices.
    [[nodiscard]] const std::vector<FaceSide>& loose_sides() const { return loose_; }
    /// Calls visit(number of a loose side) for those whose boxes meet a box.
    template <typename Visit>
    void for_each_loose(const Box3& box, const Visit& visit) const {
        loose_index_.for_each_overlap(box, visit);
    }

private:
    struct EdgeOfTriangle {
        std::pair<std::uint32_t, std::uint32_t> vertices; ///< the lower number first
        std::uint32_t triangle = 0, corner = 0;           ///< the edge's first corner
    };
    [[nodiscard]] std::vector<EdgeOfTriangle> edges() const;
    [[nodiscard]] FaceSide side(const EdgeOfTriangle& edge) const;
    void connect();

    std::vector<Triangle> triangles_; ///< by number in the whole mesh
    std::vector<Vec3> normals_;
    std::vector<std::uint32_t> neighbours_, first_neighbour_; ///< by triangle
    std::vector<FaceSide> loose_;
    BoxIndex loose_index_{{}};
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
