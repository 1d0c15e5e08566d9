#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"
#include "pieces/exact_plane.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of a patch of a surface while it grows by one vertex at a time: flat at first,
/// then around a volume.
///
/// Vertices are numbers of positions, equal ones merged to one number. All decisions are exact.
class PatchHull {
public:
    explicit PatchHull(std::span<const Vec3> positions) : positions_(positions) {}

    /// Begins anew with a triangle; one without an area has no front.
    void begin(const IndexTriangle& triangle);

    /// The hull with one more vertex. Nothing changes until `take`.
    ///
    /// In          a vertex that no plane of the patch has in front of it.
    void propose(std::uint32_t vertex);
    void take();
    /// Of the vertex proposed: whether the hull gets larger, and the box of what it gains.
    [[nodiscard]] bool grows() const { return grows_; }
    [[nodiscard]] const Box3& gained() const { return gained_; }

    /// Whether the inside of the hull proposed is proven free of a triangle: a plane has it on one
    /// side, and the triangle on the other. The inside of a flat hull is the thin layer just below
    /// it.
    ///
    /// Accuracy    true is proven by exact signs. The planes tried are those of the triangle and of
    ///             the hull's faces, and those through an edge of one and a vertex of the other.
    [[nodiscard]] bool is_free_of(const Triangle& triangle) const;

    [[nodiscard]] bool is_flat() const { return now_.faces.empty(); }
    /// Of a flat patch: whether a coplanar triangle with an area faces the same way.
    [[nodiscard]] bool faces_alike(const Triangle& triangle) const;

private:
    struct Hull {
        std::vector<std::uint32_t> vertices; ///< of a flat hull, around it
        std::vector<IndexTriangle> faces;    ///< none: it is flat
        std::vector<ExactPlane> planes;      ///< of the faces
    };

    [[nodiscard]] const Vec3& at(std::uint32_t v) const { return positions_[v]; }
    void add_face(const IndexTriangle& face);
    [[nodiscard]] bool parts(const ExactPlane& plane, const Triangle& t) const;
    [[nodiscard]] bool parts_edge(const Vec3& p, const Vec3& q, const Triangle& t) const;
    void hull_of_all(std::uint32_t vertex);
    void add_cone(std::uint32_t vertex);
    void gain_of_polygon(std::uint32_t vertex);

    std::span<const Vec3> positions_;
    ExactPlane front_; ///< of a triangle of the patch: what faces as it does is in front
    bool has_front_ = false;
    Hull now_, next_;
    bool grows_ = false;
    Box3 gained_;
    std::vector<IndexTriangle> visible_;
};

} // namespace abut
