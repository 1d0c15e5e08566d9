#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"
#include "pieces/decomposition/exact_plane.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of vertices with a volume, while it grows by one vertex at a time. Only what the
/// new vertex sees is looked at. The last step may be taken back.
///
/// Faces are triangles, coplanar ones stay apart, and a corner may lie within a face or an edge of
/// the hull. All decisions are exact.
class GrowingHull {
public:
    static constexpr std::uint32_t kNone = 0xffffffffU;

    struct Face {
        IndexTriangle corners{}; ///< counter-clockwise as seen from outside
        IndexTriangle across{};  ///< across[k]: the face beyond the edge from corner k
        ExactPlane plane;
        bool alive = true;
        bool is_closed = false; ///< nothing may be added in front: inherited by coplanar faces
    };

    explicit GrowingHull(std::span<const Vec3> positions)
        : positions_(positions), face_at_(positions.size(), kNone),
          cone_from_(positions.size(), kNone) {}

    void clear();
    [[nodiscard]] bool empty() const { return alive_ == 0; }
    /// Begins with a pyramid; its base is closed.
    ///
    /// In          base: a convex polygon, counter-clockwise as seen from outside, with the apex
    ///             strictly behind it.
    void begin(std::span<const std::uint32_t> base, std::uint32_t apex);

    /// Finds what a vertex sees: the faces that it lies in front of.
    ///
    /// In          near: some corners of a plane through the vertex that has the hull behind it; if
    ///             there is none, nothing, and all faces are looked at.
    void look_from(std::uint32_t vertex, std::span<const std::uint32_t> near);
    [[nodiscard]] std::span<const std::uint32_t> visible() const { return removed_; }
    /// Puts a cone from the vertex in the place of what it sees.
    void grow();
    /// Undoes `grow`.
    void take_back();

    [[nodiscard]] const std::vector<Face>& faces() const { return faces_; } ///< also dead ones
    [[nodiscard]] std::span<const std::uint32_t> added() const { return added_; }
    [[nodiscard]] std::size_t corner_count() const { return empty() ? 0 : alive_ / 2 + 2; }
    [[nodiscard]] bool is_corner(std::uint32_t vertex) const { return face_at_[vertex] != kNone; }
    /// A face whose plane is farther behind a point than those of its neighbours, in floating point;
    /// found from a face on, if that is alive.
    [[nodiscard]] std::uint32_t climb(std::uint32_t from, const Vec3& point) const;
    /// Closes the faces in a plane that has the hull behind it.
    ///
    /// In          corner: one in the plane; kNone if there is none.
    void close(const ExactPlane& plane, std::uint32_t corner);

    /// Calls test(face, k) for the faces around a corner, which is their corner k, until one is true;
    /// whether one was.
    template <typename Test>
    bool any_around(std::uint32_t corner, const Test& test) const {
        const std::uint32_t first = face_at_[corner];
        std::uint32_t f = first;
        do {
            const std::size_t k = corner_in(f, corner);
            if (test(f, k))
                return true;
            f = faces_[f].across[(k + 2) % 3];
        } while (f != first);
        return false;
    }

private:
    /// An edge of a face that stays, seen from a face that goes.
    struct HorizonEdge {
        std::uint32_t from, to, visible, beyond;
    };

    [[nodiscard]] std::size_t corner_in(std::uint32_t face, std::uint32_t vertex) const {
        const IndexTriangle& c = faces_[face].corners;
        return c[0] == vertex ? 0U : c[1] == vertex ? 1U : 2U;
    }
    [[nodiscard]] int side(std::uint32_t face, std::uint32_t vertex) const {
        return faces_[face].plane.side(positions_[vertex]);
    }
    [[nodiscard]] bool lies_in(const ExactPlane& plane, std::uint32_t face) const;
    [[nodiscard]] std::uint32_t find_visible(std::uint32_t vertex,
                                             std::span<const std::uint32_t> near);
    std::uint32_t new_face(const IndexTriangle& corners);
    void put(std::uint32_t face);
    void link_cone();
    void settle();

    std::span<const Vec3> positions_;
    std::vector<Face> faces_;
    std::size_t alive_ = 0;
    std::vector<std::uint32_t> free_;      ///< places of dead faces
    std::vector<std::uint32_t> face_at_;   ///< by vertex: a face of which it is a corner
    std::vector<std::uint32_t> cone_from_; ///< by vertex: the new face on the edge from it
    std::uint32_t vertex_ = kNone;         ///< of the last step
    bool grown_ = false;                   ///< else the last step has only looked
    std::vector<std::uint32_t> removed_, added_;
    std::vector<HorizonEdge> horizon_;
    std::vector<std::uint32_t> pending_, seen_;
    std::vector<bool> is_seen_; ///< by face; all false between questions
};

} // namespace abut
