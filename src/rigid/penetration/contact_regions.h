#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/solid/placed_solid.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Contacts whose common points are connected.
struct RegionContacts {
    std::vector<Contact> contacts;    ///< sorted by pair
    std::vector<Intersection> common; ///< the points that each pair shares
};

/// Splits contacts into connected regions, in the order of their first pairs.
///
/// In          all contacts of the pair, sorted.
/// Accuracy    exact: two contacts with a triangle in common are connected if that triangle meets
///             the edge or vertex that their other triangles share. That is enough: if two contacts
///             without a common triangle meet in a point, contacts that combine their triangles
///             hold the point too. Only surfaces that pass through themselves, or lie on each other
///             without common vertices, can meet otherwise; such regions stay separate.
/// Cost        O(n log n), about six exact tests a contact.
std::vector<RegionContacts> find_regions(const PlacedSolid& a, const PlacedSolid& b,
                                         const std::vector<Contact>& contacts);

/// The vector area that a region's curve encloses, from a to b: half the sum of (p - c) x (q - c)
/// over its segments p q, with c the curve's centroid. A closed curve has the same vector area as
/// every surface that it bounds. An open curve is closed by a fan from c.
///
/// Degenerate  if triangles of the region only touch, the curve is that of b moved by 2^-30 of the
///             pair's size in a fixed direction.
Vec3 enclosed_area(const PlacedSolid& a, const PlacedSolid& b, const RegionContacts& region);

/// The area that the faces of a touching region share.
struct TouchingArea {
    double area = 0;
    Vec3 weighted_normal; ///< sum of area times normal, from a to b
};
TouchingArea touching_area(const PlacedSolid& a, const RegionContacts& region);

/// Assigns points to regions: a point belongs to the region whose common points are nearest.
class RegionCells {
public:
    explicit RegionCells(const std::vector<RegionContacts>& regions);

    /// Returns false only if no point within `radius` of `point` belongs to the region.
    [[nodiscard]] bool may_hold(std::uint32_t region, const Vec3& point, double radius) const;

private:
    /// Consecutive parts of one region's curve.
    struct Chunk {
        Box3 box;
        std::uint32_t region = 0, first = 0, count = 0;
    };
    [[nodiscard]] double nearest_sq(const Chunk& chunk, const Vec3& point, double bound_sq) const;

    std::vector<Triangle> pieces_; ///< segments as triangles without area, polygons as fans
    std::vector<Chunk> chunks_;
};

} // namespace abut
