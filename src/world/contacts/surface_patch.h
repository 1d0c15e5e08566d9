#pragma once

#include "core/disjoint_sets.h"
#include "rigid/model/placed_model.h"
#include "world/contacts/convex_faces.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A convex part of a triangle. The side from each corner to the next is an edge of the triangle, or
/// lies in a plane that has cut it off.
struct ClippedTriangle {
    static constexpr std::uint32_t kFirstPlane = 3; ///< sides below it are the triangle's edges
    struct Corner {
        Vec3 at;
        std::uint32_t side = 0;
    };
    boost::container::small_vector<Corner, 9> corners;

    explicit ClippedTriangle(const Triangle& t) : corners{{t[0], 0}, {t[1], 1}, {t[2], 2}} {}
    [[nodiscard]] bool is_empty() const { return corners.empty(); }
    /// Keeps the part inside all planes of a solid, each moved outwards.
    void keep_inside(const ConvexFaces& solid, double outwards);
    /// Half the sum of the cross products of the corners: the area times the normal.
    [[nodiscard]] Vec3 vector_area() const;
};

/// Names an edge between two vertices, in either order.
inline std::uint64_t edge_key(std::uint32_t v, std::uint32_t w) {
    return std::uint64_t{std::min(v, w)} << 32U | std::max(v, w);
}

/// A triangle of a surface that comes near a convex solid.
struct PatchTriangle {
    Triangle corners; ///< in the solid's frame
    Vec3 normal; ///< unit vector, out of the surface's solid; of an open surface towards the solid
    std::array<std::uint32_t, 3> vertices{}; ///< merged
    std::uint32_t triangle = 0;              ///< its number in the surface
    std::uint32_t region = 0;
    double near_area = 0; ///< of its part within the margin
    Vec3 deep_area; ///< vector area of its part clearly inside the solid; zero if there is none
    /// By edge: true if its neighbour lies in the same plane or has the edge's points, or if the edge is
    /// far from the solid. Then no contact point is sought on it.
    std::array<bool, 3> is_flat{};
};

/// The triangles of a surface that come near a convex solid, in regions that hang together there.
class SurfacePatch {
public:
    /// Collects the triangles that come within the margin. Memory of earlier patches is used again.
    ///
    /// In          rounding: bounds that of positions in the solid's frame.
    void collect(const ConvexFaces& solid, const PlacedModel& surface, double facing, double margin,
                 double rounding);

    [[nodiscard]] std::span<const PatchTriangle> triangles() const { return triangles_; }
    [[nodiscard]] std::uint32_t regions() const { return regions_; }
    /// A part of a triangle is clearly inside if it is this many roundings deep.
    static constexpr double kClear = 64;

private:
    void add(const ConvexFaces& solid, const PlacedModel& surface, std::uint32_t slot,
             double facing, double margin, double rounding);
    void connect();
    void unite(std::uint32_t i, std::uint32_t k, bool is_deep);

    /// An edge of a triangle that comes near the solid; the first one with its vertices.
    struct EdgeSlot {
        std::uint64_t key = 0;
        std::uint32_t triangle = 0, used_in = 0;
        std::uint8_t edge = 0, count = 0;
    };
    std::vector<std::uint32_t> slots_;
    std::vector<PatchTriangle> triangles_;
    /// By edge: true if a part of it is within the margin, and if a part is clearly inside the solid.
    struct EdgesOfTriangle {
        std::array<bool, 3> near{}, deep{};
    };
    void begin_edges(std::size_t count);
    EdgeSlot& slot_of(std::uint64_t key);

    std::vector<EdgesOfTriangle> edges_of_; ///< by triangle
    std::vector<EdgeSlot> edges_;
    std::vector<std::array<std::uint32_t, 2>>
        shared_;                           ///< triangles that share an edge within the margin
    DisjointSets sets_;                    ///< of triangles
    std::vector<std::uint8_t> holds_deep_; ///< by root
    std::uint32_t pass_ = 0, regions_ = 0;
};

} // namespace abut
