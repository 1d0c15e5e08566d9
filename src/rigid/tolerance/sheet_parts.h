#pragma once

#include "core/disjoint_sets.h"
#include "rigid/tolerance/reach_search.h"
#include "rigid/tolerance/sheet.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace abut {

/// A triangle of one sheet and one of another that share a point.
struct SheetContact {
    std::uint32_t own = 0, other = 0; ///< triangles
    std::uint32_t contact = 0;        ///< the contact of the surfaces of which this is a part
};

/// An edge of one sheet that crosses a triangle of the other one.
struct SheetCrossing {
    Sheet::Edge edge;
    std::uint32_t other = 0;   ///< triangle
    std::uint32_t contact = 0; ///< as SheetContact::contact
    [[nodiscard]] auto key() const { return std::tie(edge, other); }
};

/// The crossings in all contacts, sorted by edge, then by the other triangle, then by contact.
std::vector<SheetCrossing> crossings_in(std::span<const SheetContact> contacts, const Sheet& own,
                                        const Sheet& other);

/// The parts into which a sheet falls along the curves in which it crosses another one: vertices that
/// are connected by edges which do not cross it. A vertex of a piece may lie on an edge of another
/// piece. Decides which parts are near the other sheet.
class SheetParts {
public:
    /// In      contacts: all. surface: that of `other`. options: as everywhere_near().
    SheetParts(const Sheet& own, const Sheet& other, std::vector<SheetContact> contacts,
               const WorldSolid& surface, const ReachSearch::Options& options);

    [[nodiscard]] const std::vector<SheetCrossing>& crossings() const { return crossings_; }

    /// Decides whether the sheet ends near the other one on either side of a crossing edge.
    Proof ends_at(const SheetCrossing& crossing);

    /// The shortest length found by which a part that is not near goes on beyond the other sheet.
    struct Beyond {
        double length = 0;
        Vec3 point; ///< in the world
    };
    [[nodiscard]] const std::optional<Beyond>& beyond() const { return beyond_; }

private:
    void unite_along_edges();
    void unite_on_edges();
    [[nodiscard]] bool is_crossed(const Sheet::Edge& edge) const;
    [[nodiscard]] bool crosses(const Vec3& p, const Vec3& q) const;
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::uint32_t part);
    Proof is_near(std::uint32_t vertex);
    Proof examine(std::uint32_t part);
    bool add(const Vec3& p, const Vec3& q, const Vec3& r, ReachSearch& search) const;
    bool add_beyond_curve(std::uint32_t triangle, const std::vector<Vec3>& in_part,
                          ReachSearch& search) const;

    const Sheet &own_, &other_;
    const std::vector<SheetContact> contacts_; ///< sorted by the own triangle
    const Vec3 origin_;
    const std::unique_ptr<const WorldSolid> seen_; ///< the other surface, seen from there
    const ReachSearch::Options options_;
    const std::vector<SheetCrossing> crossings_;
    DisjointSets sets_;                                           ///< of vertices
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_part_; ///< triangles with a vertex in it
    std::map<std::uint32_t, Proof> near_;                         ///< by part
    std::optional<Beyond> beyond_;
};

} // namespace abut
