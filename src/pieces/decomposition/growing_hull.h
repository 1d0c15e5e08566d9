#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"
#include "pieces/decomposition/exact_plane.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of vertices that span a volume, which grows by one vertex at a time. A step
/// visits only the faces that the new vertex sees. The last step can be undone.
///
/// Faces are triangles; coplanar ones are not merged, and a corner may lie within a face or an edge
/// of the hull. All decisions are exact.
class GrowingHull {
public:
    static constexpr std::uint32_t kNone = 0xffffffffU;

    struct Face {
        IndexTriangle corners{}; ///< counter-clockwise as seen from outside
        IndexTriangle across{};  ///< across[k]: the face beyond the edge from corner k
        ExactPlane plane;
        bool alive = true;
        /// Nothing may be added in front of it; coplanar faces inherit that.
        bool is_closed = false;
    };

    explicit GrowingHull(std::span<const Vec3> positions)
        : positions_(positions), face_at_(positions.size(), kNone),
          cone_from_(positions.size(), kNone) {}

    void clear();
    [[nodiscard]] bool empty() const { return alive_ == 0; }
    /// Begins with a pyramid whose base is closed.
    ///
    /// In          base: a convex polygon, counter-clockwise as seen from outside, with the apex
    ///             strictly behind it.
    void begin(std::span<const std::uint32_t> base, std::uint32_t apex);

    /// Finds the faces that a vertex sees: those that it lies in front of.
    ///
    /// In          near: some corners in a plane through the vertex that has the hull behind it. If
    ///             it is empty, all faces are tested.
    void look_from(std::uint32_t vertex, std::span<const std::uint32_t> near);
    [[nodiscard]] std::span<const std::uint32_t> visible() const { return removed_; }
    /// Replaces the visible faces by a cone from the vertex.
    void grow();
    /// Undoes `grow`.
    void take_back();

    [[nodiscard]] const std::vector<Face>& faces() const { return faces_; } ///< includes dead ones
    [[nodiscard]] std::span<const std::uint32_t> added() const { return added_; }
    [[nodiscard]] std::size_t corner_count() const { return empty() ? 0 : alive_ / 2 + 2; }
    [[nodiscard]] bool is_corner(std::uint32_t vertex) const { return face_at_[vertex] != kNone; }
    /// A face with the largest floating-point height of a point above its plane, compared with its
    /// neighbours. The search starts from a given face; kNone if that is dead.
    [[nodiscard]] std::uint32_t climb(std::uint32_t from, const Vec3& point) const;
    /// Closes the faces in a plane that has the hull behind it.
    ///
    /// In          corner: one in the plane; kNone if none is known.
    void close(const ExactPlane& plane, std::uint32_t corner);

    /// Calls test(face, k) for the faces around a corner, where it is corner k, until one returns
    /// true. Returns whether one did.
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
    /// An edge between a face that stays (`beyond`) and one that goes (`visible`), directed as in
    /// the latter.
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
    std::vector<std::uint32_t> free_;    ///< slots of dead faces
    std::vector<std::uint32_t> face_at_; ///< by vertex: a face with that corner
    /// By vertex: the new face on the edge that begins there.
    std::vector<std::uint32_t> cone_from_;
    std::uint32_t vertex_ = kNone; ///< of the last step
    bool grown_ = false;           ///< if false, the last step has only looked
    std::vector<std::uint32_t> removed_, added_;
    std::vector<HorizonEdge> horizon_;
    std::vector<std::uint32_t> pending_, seen_;
    std::vector<bool> is_seen_; ///< by face; all false between calls
};

} // namespace abut
