#pragma once

#include "core/disjoint_sets.h"
#include "math/vector.h"
#include "rigid/model/placed_model.h"
#include "world/curved/curved_side.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A triangle of a surface that may come near a curved solid.
struct NearTriangle {
    Triangle corners;                        ///< relative to the solid's centre
    Vec3 normal;                             ///< unit vector out of the surface's solid
    std::array<std::uint32_t, 3> vertices{}; ///< merged
    std::uint32_t triangle = 0;              ///< its number in the surface
    std::uint32_t plane = 0; ///< triangles in one plane that hang together have one number
    std::uint32_t body =
        0; ///< triangles that hang together over edges inside the solid, unless hollow
    bool is_front = false; ///< whether the solid's centre lies before it
};

/// An edge of near triangles.
struct NearEdge {
    Vec3 from, to;
    std::array<std::uint32_t, 2> vertices{}; ///< merged
    std::array<std::uint32_t, 2>
        triangles{};        ///< places in the list; the same one twice at a border
    bool is_flat = false;   ///< between two triangles in one plane
    bool is_convex = false; ///< between two triangles, and no hollow
    bool is_border = false; ///< of one triangle
    bool is_near = false;   ///< false if it is certainly farther from the solid than the margin
};

/// How far positions may be off, and the largest gap.
struct PatchBounds {
    double margin = 0;
    double rounding = 0;
};

/// The triangles of a surface near a curved solid, and how they hang together.
class CurvedPatch {
public:
    /// Collects the triangles near the solid. Memory of earlier patches is used again.
    ///
    /// In          surface: with its origin at the solid's centre. facing: +1 if its triangles face out of
    ///             its solid, -1 if in; 0 of an open surface, both sides of which are outside: triangles
    ///             then face the solid's centre, as far as those that hang together agree.
    /// Out         false if the centre of the solid does not lie before the triangles nearest to it.
    bool collect(const SupportShape& solid, const PlacedModel& surface, int facing,
                 const PatchBounds& bounds);

    [[nodiscard]] std::span<const NearTriangle> triangles() const { return triangles_; }
    [[nodiscard]] std::span<const NearEdge> edges() const { return edges_; }

private:
    void add(const SupportShape& solid, const PlacedModel& surface, std::uint32_t slot, int facing,
             const PatchBounds& bounds);
    void find_edges();
    void face_centre();
    void mark_edges(const SupportShape& solid, const PatchBounds& bounds);
    void join(const SupportShape& solid, const PatchBounds& bounds);
    [[nodiscard]] bool is_outside() const;

    /// A side of a triangle.
    struct Side {
        std::uint64_t key = 0;
        std::uint32_t triangle = 0, corner = 0;
    };
    std::vector<std::uint32_t> slots_;
    std::vector<NearTriangle> triangles_;
    std::vector<NearEdge> edges_;
    std::vector<Side> sides_;
    std::vector<double> distances_sq_; ///< by triangle: of the solid's centre
    DisjointSets sets_;
};

} // namespace abut
