#pragma once

#include <abut/model.h>
#include <abut/shapes.h>

#include "rigid/model/placed_model.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace abut {

/// The faces of solids that overlap, cut where they meet each other, with the number of times that
/// each solid winds around the points on both sides.
///
/// A face that meets no other one but its neighbours, at their common corners, is not cut. Where its
/// neighbours meet none either, one ray tells the sides of all of them.
class FaceFragments {
public:
    /// A triangle of one of two solids.
    struct Face {
        std::uint8_t solid = 0; ///< 0 or 1
        std::int8_t weight = 0; ///< as Solid::weights
    };
    /// In          faces: one for each triangle of the mesh.
    FaceFragments(Mesh mesh, std::vector<Face> faces);

    /// How often the solids wind around points on both sides of a fragment. `over` is where the
    /// triangle's stored normal points.
    struct Sides {
        std::array<int, 2> over{}, under{};
        bool is_first = true; ///< no triangle of a lower number lies on the fragment
    };
    /// A convex part of a triangle.
    struct Fragment {
        std::uint32_t triangle = 0;
        std::vector<Vec3> corners;
        bool is_whole = true; ///< the corners are those of the triangle
        Sides sides;
    };
    /// Calls visit(fragment) for all fragments of triangles that have an area, by triangle. Returns
    /// false, perhaps before the first, if there are too many of them, or if no ray tells the sides
    /// of one.
    ///
    /// Accuracy    sides: exact at a point within rounding of the fragment's centroid. Corners that
    ///             are not the triangle's are on it to rounding. Parts narrower than 2^-40 of the
    ///             solids' size are not cut off.
    [[nodiscard]] bool for_each(const std::function<void(const Fragment&)>& visit);

    [[nodiscard]] const Mesh& mesh() const { return placed_.data().mesh(); }

private:
    using Polygon = std::vector<Vec3>;
    struct Cut {
        Vec3 from, to;
    };

    void find_meetings();
    void join_neighbours();
    [[nodiscard]] bool meets(std::uint32_t f, std::uint32_t g) const;
    void add_cuts(const Triangle& f, const Triangle& g, std::vector<Cut>& cuts) const;
    [[nodiscard]] std::vector<Polygon> cut(std::uint32_t f) const;
    [[nodiscard]] bool split(const Polygon& polygon, const Vec3& normal, const Cut& cut,
                             std::vector<Polygon>& parts) const;
    [[nodiscard]] std::optional<Sides> sides(std::uint32_t f, const Vec3& point) const;
    [[nodiscard]] std::optional<Sides> sides_along(std::uint32_t f, const Ray& ray,
                                                   const Vec3& end) const;
    [[nodiscard]] Triangle corners(std::uint32_t t) const { return placed_.world_triangle(t); }

    PlacedModel placed_;
    std::vector<Face> faces_;
    double tolerance_;
    std::vector<std::vector<std::uint32_t>> meets_; ///< by triangle: those that cut it
    std::vector<std::uint32_t> group_; ///< by triangle: those of one group have the same sides
    std::size_t budget_;               ///< of fragments
};

} // namespace abut
