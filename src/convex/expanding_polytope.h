#pragma once

#include <abut/convex.h>

#include "convex/placed_polytope.h"
#include "convex/simplex_search.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace abut {

/// The boundary point of the difference of two polytopes that is nearest to the origin, and what
/// proves it.
struct NearestBoundary {
    Vec3 normal;         ///< unit vector; the difference lies below its plane
    double depth = 0;    ///< the plane's distance: no corner lies farther along the normal
    double at_least = 0; ///< no plane around the difference is nearer
    std::array<VertexPair, 3> corners{}; ///< of the face that the point lies on
    std::array<double, 3> weights{};     ///< of the point
    std::uint32_t steps = 0;             ///< corners that were added
};

/// A polytope inside the difference b - a of two polytopes that grows where its boundary is nearest
/// to the origin, until that is the boundary of the difference.
///
/// Its nearest face is a lower bound of the depth, since it lies inside; the farthest corner of the
/// difference along that face's normal is an upper bound, since its plane has all on one side. When
/// both are equal, to rounding, that is the depth.
///
/// A polytope that is recalled need not be convex any more. If the origin lies below each of its faces,
/// it still has all of the difference's points that are nearer than the nearest plane of a face: seen
/// from the origin, faces that are closed around it cover all directions once. So the lower bound
/// holds.
///
/// Source      [van den Bergen 2001]. Differs: it ends by both bounds, and the faces lie in one
///             list; no heap: the upper bound leaves few to look at. Going on with the last
///             polytope as a whole is ours.
class ExpandingPolytope {
public:
    /// In          `pair` and `rounding` as for `walk`; a simplex that holds the origin.
    ExpandingPolytope(const PolytopePair& pair, double rounding);

    /// Begins with a simplex that holds the origin, to rounding. What it returns, if anything, is the
    /// answer: the difference is flat.
    std::optional<NearestBoundary> begin(const DifferenceSimplex& start);
    /// Begins with a polytope as of other poses, or other bodies. False if its faces do not go around
    /// the origin now.
    bool recall(const DifferencePolytope& last);
    /// After one of both. None if the polytope that was recalled has come to have faces that the
    /// origin is not below.
    std::optional<NearestBoundary> expand();
    /// What it has grown to; empty if that is a large one, or not closed.
    void remember(DifferencePolytope& now) const;

private:
    using Side = DifferencePolytope::Side;
    struct Corner {
        Vec3 at;
        VertexPair vertices;
        std::uint32_t cone = 0; ///< while a cone is built: its face that begins here
    };
    /// Counter-clockwise as seen from outside.
    struct Face {
        std::array<std::uint32_t, 3> corners{};
        std::array<Side, 3> across{}; ///< across[k]: beyond the edge from corner k
        Vec3 normal;
        double offset = 0; ///< of its plane from the origin

        std::uint32_t gone = 0;

        [[nodiscard]] bool alive() const { return gone == 0; }
        /// It is never the nearest then.
        void remove() { gone = 1, offset = std::numeric_limits<double>::infinity(); }
    };

    [[nodiscard]] Corner farthest_corner(const Vec3& direction) const;
    [[nodiscard]] Corner placed(const VertexPair& vertices) const;
    [[nodiscard]] double above(const Face& face, const Vec3& point) const {
        return dot(face.normal, point) - face.offset;
    }
    bool complete(const DifferenceSimplex& start, NearestBoundary& flat);
    void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    std::uint32_t nearest_face();
    void remove_visible(const Vec3& corner, std::uint32_t seen_by);
    void add_corner(const Corner& corner, std::uint32_t seen_by);
    bool fill_dent(const VertexPair& corner, std::uint32_t face);
    void flip(const Side& side);
    void join(const Side& one, const Side& other);
    [[nodiscard]] bool is_closed() const;
    void finish(const Face& face, NearestBoundary& nearest) const;

    const PolytopePair& pair_;
    double rounding_;
    double upper_ = std::numeric_limits<double>::infinity(); ///< of the depth
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> open_; ///< faces that may be the nearest, some that went, and room
    std::size_t open_count_ = 0;      ///< without the room
    std::vector<std::uint32_t> visible_; ///< faces, and room
    std::vector<Side> horizon_;          ///< of faces that stay, and room
    std::size_t horizon_count_ = 0;      ///< without the room
    bool recalled_ = false;
    bool around_ = true; ///< of what was recalled: the origin lies below all faces
};

} // namespace abut
