#include "rigid/model/winding_vote.h"

#include "core/disjoint_sets.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// At most this many patches are probed.
constexpr std::size_t kMostPatches = 64;

Triangle triangle_of(const Mesh& mesh, std::uint32_t i) {
    const auto& t = mesh.triangles[i];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

/// The side of a triangle of a set, by the index of the triangle in the set.
struct SetEdge {
    std::uint32_t lower = 0, upper = 0, index = 0;
    bool is_upwards = false;
    [[nodiscard]] bool is_same(const SetEdge& e) const {
        return lower == e.lower && upper == e.upper;
    }
    friend bool operator<(const SetEdge& e, const SetEdge& f) {
        return std::tie(e.lower, e.upper, e.index) < std::tie(f.lower, f.upper, f.index);
    }
};

/// Gathers what the winding numbers beside the triangles of each patch tell.
class PatchVote {
public:
    explicit PatchVote(std::size_t patches) : weight_(patches, kUnknown) {}

    /// In          the winding numbers over and under a triangle of a patch.
    /// Out         false if they are not those of a solid.
    bool add(std::uint32_t patch, double winding_over, double winding_under) {
        const double over = std::round(winding_over), under = std::round(winding_under);
        if (std::abs(winding_over - over) > kWindingRounding ||
            std::abs(winding_under - under) > kWindingRounding || under < over)
            return false;
        any_forwards_ = any_forwards_ || under > 0 || over > 0;
        any_backwards_ = any_backwards_ || under < 0 || over < 0;
        may_overlap_ = may_overlap_ || !((over == 0 && under == 1) || (over == -1 && under == 0));
        // Between other numbers other triangles are on it, which turn it over or hide it.
        const bool tells = under > over && (over >= 0 || under <= 0);
        if (!tells)
            return true;
        const int weight = over >= 0 ? 1 : -1;
        const bool agrees = weight_[patch] == kUnknown || weight_[patch] == weight;
        weight_[patch] = weight;
        return agrees;
    }

    [[nodiscard]] bool is_mixed() const { return any_forwards_ && any_backwards_; }
    /// Returns whether the triangles have an inside.
    [[nodiscard]] bool has_inside() const { return any_forwards_ || any_backwards_; }
    [[nodiscard]] bool may_overlap() const { return may_overlap_; }
    /// Returns the weight of a patch. One that others hide, or that is not probed, faces as all others
    /// do; it does not count if those differ.
    [[nodiscard]] int weight(std::uint32_t patch) const {
        const int others = is_mixed() ? 0 : any_backwards_ ? -1 : 1;
        return weight_[patch] == kUnknown ? others : weight_[patch];
    }

private:
    static constexpr int kUnknown = 2;
    std::vector<int> weight_;
    bool any_forwards_ = false, any_backwards_ = false, may_overlap_ = false;
};

} // namespace

std::vector<std::uint32_t>
largest_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles, std::size_t count) {
    std::vector<std::pair<double, std::uint32_t>> by_area;
    for (const std::uint32_t i : triangles)
        by_area.emplace_back(-doubled_area_sq(triangle_of(mesh, i)), i);
    count = std::min(count, by_area.size());
    std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count),
                      by_area.end());
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(by_area[i].second);
    return result;
}

std::vector<std::uint32_t> patches_of(const Mesh& mesh, const Topology& topology,
                                      std::span<const std::uint32_t> set, bool flat) {
    const auto are_coplanar = [&](std::uint32_t i, std::uint32_t j) {
        constexpr double kCosineOfADegree = 0.99985;
        const auto normal = [&](std::uint32_t index) {
            const Triangle t = triangle_of(mesh, set[index]);
            return normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        };
        return dot(normal(i), normal(j)) >= kCosineOfADegree;
    };
    std::vector<SetEdge> edges;
    for (std::uint32_t i = 0; i < set.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& t = mesh.triangles[set[i]];
            const std::uint32_t from = topology.vertex_of[t.at(k)],
                                to = topology.vertex_of[t.at((k + 1) % 3)];
            if (from != to)
                edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
        }
    std::sort(edges.begin(), edges.end());
    DisjointSets sets(set.size());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].is_same(edges[begin]))
            ++end;
        if (end - begin == 2 && edges[begin].is_upwards != edges[begin + 1].is_upwards &&
            (!flat || are_coplanar(edges[begin].index, edges[begin + 1].index)))
            sets.unite(edges[begin].index, edges[begin + 1].index);
    }
    return std::move(sets).roots();
}

namespace {

/// The winding numbers over and under a triangle.
struct ProbedTriangle {
    std::uint32_t triangle = 0;
    double over = 0, under = 0;
};

/// Returns the weights if all probes of a patch agree.
std::optional<SetWinding> weights_by(const std::vector<std::uint32_t>& patch_of,
                                     std::span<const std::uint32_t> set,
                                     std::span<const ProbedTriangle> probes, bool are_all_probed) {
    PatchVote vote(set.size());
    for (const ProbedTriangle& p : probes) {
        const auto index = std::ranges::lower_bound(set, p.triangle) - set.begin();
        if (!vote.add(patch_of[static_cast<std::size_t>(index)], p.over, p.under))
            return std::nullopt;
    }
    if (!vote.has_inside() || (vote.is_mixed() && !are_all_probed))
        return std::nullopt;
    SetWinding result{{}, vote.is_mixed(), vote.may_overlap() || vote.is_mixed()};
    for (std::uint32_t i = 0; i < set.size(); ++i)
        result.weights.push_back(static_cast<std::int8_t>(vote.weight(patch_of[i])));
    return result;
}

/// The largest triangle of each patch, the largest first.
std::vector<std::uint32_t> largest_of_patches(const Mesh& mesh,
                                              const std::vector<std::uint32_t>& patch_of,
                                              std::span<const std::uint32_t> set) {
    std::vector<std::pair<double, std::uint32_t>> of_patch(set.size());
    for (std::uint32_t i = 0; i < set.size(); ++i) {
        auto& largest = of_patch[patch_of[i]];
        largest = std::min(largest, {-doubled_area_sq(triangle_of(mesh, set[i])), set[i]});
    }
    std::erase_if(of_patch, [](const auto& p) { return p.first == 0; });
    std::sort(of_patch.begin(), of_patch.end());
    std::vector<std::uint32_t> result;
    result.reserve(of_patch.size());
    for (const auto& [area, triangle] : of_patch)
        result.push_back(triangle);
    return result;
}

} // namespace

std::optional<SetWinding> winding_of(const Mesh& mesh, const Topology& topology,
                                     std::span<const std::uint32_t> set) {
    std::vector<ProbedTriangle> probes;
    const auto probe = [&](std::uint32_t triangle) {
        if (std::ranges::find(probes, triangle, &ProbedTriangle::triangle) != probes.end())
            return true;
        const FaceProbe beside = face_probe(triangle_of(mesh, triangle));
        const auto is_integral = [](double w) {
            return std::abs(w - std::round(w)) <= kWindingRounding;
        };
        const double over = winding_number(mesh, set, beside.over);
        if (!is_integral(over))
            return false;
        const double under = winding_number(mesh, set, beside.under);
        probes.push_back({triangle, over, under});
        return is_integral(under);
    };
    const std::vector<std::uint32_t> first = largest_triangles(mesh, set, kProbes);
    if (first.empty() || !std::ranges::all_of(first, probe))
        return std::nullopt;
    const std::vector<std::uint32_t> flat = patches_of(mesh, topology, set, true);
    std::vector<std::uint32_t> more = largest_of_patches(mesh, flat, set);
    const bool are_all_probed = more.size() <= kMostPatches;
    more.resize(std::min(more.size(), kMostPatches));
    if (!std::ranges::all_of(more, probe))
        return std::nullopt;
    // Faces of two solids may have an edge in common that no other face uses as a whole: then a patch
    // has faces of both, and only flat ones face one way.
    if (auto found =
            weights_by(patches_of(mesh, topology, set, false), set, probes, are_all_probed))
        return found;
    return weights_by(flat, set, probes, are_all_probed);
}

} // namespace abut
