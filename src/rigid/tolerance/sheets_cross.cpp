#include "rigid/tolerance/sheets_cross.h"

#include "core/disjoint_sets.h"
#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_segment.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/tolerance/point_order.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// Pieces of faces that may be examined to decide whether one part beyond a curve is near.
constexpr std::uint32_t kBudget = 20'000;

using Edge = std::pair<std::uint32_t, std::uint32_t>; ///< two vertices, the lower number first

/// A surface whose vertices at equal positions are merged.
class Sheet {
public:
    explicit Sheet(const WorldSolid& surface) {
        std::vector<std::pair<std::uint32_t, Triangle>> numbered;
        surface.for_each_block(surface.world_box(), [&](const WorldSolid::Block& block) {
            const auto count = block.model.data().mesh().triangles.size();
            for (std::uint32_t i = 0; i < count; ++i) {
                numbered.emplace_back(block.number(i), block.model.world_triangle(i));
            }
            return true;
        });
        std::sort(numbered.begin(), numbered.end(),
                  [](const auto& s, const auto& t) { return s.first < t.first; });
        std::vector<Vec3> positions;
        for (const auto& [number, t] : numbered)
            positions.insert(positions.end(), t.begin(), t.end());
        std::sort(positions.begin(), positions.end(), is_before);
        positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
        vertices_ = positions.size();
        for (const auto& [number, t] : numbered) {
            triangles_.push_back(t);
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = static_cast<std::uint32_t>(
                    std::lower_bound(positions.begin(), positions.end(), t[k], is_before) -
                    positions.begin());
            corners_.push_back(corners);
        }
    }

    [[nodiscard]] std::size_t vertices() const { return vertices_; }
    [[nodiscard]] std::size_t triangles() const { return triangles_.size(); }
    /// A triangle by its number in the whole mesh, and its vertices.
    [[nodiscard]] const Triangle& triangle(std::uint32_t number) const {
        return triangles_[number];
    }
    [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t number) const {
        return corners_[number];
    }
    [[nodiscard]] Edge edge(std::uint32_t number, std::size_t k) const {
        return std::minmax(corners_[number][k], corners_[number][(k + 1) % 3]);
    }

private:
    std::size_t vertices_ = 0;
    std::vector<Triangle> triangles_;
    std::vector<std::array<std::uint32_t, 3>> corners_; ///< vertices, by triangle
};

/// An edge of one sheet that crosses a triangle of the other one, in a contact.
struct Crossing {
    Edge edge;
    std::uint32_t other; ///< triangle
    std::uint32_t contact;
    [[nodiscard]] auto key() const { return std::tie(edge, other); }
};

/// The parts into which a sheet falls along the curves: vertices that are connected by edges which
/// do not cross the other surface.
class Parts {
public:
    Parts(const Sheet& sheet, std::vector<Crossing> crossings)
        : sheet_(sheet), crossings_(std::move(crossings)), sets_(sheet.vertices()) {
        std::sort(crossings_.begin(), crossings_.end(), [](const auto& c, const auto& d) {
            return std::tuple(c.key(), c.contact) < std::tuple(d.key(), d.contact);
        });
        std::vector<Edge> crossed;
        for (const Crossing& c : crossings_)
            crossed.push_back(c.edge);
        for (std::uint32_t i = 0; i < sheet.triangles(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (const Edge e = sheet.edge(i, k);
                    !std::binary_search(crossed.begin(), crossed.end(), e))
                    sets_.unite(e.first, e.second);
    }

    [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }
    std::uint32_t part_of(std::uint32_t vertex) { return sets_.root(vertex); }
    /// The triangles with a vertex in a part, ascending.
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::uint32_t part) {
        if (by_part_.empty()) {
            for (std::uint32_t i = 0; i < sheet_.triangles(); ++i)
                for (const std::uint32_t vertex : sheet_.corners(i))
                    by_part_[part_of(vertex)].push_back(i);
            for (auto& [number, triangles] : by_part_)
                triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        }
        return by_part_[part];
    }

private:
    const Sheet& sheet_;
    std::vector<Crossing> crossings_; ///< sorted by edge, then by triangle
    DisjointSets sets_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_part_;
};

class SheetPair {
public:
    SheetPair(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts,
              double tolerance)
        : solids_{&a, &b}, sheets_{Sheet(a), Sheet(b)},
          contacts_(contacts), options_{.limit = tolerance,
                                        .rounding =
                                            depth_rounding(a, b) + length(sheet_shift(a, b)),
                                        .both_sides = true,
                                        .budget = kBudget},
          curves_(contacts.size()) {
        for (std::uint32_t c = 0; c < contacts.size(); ++c)
            for (std::size_t side = 0; side < 2; ++side)
                contacts_of_[side][triangle_of(contacts[c], side)].push_back(c);
    }

    Proof run() {
        for (std::size_t side = 0; side < 2; ++side)
            parts_[side].emplace(sheets_[side], crossings_of(side));
        connect_curves();
        // By curve: whether the sheet has crossings there, and what is proven of them.
        std::map<std::uint32_t, std::array<std::optional<Proof>, 2>> ends;
        for (std::size_t side = 0; side < 2; ++side)
            for (const Crossing& c : parts_[side]->crossings()) {
                std::optional<Proof>& known = ends[curves_.root(c.contact)][side];
                known = both(known.value_or(Proof::holds), ends_at(side, c.edge));
            }
        Proof all = Proof::holds;
        for (const auto& [curve, known] : ends)
            all =
                both(all, either(known[0].value_or(Proof::fails), known[1].value_or(Proof::fails)));
        return all;
    }

private:
    static Proof both(Proof p, Proof q) {
        if (p == Proof::fails || q == Proof::fails)
            return Proof::fails;
        return p == Proof::holds ? q : p;
    }
    static Proof either(Proof p, Proof q) {
        if (p == Proof::holds || q == Proof::holds)
            return Proof::holds;
        return p == Proof::fails ? q : p;
    }

    [[nodiscard]] std::uint32_t triangle_of(const Contact& contact, std::size_t side) const {
        return side == 0 ? contact.pair.a : contact.pair.b;
    }

    [[nodiscard]] std::vector<Crossing> crossings_of(std::size_t side) const {
        std::vector<Crossing> crossings;
        for (std::uint32_t c = 0; c < contacts_.size(); ++c) {
            const std::uint32_t own = triangle_of(contacts_[c], side),
                                other = triangle_of(contacts_[c], 1 - side);
            const Triangle &t = sheets_[side].triangle(own), &u = sheets_[1 - side].triangle(other);
            if (projection_axis(u) < 0)
                continue;
            for (std::size_t k = 0; k < 3; ++k)
                if (segment_triangle_intersect(t[k], t[(k + 1) % 3], u))
                    crossings.push_back({sheets_[side].edge(own, k), other, c});
        }
        return crossings;
    }

    /// Contacts are on one curve if an edge crosses a triangle where the curve passes on.
    void connect_curves() {
        for (auto& parts : parts_) {
            const std::vector<Crossing>& crossings = parts->crossings();
            for (std::size_t i = 1; i < crossings.size(); ++i)
                if (crossings[i].key() == crossings[i - 1].key())
                    curves_.unite(crossings[i].contact, crossings[i - 1].contact);
        }
    }

    /// Decides whether the sheet ends near the other one on either side of a crossing edge.
    Proof ends_at(std::size_t side, const Edge& edge) {
        return either(is_near(side, edge.first), is_near(side, edge.second));
    }

    /// Decides whether the part of a sheet that holds a vertex is near the other sheet.
    Proof is_near(std::size_t side, std::uint32_t vertex) {
        const std::uint32_t part = parts_[side]->part_of(vertex);
        const auto [at, is_new] = near_[side].try_emplace(part, Proof::holds);
        if (is_new)
            at->second = examine(side, part);
        return at->second;
    }

    Proof examine(std::size_t side, std::uint32_t part) {
        if (seen_[1 - side] == nullptr)
            seen_[1 - side] = solids_[1 - side]->seen_from(origin());
        ReachSearch search(*seen_[1 - side], options_);
        const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
            return search.add({p - origin(), q - origin(), r - origin()}) == Proof::holds;
        };
        for (const std::uint32_t i : parts_[side]->triangles_of(part)) {
            const Triangle& t = sheets_[side].triangle(i);
            std::vector<Vec3> in_part;
            for (std::size_t k = 0; k < 3; ++k)
                if (parts_[side]->part_of(sheets_[side].corners(i)[k]) == part)
                    in_part.push_back(t[k]);
            if (in_part.size() == 3 ? !add(t[0], t[1], t[2])
                                    : !add_beyond_curve(side, i, in_part, add))
                break;
        }
        return search.proof();
    }

    /// Adds what lies between the corners of a crossed triangle that are in the part and the curve.
    template <typename Add>
    bool add_beyond_curve(std::size_t side, std::uint32_t triangle,
                          const std::vector<Vec3>& in_part, const Add& add) const {
        const auto contacts = contacts_of_[side].find(triangle);
        if (contacts == contacts_of_[side].end()) { // crossed only since the shift
            const Triangle& t = sheets_[side].triangle(triangle);
            return add(t[0], t[1], t[2]);
        }
        for (const std::uint32_t c : contacts->second) {
            const Contact& contact = contacts_[c];
            const Intersection common = triangle_triangle_segment(
                sheets_[side].triangle(triangle),
                sheets_[1 - side].triangle(triangle_of(contact, 1 - side)));
            if (common.count == 0)
                continue;
            const Vec3 &p = common.corners[0], &q = common.corners[common.count - 1];
            for (const Vec3& corner : in_part)
                if (!add(corner, p, q))
                    return false;
            if (in_part.size() == 2 &&
                (!add(in_part[0], in_part[1], p) || !add(in_part[0], in_part[1], q)))
                return false;
        }
        return true;
    }

    [[nodiscard]] const Vec3& origin() const { return sheets_[0].triangle(0)[0]; }

    std::array<const WorldSolid*, 2> solids_;
    std::array<Sheet, 2> sheets_;
    std::span<const Contact> contacts_;
    ReachSearch::Options options_;
    DisjointSets curves_; ///< of contacts
    std::array<std::map<std::uint32_t, std::vector<std::uint32_t>>, 2>
        contacts_of_; ///< by triangle
    std::array<std::optional<Parts>, 2> parts_;
    std::array<std::map<std::uint32_t, Proof>, 2> near_; ///< by part
    std::array<std::unique_ptr<const WorldSolid>, 2> seen_;
};

} // namespace

Proof sheets_cross_at_most(const WorldSolid& a, const WorldSolid& b,
                           std::span<const Contact> contacts, double tolerance) {
    return SheetPair(a, b, contacts, tolerance).run();
}

Vec3 sheet_shift(const WorldSolid& a, const WorldSolid& b) {
    // A direction in general position to the axes and to other such directions.
    constexpr Vec3 kDirection{0.30115, 0.54772, 0.78056};
    const double far = std::max(max_abs(a.middle()), max_abs(b.middle()));
    return std::max(0x1p-40 * std::max(a.world_size(), b.world_size()), 0x1p-46 * far) * kDirection;
}

} // namespace abut
