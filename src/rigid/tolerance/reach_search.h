#pragma once

#include "rigid/solid/world_solid.h"
#include "rigid/tolerance/face_polygon.h"
#include "rigid/tolerance/known_side.h"

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut {

/// What is known about a question whose search may be given up.
enum class Proof : std::uint8_t {
    holds, ///< proven
    fails, ///< a counterexample was found
    open,  ///< the budget is used up
};

/// Returns what is known of two statements together.
inline Proof both_hold(Proof p, Proof q) {
    if (p == Proof::fails || q == Proof::fails)
        return Proof::fails;
    return p == Proof::holds ? q : p;
}
/// Returns what is known of the statement that one of two holds.
inline Proof either_holds(Proof p, Proof q) {
    if (p == Proof::holds || q == Proof::holds)
        return Proof::holds;
    return p == Proof::fails ? q : p;
}

/// Decides whether all points of some polygons are outside a solid or near its surface.
///
/// A point x is *beyond* if it lies in the solid farther than the limit from the solid's surface.
/// With a second surface, x must also be farther than the limit from that one, and inside it.
/// A search for the deepest point raises the limit whenever it finds a point beyond, and goes on.
///
/// In          all in one frame, near its origin. Only one thread may use the solids.
/// Accuracy    a point found beyond is so by more than the rounding. If none is found and the budget
///             suffices, no point is beyond by more than the rounding.
/// Source      The distance to a convex set is convex. So a polygon whose corners are all within the
///             limit of one triangle has no point beyond it. A polygon that is not proven so is cut
///             by the planes that bound a convex cell around the nearest triangle; every point of
///             the cell is within the limit of the triangle. Flush faces are thus proven by the
///             corners of few pieces, and not by pieces of the size of the limit. A polygon that
///             shares no point with the surface lies on one side of it.
class ReachSearch {
public:
    struct Options {
        double limit = 0;
        /// If positive: a point beyond does not end the search, but raises the limit to its depth and
        /// this part of it.
        double raise = 0;
        double rounding = 0;             ///< of distances between points of the surfaces
        const WorldSolid* own = nullptr; ///< the second surface, if any
        /// Also points outside count: decides whether all points are near the surface.
        bool both_sides = false;
        /// No point over one of these planes is beyond: what polygons have there is left out.
        std::vector<CuttingPlane> bounds{};
        /// Pieces that may be examined, in all polygons together. Each polygon adds kShareOfPolygon
        /// of that, so that surfaces of many faces are decided, too.
        std::uint64_t budget = 0;
    };
    static constexpr double kShareOfPolygon = 1.0 / 4096;

    ReachSearch(const WorldSolid& solid, Options options)
        : solid_(solid), options_(std::move(options)), limit_(options_.limit),
          box_(grown(solid.world_box(), limit_ + options_.rounding)), left_(options_.budget) {}

    /// Examines one more polygon, unless one before was not proven.
    Proof add(const FacePolygon& polygon);
    /// The answer about all polygons so far.
    [[nodiscard]] Proof proof() const { return proof_; }
    /// If the proof fails: a point that is beyond. Of a search that raises the limit: the deepest point
    /// found, if depth() is positive.
    [[nodiscard]] const Vec3& counterexample() const { return counterexample_; }
    /// How far the counterexample is from the solid's surface; 0 without one.
    [[nodiscard]] double depth() const { return depth_; }
    /// The limit that the proof is about.
    [[nodiscard]] double limit() const { return limit_; }

    /// Examines a ball that encloses faces. Returns whether no point of it is beyond; none if that
    /// needs a look at the faces.
    [[nodiscard]] bool rules_out(const Vec3& middle, double radius);
    /// As rules_out(), and looks at the second surface, too.
    [[nodiscard]] bool rules_out_by_either(const Vec3& middle, double radius);

private:
    using Slots = boost::container::static_vector<std::uint32_t, 4>;
    struct Piece {
        FacePolygon polygon;
        /// Triangles that enclosing pieces were near to, the latest first.
        Slots near{}, near_own{};
        KnownSide side{}, side_of_own{};
    };
    /// The piece's middle and what is known about it.
    struct Sample {
        Vec3 point;
        double radius = 0; ///< of a ball around the point that holds the piece
        WorldSolid::Nearest nearest;
    };

    [[nodiscard]] bool rules_out_by(const WorldSolid& surface, KnownSide& side, const Vec3& middle,
                                    double radius);
    [[nodiscard]] FacePolygon within_bounds(FacePolygon polygon) const;
    void examine(Piece& piece);
    [[nodiscard]] bool is_near(const FacePolygon& polygon, const WorldSolid& surface,
                               const Slots& slots) const;
    [[nodiscard]] bool is_near_own(const Piece& piece) const;
    [[nodiscard]] bool settled_by_own(Piece& piece, const Sample& sample, bool deep);
    void move_to_deepest_corner(const FacePolygon& polygon, Sample& sample) const;
    void refute(const Piece& piece, const Sample& sample);
    [[nodiscard]] bool divide_near(const Piece& piece, const PreparedTriangle& t);
    [[nodiscard]] bool cut_away(const Piece& piece, std::span<const CuttingPlane> cell);
    void push(const FacePolygon& polygon, const Piece& parent);
    void halve(const Piece& piece);

    const WorldSolid& solid_;
    const Options options_;
    double limit_;
    const Box3 box_; ///< points outside of it are neither in the solid nor near it
    std::uint64_t left_;
    Proof proof_ = Proof::holds;
    Vec3 counterexample_;
    double depth_ = 0;
    Piece last_; ///< the last that was examined: the next polygon is often near it
    std::vector<Piece> waiting_;
};

} // namespace abut
