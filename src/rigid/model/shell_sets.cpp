#include "rigid/model/shell_sets.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

namespace abut {

namespace {

bool same_edge(const HalfEdge& e, const HalfEdge& f) {
    return e.lower() == f.lower() && e.upper() == f.upper();
}

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
        if (parent_[i] == parent_[j] && ((turned_[i] ^ turned_[j]) != 0) == turned)
            return true;
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
    EdgeFan(const Mesh& mesh, std::span<const HalfEdge> uses,
            std::span<const std::uint32_t> sheet_of)
        : e0_(mesh.positions[uses[0].lower()]), e1_(mesh.positions[uses[0].upper()]) {
        for (const HalfEdge& use : uses)
            rays_.push_back({mesh.positions[use.apex], use, use.from < use.to,
                             sheet_of.empty() ? use.triangle : sheet_of[use.triangle]});
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
        std::uint32_t sheet = 0;
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
    /// Rays of one orientation lie in the order of their sheets along the sheets' normal, which points
    /// ahead where matter ends. So two sheets lie in one order at all their common edges.
    [[nodiscard]] bool before(const Ray& r, const Ray& s) const {
        const int turn_r = half_turn(r.apex), turn_s = half_turn(s.apex);
        if (turn_r != turn_s)
            return turn_r < turn_s;
        const int side = turn_r == 1 || turn_r == 3 ? orient3d(e0_, e1_, r.apex, s.apex) : 0;
        if (side != 0 || r.ends != s.ends)
            return side != 0 ? side > 0 : r.ends;
        return r.ends ? r.sheet < s.sheet : s.sheet < r.sheet;
    }

    Vec3 e0_, e1_, first_;
    int axis_ = -1;
    std::vector<Ray> rays_;
};

} // namespace

std::vector<std::pair<HalfEdge, HalfEdge>> pair_uses(const Mesh& mesh,
                                                     std::span<const HalfEdge> uses,
                                                     std::span<const std::uint32_t> sheet_of) {
    if (uses.size() == 2)
        return {{uses[0], uses[1]}};
    if (uses.empty())
        return {};
    return EdgeFan(mesh, uses, sheet_of).pairs();
}

namespace {

/// Connects the triangles of a surface by their edges.
class ShellSearch {
public:
    ShellSearch(const Mesh& mesh, const Topology& topology, const std::vector<bool>& dropped)
        : mesh_(mesh), edges_(topology.half_edges), dropped_(dropped),
          sets_(static_cast<std::uint32_t>(mesh.triangles.size())) {
        result_.shell_of.assign(mesh.triangles.size(), ShellSets::kNone);
    }

    ShellSets run() {
        connect_pairs();
        connect_shared();
        number();
        return std::move(result_);
    }

private:
    [[nodiscard]] bool is_left(const HalfEdge& e) const {
        return dropped_.empty() || !dropped_[e.triangle];
    }

    void unite(std::uint32_t i, std::uint32_t j, bool turned) {
        any_reversed_ |= turned;
        result_.one_sided |= !sets_.unite(i, j, turned);
    }

    /// Connects triangles at edges that two of them use, and notes edges that more use.
    void connect_pairs() {
        const std::size_t size = edges_.size();
        for (std::size_t begin = 0, end = 0; begin < size; begin = end) {
            const HalfEdge& e = edges_[begin];
            const bool is_pair = begin + 1 < size && same_edge(e, edges_[begin + 1]) &&
                                 (begin + 2 == size || !same_edge(e, edges_[begin + 2]));
            if (is_pair && dropped_.empty()) {
                const HalfEdge& f = edges_[begin + 1];
                result_.shell_of[e.triangle] = result_.shell_of[f.triangle] = 0;
                unite(e.triangle, f.triangle, e.from == f.from);
                end = begin + 2;
                continue;
            }
            end = connect_uses(begin);
        }
    }

    /// Connects the triangles at one edge, or notes it. Returns the end of its uses.
    std::size_t connect_uses(std::size_t begin) {
        std::array<std::size_t, 2> first{};
        std::size_t count = 0, end = begin;
        for (; end < edges_.size() && same_edge(edges_[begin], edges_[end]); ++end) {
            if (!is_left(edges_[end]))
                continue;
            if (count < 2)
                first.at(count) = end;
            ++count;
            result_.shell_of[edges_[end].triangle] = 0;
        }
        if (count == 2) {
            const HalfEdge &e = edges_[first[0]], &f = edges_[first[1]];
            unite(e.triangle, f.triangle, e.from == f.from);
        } else if (count > 2) {
            shared_.push_back(edges_.subspan(begin, end - begin));
        }
        return end;
    }

    void connect_shared() {
        result_.shares_edges = !shared_.empty();
        if (shared_.empty())
            return;
        std::vector<std::uint32_t> sheet_of(mesh_.triangles.size());
        for (std::uint32_t t = 0; t < sheet_of.size(); ++t)
            sheet_of[t] = sets_.root(t).root;
        std::vector<HalfEdge> uses;
        for (const std::span<const HalfEdge> edge : shared_) {
            uses.clear();
            std::ranges::copy_if(edge, std::back_inserter(uses),
                                 [&](const HalfEdge& e) { return is_left(e); });
            connect_sheets(uses, sheet_of);
            for (const auto& [begins, ends] : pair_uses(mesh_, uses, sheet_of))
                unite(begins.triangle, ends.triangle, false);
        }
    }

    /// Connects what the two uses of an edge by one sheet have on both sides: the sheet is closed there by
    /// itself. Leaves the other uses.
    void connect_sheets(std::vector<HalfEdge>& uses, std::span<const std::uint32_t> sheet_of) {
        const auto sheet = [&](const HalfEdge& e) { return sheet_of[e.triangle]; };
        std::ranges::stable_sort(uses, {}, sheet);
        std::vector<HalfEdge> left;
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            while (end < uses.size() && sheet(uses[end]) == sheet(uses[begin]))
                ++end;
            if (end - begin == 2 && uses[begin].from != uses[begin + 1].from)
                unite(uses[begin].triangle, uses[begin + 1].triangle, false);
            else
                left.insert(left.end(), uses.begin() + static_cast<std::ptrdiff_t>(begin),
                            uses.begin() + static_cast<std::ptrdiff_t>(end));
        }
        uses = std::move(left);
    }

    /// Numbers the shells in the order of their first triangles.
    void number() {
        const auto triangles = static_cast<std::uint32_t>(mesh_.triangles.size());
        std::vector<std::uint32_t> number(triangles, ShellSets::kNone);
        if (any_reversed_)
            result_.reversed.resize(triangles);
        for (std::uint32_t t = 0; t < triangles; ++t) {
            if (result_.shell_of[t] == ShellSets::kNone)
                continue;
            const OrientedSets::Root root = sets_.root(t);
            if (number[root.root] == ShellSets::kNone)
                number[root.root] = result_.count++;
            result_.shell_of[t] = number[root.root];
            if (any_reversed_)
                result_.reversed[t] = root.turned;
        }
    }

    const Mesh& mesh_;
    std::span<const HalfEdge> edges_;
    const std::vector<bool>& dropped_;
    OrientedSets sets_;
    std::vector<std::span<const HalfEdge>> shared_; ///< the uses of edges that more than two have
    bool any_reversed_ = false;
    ShellSets result_;
};

} // namespace

ShellSets find_shells(const Mesh& mesh, const Topology& topology,
                      const std::vector<bool>& dropped) {
    return ShellSearch(mesh, topology, dropped).run();
}

} // namespace abut
