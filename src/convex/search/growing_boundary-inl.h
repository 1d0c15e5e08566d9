// The boundary of an expanding polytope: triangles around the origin that grow corner by corner.

// Included once for each target.
#if defined(ABUT_CONVEX_GROWING_BOUNDARY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_CONVEX_GROWING_BOUNDARY_INL_H
#undef ABUT_CONVEX_GROWING_BOUNDARY_INL_H
#else
#define ABUT_CONVEX_GROWING_BOUNDARY_INL_H
#endif

#include <abut/convex.h>

#include "convex/search/boundary_face.h"
#include "math/vector.h"
#include "math/xyz-inl.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// A triangle mesh, closed once its first faces are joined. Faces are numbered as they are added;
/// numbers stay.
class GrowingBoundary {
public:
    using Side = DifferencePolytope::Side;
    struct Corner {
        Xyz at;
        VertexPair vertices;
        std::uint32_t cone = 0; ///< while a cone is built: its face that begins at this corner
    };
    using Face = BoundaryFace;

    /// `rounding`: a length that bounds the error of the corners' coordinates.
    explicit GrowingBoundary(double rounding) : rounding_(rounding) {
        corners_.reserve(64);
        faces_.reserve(256);
        visible_.resize(64);
        horizon_.resize(64);
    }

    [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }
    [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
    [[nodiscard]] Vec3 at(std::uint32_t corner) const { return to_vec3(corners_[corner].at); }

    HWY_INLINE void add_corner(const Xyz& at, const VertexPair& vertices) {
        corners_.push_back({at, vertices, 0});
    }
    void remove_corner(std::size_t corner) {
        corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(corner));
    }

    /// Adds a face whose neighbours are still to be joined. Planes are compared by squared
    /// distances, so no square root is taken.
    HWY_INLINE void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Vec3 p = at(a), q = at(b), r = at(c);
        Face& face = faces_.emplace_back();
        face.corners[0] = a, face.corners[1] = b, face.corners[2] = c;
        face.gone = 0;
        const Vec3 normal = cross(q - p, r - p);
        const double height = dot(normal, p), sq = length_sq(normal);
        face.normal = normal;
        face.height = height;
        face.slack = rounding_ * sum_of_sizes(normal);
        // A face without area is never the nearest: its neighbours reach as far.
        face.offset_sq =
            sq > 0 ? height / sq * std::abs(height) : std::numeric_limits<double>::infinity();
    }
    void join(const Side& one, const Side& other) {
        faces_[one.face].across[one.edge] = other;
        faces_[other.face].across[other.edge] = one;
    }

    /// Adds a corner that lies beyond a face: replaces the faces that see it by a cone. False if
    /// two cones share a corner: the border of the faces that see it is not one ring.
    HWY_INLINE bool grow(const Xyz& corner, const VertexPair& vertices, std::uint32_t seen_by) {
        remove_visible(to_vec3(corner), seen_by);
        const auto point = static_cast<std::uint32_t>(corners_.size());
        add_corner(corner, vertices);
        const auto first = static_cast<std::uint32_t>(faces_.size());
        bool one_ring = true;
        for (std::size_t i = 0; i < horizon_count_; ++i) {
            const Side side = horizon_[i];
            const Face& beyond = faces_[side.face];
            const std::uint32_t from = beyond.corners[next(side.edge)],
                                to = beyond.corners[side.edge];
            const auto face = static_cast<std::uint32_t>(faces_.size());
            one_ring = one_ring && corners_[from].cone < first;
            corners_[from].cone = face;
            add_face(from, to, point);
            join({face, 0}, side);
        }
        for (std::uint32_t f = first; f < faces_.size(); ++f)
            join({f, 1}, {corners_[faces_[f].corners[1]].cone, 2});
        is_one_ring_ = one_ring;
        return one_ring;
    }

    /// Returns whether the last corner was joined to one closed ring of edges. If every corner was,
    /// the boundary is closed.
    [[nodiscard]] HWY_INLINE bool is_one_ring() const { return is_one_ring_; }

    /// Replaces an edge by that between the other two corners of its faces.
    void flip(const Side& side) {
        const Side back = faces_[side.face].across[side.edge];
        const Face f = faces_[side.face], g = faces_[back.face];
        const std::uint32_t k = side.edge, j = back.edge;
        const std::uint32_t f_corner = f.corners[next(next(k))],
                            g_corner = g.corners[next(next(j))];
        faces_[side.face].remove(), faces_[back.face].remove();
        const auto left = static_cast<std::uint32_t>(faces_.size()), right = left + 1;
        add_face(f.corners[k], g_corner, f_corner), add_face(g_corner, g.corners[j], f_corner);
        join({left, 1}, {right, 2});
        join({left, 0}, g.across[next(j)]), join({right, 0}, g.across[next(next(j))]);
        join({left, 2}, f.across[next(next(k))]), join({right, 1}, f.across[next(k)]);
    }

    /// The corner of the neighbouring face that is not on the given edge.
    [[nodiscard]] const Corner& corner_across(const Side& side) const {
        const Side beyond = faces_[side.face].across[side.edge];
        return corners_[faces_[beyond.face].corners[next(next(beyond.edge))]];
    }

    /// Returns whether all faces are joined in pairs along their edges. Rounding may prevent that.
    [[nodiscard]] bool is_closed() const {
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (std::uint32_t k = 0; faces_[f].alive() && k < 3; ++k) {
                const Side& other = faces_[f].across[k];
                const Side& back = faces_[other.face].across[other.edge];
                if (!faces_[other.face].alive() || back.face != f || back.edge != k)
                    return false;
            }
        return true;
    }

private:
    static constexpr std::uint32_t next(std::uint32_t k) { return k == 2 ? 0 : k + 1; }

    /// Removes the faces that see the corner, beginning with one of them, and lists the border
    /// around them. (Both lists are always written to, and the counts advance by the tests'
    /// results, since branches could not be predicted.)
    HWY_INLINE void remove_visible(const Vec3& corner, std::uint32_t seen_by) {
        visible_[0] = seen_by;
        faces_[seen_by].gone = 1;
        std::size_t visible = 1, horizon = 0;
        for (std::size_t i = 0; i < visible; ++i) {
            if (visible + 3 > visible_.size())
                visible_.resize(2 * visible_.size());
            if (horizon + 3 > horizon_.size())
                horizon_.resize(2 * horizon_.size());
            for (const Side& side : faces_[visible_[i]].across) {
                Face& beyond = faces_[side.face];
                const double excess = dot(beyond.normal, corner) - beyond.height;
                const std::uint32_t seen = excess > beyond.slack ? 1 : 0;
                const std::uint32_t alive = 1 - beyond.gone;
                visible_[visible] = side.face;
                horizon_[horizon] = side;
                visible += seen & alive;
                horizon += (1 - seen) & alive;
                beyond.gone |= seen;
            }
        }
        for (std::size_t i = 0; i < visible; ++i)
            faces_[visible_[i]].remove();
        horizon_count_ = horizon;
    }

    double rounding_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> visible_; ///< faces, and unused slots
    std::vector<Side> horizon_;          ///< sides of faces that stay, and unused slots
    std::size_t horizon_count_ = 0;      ///< used slots
    bool is_one_ring_ = true;
};

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
