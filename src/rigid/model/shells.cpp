#include "rigid/model/shells.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "rigid/model/shell_sets.h"
#include "rigid/model/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace abut {

namespace {

/// Of more shells, boxes are not compared: they may overlap.
constexpr std::size_t kComparedShells = 4096;
/// Of a larger shell, so many triangles tell whether it lies inside others.
constexpr std::size_t kTestedTriangles = 4096;
/// A volume is a sum of triple products. It is taken for 0 if it is below this part of the sum of
/// their terms' sizes: some hundred roundings of a product of three differences.
constexpr double kVolumeRounding = 0x1p-46;

struct Shell {
    Box3 box;                             ///< of one among several
    double volume = 0, size = 0;          ///< six times; the sum of the sizes of its terms
    std::vector<std::uint32_t> triangles; ///< empty until ShellExamination::list_triangles()
    bool is_cavity = false;

    /// The side to which the shell's first triangle faces: 1: outwards; -1: inwards; 0: there is no
    /// inside.
    [[nodiscard]] int side() const {
        return std::abs(volume) <= kVolumeRounding * size ? 0 : volume > 0 ? 1 : -1;
    }
};

enum class Place : std::uint8_t { outside, inside, on };

/// Some triangles of one shell, and the box around them.
struct TriangleGroup {
    Box3 box;
    std::uint32_t shell = 0;
    std::span<const std::uint32_t> triangles;
};

/// Tells where points lie to shells.
class ShellPlaces {
public:
    ShellPlaces(const Mesh& mesh, const std::vector<Shell>& shells,
                const std::vector<bool>& reversed)
        : mesh_(mesh), shells_(shells), reversed_(reversed) {
        constexpr std::size_t kGroup = 32;
        for (std::uint32_t s = 0; s < shells.size(); ++s) {
            const std::span<const std::uint32_t> all(shells[s].triangles);
            for (std::size_t i = 0; i < all.size(); i += kGroup) {
                TriangleGroup group{{}, s, all.subspan(i, std::min(kGroup, all.size() - i))};
                for (const std::uint32_t t : group.triangles)
                    for (const Vec3& p : corners(t))
                        extend(group.box, p);
                groups_.push_back(group);
            }
        }
    }

    /// Where a point lies to the union of some shells, each taken as oriented outwards.
    ///
    /// In          chosen: by shell.
    [[nodiscard]] Place place(const Vec3& p, const std::vector<bool>& chosen) const {
        Box3 all;
        for (std::size_t s = 0; s < shells_.size(); ++s)
            if (chosen[s])
                extend(all, shells_[s].box.lower), extend(all, shells_[s].box.upper);
        if (is_empty(all) || !encloses(all, {p, p}))
            return Place::outside;
        if (is_on(p, chosen))
            return Place::on;
        const Vec3 size = all.upper - all.lower;
        // A segment that leaves the box a little askew, so that it misses edges. Another is tried if
        // it does not; only absurd input reaches the limit.
        for (int attempt = 1; attempt <= 64; ++attempt) {
            const double skew = 0x1p-9 * attempt;
            const Vec3 end{all.upper.x + size.x + max_abs(size),
                           p.y + 0.61 * skew * size.y + skew * 0x1p-20 * size.x,
                           p.z - 0.73 * skew * size.z - skew * 0x1p-21 * size.x};
            if (const auto winding = crossings(p, end, chosen))
                return *winding >= 1 ? Place::inside : Place::outside;
        }
        return Place::outside;
    }

    /// Whether a shell lies inside the union of others: no vertex lies outside, and not all of the
    /// shell on their surface.
    ///
    /// In          strictly: no vertex may lie on their surface.
    [[nodiscard]] bool is_within(const Shell& shell, const std::vector<bool>& chosen,
                                 bool strictly) const {
        const std::size_t step = (shell.triangles.size() - 1) / kTestedTriangles + 1;
        bool any_inside = false;
        for (std::size_t i = 0; i < shell.triangles.size(); i += step)
            for (const Vec3& p : corners(shell.triangles[i])) {
                const Place at = place(p, chosen);
                if (at == Place::outside || (strictly && at == Place::on))
                    return false;
                any_inside |= at == Place::inside;
            }
        for (std::size_t i = 0; i < shell.triangles.size() && !any_inside; i += step) {
            const FaceProbe probe = face_probe(corners(shell.triangles[i]));
            any_inside = place(probe.over, chosen) == Place::inside &&
                         place(probe.under, chosen) == Place::inside;
        }
        return any_inside;
    }

private:
    [[nodiscard]] Triangle corners(std::uint32_t t) const {
        const auto& v = mesh_.triangles[t];
        return {mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]};
    }

    [[nodiscard]] bool is_on(const Vec3& p, const std::vector<bool>& chosen) const {
        for (const TriangleGroup& group : groups_) {
            if (!chosen[group.shell] || !encloses(group.box, {p, p}))
                continue;
            for (const std::uint32_t number : group.triangles) {
                const Triangle t = corners(number);
                const int axis = projection_axis(t);
                if (axis < 0 || orient3d(t[0], t[1], t[2], p) != 0)
                    continue;
                const int u = orient2d(t[0], t[1], p, axis), v = orient2d(t[1], t[2], p, axis),
                          w = orient2d(t[2], t[0], p, axis);
                if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
                    return true;
            }
        }
        return false;
    }

    /// How often some shells wind around the point `from`, less around `to`; none if the segment
    /// meets an edge or a vertex.
    [[nodiscard]] std::optional<int> crossings(const Vec3& from, const Vec3& to,
                                               const std::vector<bool>& chosen) const {
        const Box3 box{min(from, to), max(from, to)};
        int sum = 0;
        for (const TriangleGroup& group : groups_) {
            if (!chosen[group.shell] || !overlap(group.box, box))
                continue;
            const int side = shells_[group.shell].side();
            for (const std::uint32_t number : group.triangles) {
                const auto crossing = crossing_of(from, to, corners(number));
                if (!crossing)
                    return std::nullopt;
                sum += (!reversed_.empty() && reversed_[number] ? -side : side) * *crossing;
            }
        }
        return sum;
    }

    /// +1 if a segment goes through a triangle along its normal, -1 against it, 0 if it misses it;
    /// none if it meets its border or ends in its plane within it.
    static std::optional<int> crossing_of(const Vec3& from, const Vec3& to, const Triangle& t) {
        const int before = orient3d(t[0], t[1], t[2], from), after = orient3d(t[0], t[1], t[2], to);
        if (before * after > 0)
            return 0;
        if (before == 0 && after == 0 && collinear(t[0], t[1], t[2]))
            return 0;
        const int u = orient3d(from, to, t[0], t[1]), v = orient3d(from, to, t[1], t[2]),
                  w = orient3d(from, to, t[2], t[0]);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)))
            return 0;
        if (before == 0 || after == 0 || u == 0 || v == 0 || w == 0)
            return std::nullopt;
        return after;
    }

    const Mesh& mesh_;
    const std::vector<Shell>& shells_;
    const std::vector<bool>& reversed_;
    std::vector<TriangleGroup> groups_;
};

class ShellExamination {
public:
    ShellExamination(const Mesh& mesh, const ShellSets& sets) : mesh_(mesh), sets_(sets) {
        measure();
    }

    ShellOrientation run() {
        const int side = largest().side();
        const bool same_side = std::ranges::all_of(
            shells_, [&](const Shell& s) { return s.side() == 0 || s.side() == side; });
        result_.are_flat = side == 0;
        if (sets_.reversed.empty() && same_side) {
            result_.outward = side;
        } else {
            list_triangles();
            find_cavities();
            set_weights();
        }
        result_.may_overlap = sets_.shares_edges || may_overlap();
        return std::move(result_);
    }

private:
    void measure() {
        shells_.resize(sets_.count);
        std::vector<std::uint32_t> first(sets_.count, ShellSets::kNone); // a vertex of each shell
        const bool are_several = sets_.count > 1;                        // one has no neighbour
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const std::uint32_t number = sets_.shell_of[t];
            if (number == ShellSets::kNone)
                continue;
            Shell& shell = shells_[number];
            const auto& v = mesh_.triangles[t];
            if (first[number] == ShellSets::kNone)
                first[number] = v[0];
            const Vec3& origin = mesh_.positions[first[number]];
            const Vec3 a = mesh_.positions[v[0]] - origin, b = mesh_.positions[v[1]] - origin,
                       c = mesh_.positions[v[2]] - origin;
            const double product = dot(a, cross(b, c));
            shell.volume += is_reversed(t) ? -product : product;
            shell.size += sum_of_sizes(a) * sum_of_sizes(b) * sum_of_sizes(c);
            for (std::size_t k = 0; k < 3 && are_several; ++k)
                extend(shell.box, mesh_.positions[v.at(k)]);
        }
    }

    void list_triangles() {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (sets_.shell_of[t] != ShellSets::kNone)
                shells_[sets_.shell_of[t]].triangles.push_back(t);
    }

    [[nodiscard]] bool is_reversed(std::uint32_t triangle) const {
        return !sets_.reversed.empty() && sets_.reversed[triangle];
    }
    /// The shell of the largest volume: it bounds no cavity of another one.
    [[nodiscard]] const Shell& largest() const {
        return *std::ranges::max_element(shells_, {},
                                         [](const Shell& s) { return std::abs(s.volume); });
    }

    void find_cavities() {
        const ShellPlaces places(mesh_, shells_, sets_.reversed);
        if (!sets_.reversed.empty() || !find_cavities_by_side(places))
            find_cavities_by_depth(places);
    }

    /// Takes shells that face the other way than the largest as cavities. Returns false if one of
    /// them does not lie within the others.
    bool find_cavities_by_side(const ShellPlaces& places) {
        const int side = largest().side();
        std::vector<bool> outer(shells_.size());
        for (std::size_t s = 0; s < shells_.size(); ++s)
            outer[s] = shells_[s].side() == side;
        const bool all_within = std::ranges::all_of(shells_, [&](Shell& shell) {
            return shell.side() != -side ||
                   (shell.is_cavity = places.is_within(shell, outer, false));
        });
        for (Shell& shell : shells_)
            shell.is_cavity &= all_within;
        return all_within;
    }

    /// Takes shells as cavities that lie strictly inside an odd number of others.
    void find_cavities_by_depth(const ShellPlaces& places) {
        std::vector<bool> one(shells_.size());
        for (Shell& shell : shells_) {
            bool odd = false;
            for (std::size_t s = 0; s < shells_.size() && shell.side() != 0; ++s) {
                if (&shells_[s] == &shell || shells_[s].side() == 0 ||
                    !encloses(shells_[s].box, shell.box))
                    continue;
                one[s] = true;
                odd ^= places.is_within(shell, one, true);
                one[s] = false;
            }
            shell.is_cavity = odd;
        }
    }

    void set_weights() {
        result_.weights.resize(mesh_.triangles.size());
        bool any_up = false, any_down = false;
        for (const Shell& shell : shells_)
            for (const std::uint32_t t : shell.triangles) {
                const int side = shell.is_cavity ? -shell.side() : shell.side();
                const int weight = is_reversed(t) ? -side : side;
                any_up |= weight > 0, any_down |= weight < 0;
                result_.weights[t] = static_cast<std::int8_t>(weight);
            }
        result_.outward = any_up && any_down ? 0 : any_up ? 1 : any_down ? -1 : 0;
        if (result_.outward != 0)
            result_.weights.clear();
    }

    [[nodiscard]] bool may_overlap() const {
        if (shells_.size() > kComparedShells)
            return true;
        std::vector<const Shell*> sorted;
        for (const Shell& shell : shells_)
            sorted.push_back(&shell);
        std::ranges::sort(sorted, {}, [](const Shell* s) { return s->box.lower.x; });
        for (std::size_t i = 0; i < sorted.size(); ++i)
            for (std::size_t j = i + 1;
                 j < sorted.size() && sorted[j]->box.lower.x <= sorted[i]->box.upper.x; ++j)
                if (sorted[i]->is_cavity == sorted[j]->is_cavity &&
                    overlap(sorted[i]->box, sorted[j]->box))
                    return true;
        return false;
    }

    const Mesh& mesh_;
    const ShellSets& sets_;
    std::vector<Shell> shells_;
    ShellOrientation result_;
};

} // namespace

ShellOrientation orient_shells(const Mesh& mesh, const Topology& topology,
                               const std::vector<bool>& dropped) {
    const ShellSets sets = find_shells(mesh, topology, dropped);
    ShellOrientation result;
    if (sets.one_sided)
        result.has_parity_only = true;
    else
        result = ShellExamination(mesh, sets).run();
    result.count = sets.count;
    if (result.outward == 0 && result.weights.empty())
        result.has_parity_only = true;
    if (dropped.empty())
        return result;
    if (result.weights.empty())
        result.weights.assign(mesh.triangles.size(), result.outward < 0 ? -1 : 1);
    for (std::size_t t = 0; t < dropped.size(); ++t)
        if (dropped[t])
            result.weights[t] = 0;
    return result;
}

} // namespace abut
