#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/placed_solid.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Contacts whose common points are connected.
struct RegionContacts {
    std::vector<Contact> contacts;    ///< sorted by pair
    std::vector<Intersection> common; ///< what each pair shares
};

/// Splits contacts into connected regions, in the order of their first pairs.
///
/// In          all contacts of the pair, sorted.
/// Accuracy    exact: two contacts with a triangle in common are connected if the edge or vertex
///             that their other triangles share meets it. That is enough: where contacts have both
///             triangles different and meet in a point, contacts that mix them hold the point too.
///             Only surfaces that pass through themselves, or lie on each other without common
///             vertices, can meet otherwise; such regions stay apart.
/// Cost        O(n log n), about six exact tests a contact.
std::vector<RegionContacts> find_regions(const PlacedSolid& a, const PlacedSolid& b,
                                         const std::vector<Contact>& contacts);

/// What the curve of a region encloses: half the sum of (p - c) x (q - c) over its segments p q,
/// and so the same for every surface that the curve bounds, where it is closed. An open curve is
/// closed by a fan from its centroid c. Points from a to b.
///
/// Degenerate  where triangles of the region only touch, the curve is that of b moved by 2^-30 of
///             the pair's size in a fixed direction.
Vec3 enclosed_area(const PlacedSolid& a, const PlacedSolid& b, const RegionContacts& region);

/// The faces in common of a region that only touches.
struct TouchingArea {
    double area = 0;
    Vec3 weighted_normal; ///< sum of area times normal, from a to b
};
TouchingArea touching_area(const PlacedSolid& a, const RegionContacts& region);

/// Which region a point belongs to: the one whose common points are nearest.
class RegionCells {
public:
    explicit RegionCells(const std::vector<RegionContacts>& regions);

    /// False only if no point within `radius` of `point` belongs to the region.
    [[nodiscard]] bool may_hold(std::uint32_t region, const Vec3& point, double radius) const;

private:
    /// Some consecutive pieces of one region's curve.
    struct Chunk {
        Box3 box;
        std::uint32_t region = 0, first = 0, count = 0;
    };
    [[nodiscard]] double nearest_sq(const Chunk& chunk, const Vec3& point, double bound_sq) const;

    std::vector<Triangle> pieces_; ///< segments as triangles without area, polygons as fans
    std::vector<Chunk> chunks_;
};

} // namespace abut
