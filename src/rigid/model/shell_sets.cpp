#include "rigid/model/shell_sets.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

namespace abut {

namespace {

/// Disjoint sets whose members are oriented like the root of their set, or against it.
class OrientedSets {
public:
    explicit OrientedSets(std::size_t count) : parent_(count), turned_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    struct Root {
        std::uint32_t root = 0;
        bool turned = false; ///< the member is oriented against the root
    };
    Root root(std::uint32_t i) {
        bool turned = false;
        while (parent_[i] != i) {
            const std::uint32_t above = parent_[i];
            // Halves the path: i's new parent is its parent's parent.
            turned_[i] ^= turned_[above];
            parent_[i] = parent_[above];
            turned ^= turned_[i] != 0;
            i = parent_[i];
        }
        return {i, turned};
    }

    /// Unites two sets. Returns false if their members are in one set that says otherwise.
    bool unite(std::uint32_t i, std::uint32_t j, bool turned) {
        const Root a = root(i), b = root(j);
        const bool turn = (a.turned != b.turned) != turned;
        if (a.root == b.root)
            return !turn;
        const auto [low, high] = std::minmax({a.root, b.root});
        parent_[high] = low;
        turned_[high] = turn ? 1 : 0;
        return true;
    }

private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> turned_; ///< against the parent
};

/// The uses of an edge in the order in which they lie around it, and pairs of them that enclose
/// matter.
class EdgeFan {
public:
    EdgeFan(const Mesh& mesh, std::span<const HalfEdge> uses)
        : e0_(mesh.positions[uses[0].lower()]), e1_(mesh.positions[uses[0].upper()]) {
        for (const HalfEdge& use : uses)
            rays_.push_back({mesh.positions[use.apex], use, use.from < use.to});
        const auto seen =
            std::ranges::find_if(rays_, [&](const Ray& r) { return !collinear(e0_, e1_, r.apex); });
        first_ = seen == rays_.end() ? rays_.front().apex : seen->apex;
        axis_ = seen == rays_.end() ? -1 : projection_axis({e0_, e1_, first_});
        std::stable_sort(rays_.begin(), rays_.end(),
                         [&](const Ray& r, const Ray& s) { return before(r, s); });
    }

    /// Returns pairs of uses: going around the edge counter-clockwise, matter begins at the first one
    /// and ends at the second.
    [[nodiscard]] std::vector<std::pair<HalfEdge, HalfEdge>> pairs() const {
        std::vector<HalfEdge> begun, ended;
        std::vector<std::pair<HalfEdge, HalfEdge>> result;
        for (const Ray& r : rays_) {
            if (!r.ends)
                begun.push_back(r.use);
            else if (begun.empty())
                ended.push_back(r.use);
            else
                result.emplace_back(begun.back(), r.use), begun.pop_back();
        }
        for (const HalfEdge& use : ended)
            result.emplace_back(begun.back(), use), begun.pop_back();
        return result;
    }

private:
    struct Ray {
        Vec3 apex;
        HalfEdge use{};
        bool ends = false; ///< matter ends here: the triangle runs from the lower vertex upwards
    };

    /// The angle from the first ray, counter-clockwise: 0: none; 1: less than half a turn; 2: half a
    /// turn; 3: more.
    [[nodiscard]] int half_turn(const Vec3& apex) const {
        if (axis_ < 0 || collinear(e0_, e1_, apex))
            return 0;
        const int side = orient3d(e0_, e1_, first_, apex);
        if (side != 0)
            return side > 0 ? 1 : 3;
        return orient2d(e0_, e1_, first_, axis_) == orient2d(e0_, e1_, apex, axis_) ? 0 : 2;
    }
    /// Of rays at one angle, those where matter ends come first: no matter lies between two of them.
    [[nodiscard]] bool before(const Ray& r, const Ray& s) const {
        const int turn_r = half_turn(r.apex), turn_s = half_turn(s.apex);
        if (turn_r != turn_s)
            return turn_r < turn_s;
        const int side = turn_r == 1 || turn_r == 3 ? orient3d(e0_, e1_, r.apex, s.apex) : 0;
        return side != 0 ? side > 0 : r.ends && !s.ends;
    }

    Vec3 e0_, e1_, first_;
    int axis_ = -1;
    std::vector<Ray> rays_;
};

} // namespace

std::vector<std::pair<HalfEdge, HalfEdge>> pair_uses(const Mesh& mesh,
                                                     std::span<const HalfEdge> uses) {
    if (uses.size() == 2)
        return {{uses[0], uses[1]}};
    if (uses.empty())
        return {};
    return EdgeFan(mesh, uses).pairs();
}

ShellSets find_shells(const Mesh& mesh, const Topology& topology,
                      const std::vector<bool>& dropped) {
    const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    const std::vector<HalfEdge>& edges = topology.half_edges;
    ShellSets result;
    OrientedSets sets(triangles);
    std::vector<HalfEdge> uses;
    bool any_reversed = false;
    result.shell_of.assign(triangles, ShellSets::kNone);
    const auto unite = [&](std::uint32_t i, std::uint32_t j, bool turned) {
        any_reversed |= turned;
        result.one_sided |= !sets.unite(i, j, turned);
    };
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        uses.clear();
        while (end < edges.size() && edges[end].lower() == edges[begin].lower() &&
               edges[end].upper() == edges[begin].upper()) {
            if (dropped.empty() || !dropped[edges[end].triangle])
                uses.push_back(edges[end]);
            ++end;
        }
        result.shares_edges |= uses.size() > 2;
        if (uses.size() == 2)
            unite(uses[0].triangle, uses[1].triangle, uses[0].from == uses[1].from);
        else if (uses.size() > 2)
            for (const auto& [begins, ends] : pair_uses(mesh, uses))
                unite(begins.triangle, ends.triangle, false);
        for (const HalfEdge& use : uses)
            result.shell_of[use.triangle] = 0;
    }
    std::vector<std::uint32_t> number(triangles, ShellSets::kNone);
    if (any_reversed)
        result.reversed.resize(triangles);
    for (std::uint32_t t = 0; t < triangles; ++t) {
        if (result.shell_of[t] == ShellSets::kNone)
            continue;
        const OrientedSets::Root root = sets.root(t);
        if (number[root.root] == ShellSets::kNone)
            number[root.root] = result.count++;
        result.shell_of[t] = number[root.root];
        if (any_reversed)
            result.reversed[t] = root.turned;
    }
    return result;
}

} // namespace abut
