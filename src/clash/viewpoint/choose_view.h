#pragma once

#include <abut/camera.h>
#include <abut/scene.h>
#include <abut/types.h>

#include "math/vector.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace abut {

/// A part that belongs to neither side: it only hides what is behind it.
inline constexpr std::uint32_t kBystander = std::numeric_limits<std::uint32_t>::max();

/// Triangles in the world, each with the index of the part that it belongs to.
struct OwnedTriangles {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> owner; ///< index in ViewSubject::side, or kBystander
};

/// Everything that decides how a clash is looked at.
struct ViewSubject {
    Box3 frame;  ///< fills the picture
    Vec3 middle; ///< the point that the picture is about
    OwnedTriangles geometry;
    std::vector<std::uint8_t> side; ///< of each part that is to be seen: 0 (a) or 1 (b)
    std::vector<Box3> ghosts;       ///< boxes of parts that veil what is behind them
    /// The normal of a section that opens what hides a part. It is best seen from the front.
    std::optional<Vec3> section;
};

struct ChosenView {
    Camera camera;
    std::array<double, 2> shown{}; ///< fraction of the picture that side a and side b cover
};

/// A side that covers less than this fraction of the picture counts as hidden.
inline constexpr double kLeastShown = 0.002;

/// Returns, of 48 directions around, the one that shows most of both sides; of equal ones the
/// first. The score is the cube root of s * s * t, where s is the smaller and t the larger visible
/// area, times the fraction of parts that are visible.
///
/// In          lens: field of view, and the ratio of width to height.
/// Cost        48 pictures of about 2,500 pixels.
ChosenView choose_view(const ViewSubject& subject, UpAxis up, const Camera& lens);

/// Keeps what lies inside of a box. Polygons are cut into triangles.
void cut_to_box(OwnedTriangles& geometry, const Box3& box);
/// Keeps what lies where dot(normal, x) <= offset.
void cut_to_plane(OwnedTriangles& geometry, const Vec3& normal, double offset);

/// Keeps the largest triangles, at most that many, in their order.
void keep_largest(OwnedTriangles& geometry, std::size_t most);

/// Two points that are near each other, and the parts that they lie on.
struct PairPlace {
    std::array<Vec3, 2> points;
    std::array<Box3, 2> boxes; ///< of both parts
};

/// Returns half the side of the cube around the middle of the points that a picture of a pair shows.
double reach_of(const PairPlace& pair);

/// The plane of a section across an axis, turned to the viewer, that opens what hides a part.
struct Opening {
    Vec3 normal;
    double offset = 0; ///< what lies where dot(normal, x) > offset is cut away
};

/// In          towards: direction of view; hidden: box of the part that cannot be seen.
Opening opening_before(const Vec3& towards, const Box3& hidden, const Vec3& middle, double reach);

} // namespace abut
