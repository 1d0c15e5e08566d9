#pragma once

#include <abut/model.h>
#include <abut/shapes.h>

#include "rigid/model/faces_overlay.h"
#include "rigid/model/placed_model.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace abut {

/// The faces of solids that overlap, cut where they meet each other, with the number of times that
/// each solid winds around the points on both sides.
///
/// Faces that lie on each other but for rounding, as those of a box that was turned and stands on
/// another one do, are taken as one layer: rounding lets each lie above the other one in places
/// that differ from face to face, so that a common part could count twice or not at all. The sides
/// of a fragment are those of the whole layer there.
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
    /// In          faces: one for each triangle of the mesh. rounding: how far the positions may be off
    ///             those that were meant.
    FaceFragments(Mesh mesh, std::vector<Face> faces, double rounding = 0);

    /// How often the solids wind around points on both sides of a fragment. `over` is where the
    /// triangle's stored normal points.
    struct Sides {
        std::array<int, 2> over{}, under{};
        bool is_first = true;   ///< no triangle of a lower number is in the layer
        bool is_certain = true; ///< the face is cut by all triangles of the layer
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
    /// Accuracy    sides: exact at a point within rounding of the fragment's centroid, but that faces
    ///             of one layer count as one. Corners that are not the triangle's are on it to
    ///             rounding. Parts narrower than 2^-40 of the solids' size, or than 64 of
    ///             their roundings, are not cut off. See uncertainty().
    [[nodiscard]] bool for_each(const std::function<void(const Fragment&)>& visit);

    /// In          after for_each().
    [[nodiscard]] const FacesUncertainty& uncertainty() const { return uncertainty_; }

    [[nodiscard]] const Mesh& mesh() const { return placed_.data().mesh(); }

private:
    using Polygon = std::vector<Vec3>;
    struct Cut {
        Vec3 from, to;
    };

    void find_meetings();
    void find_layers();
    void add_meeting(std::uint32_t f, std::uint32_t g);
    [[nodiscard]] bool is_alone(std::uint32_t f) const {
        return meets_[f].empty() && same_[f].empty();
    }
    [[nodiscard]] bool are_same(std::uint32_t f, std::uint32_t g) const;
    void join_neighbours();
    [[nodiscard]] bool meets(std::uint32_t f, std::uint32_t g) const;
    void add_cuts(const Triangle& f, const Triangle& g, std::vector<Cut>& cuts) const;
    void add_outline(const Triangle& g, std::vector<Cut>& cuts) const;
    [[nodiscard]] std::vector<Polygon> cut(std::uint32_t f);
    [[nodiscard]] double strip_beside(std::uint32_t f, std::uint32_t g) const;
    void add_uncertainty(std::uint32_t f, std::span<const Polygon> parts);
    [[nodiscard]] bool split(const Polygon& polygon, const Vec3& normal, const Cut& cut,
                             std::vector<Polygon>& parts);
    [[nodiscard]] std::optional<Sides> sides(std::uint32_t f, const Vec3& point) const;
    [[nodiscard]] std::optional<Sides> sides_along(std::uint32_t f, const Ray& ray,
                                                   const Vec3& end) const;
    struct Hit;
    [[nodiscard]] std::optional<std::vector<Hit>> hits_along(const Ray& ray, const Vec3& end) const;
    [[nodiscard]] std::pair<std::size_t, std::size_t> layer_around(std::span<const Hit> hits,
                                                                   std::size_t at) const;
    [[nodiscard]] Box3 box_of(std::uint32_t t) const;
    [[nodiscard]] Triangle corners(std::uint32_t t) const { return placed_.world_triangle(t); }

    PlacedModel placed_;
    std::vector<Face> faces_;
    double rounding_;                               ///< of positions, and of points on edges
    double tolerance_;                              ///< the width of what is not cut off
    std::vector<std::vector<std::uint32_t>> meets_; ///< by triangle: those that cut it
    /// By triangle, ascending: those that lie on it but for rounding.
    std::vector<std::vector<std::uint32_t>> same_;
    std::vector<std::vector<std::uint32_t>> layer_; ///< same_, and those that lie on these
    std::vector<double> thickness_;                 ///< by triangle: of its layer
    double rim_ = 0; ///< area of faces over each other, all of it near their borders
    FacesUncertainty uncertainty_;
    std::vector<std::uint32_t> group_; ///< by triangle: those of one group have the same sides
    std::size_t budget_;               ///< of fragments
};

} // namespace abut
