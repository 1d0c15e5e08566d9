#include "rigid/model/open_solids.h"

#include "core/disjoint_sets.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

namespace abut {

namespace {

Triangle corners_of(const Mesh& mesh, std::uint32_t i) {
    const auto& t = mesh.triangles[i];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

/// Returns the largest of some triangles.
std::vector<std::uint32_t>
largest_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles, std::size_t count) {
    std::vector<std::pair<double, std::uint32_t>> by_area;
    for (const std::uint32_t i : triangles)
        by_area.emplace_back(-doubled_area_sq(corners_of(mesh, i)), i);
    count = std::min(count, by_area.size());
    std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count),
                      by_area.end());
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(by_area[i].second);
    return result;
}

/// Returns how some triangles of a mesh are oriented, if they bound a solid but for T-junctions.
int outward_by_winding(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
    OutwardVote vote;
    for (const std::uint32_t i : largest_triangles(mesh, triangles, kProbes)) {
        if (vote.failed())
            break;
        const FaceProbe probe = face_probe(corners_of(mesh, i));
        const double over = winding_number(mesh, triangles, probe.over);
        if (OutwardVote::side(over) == 0)
            return 0;
        vote.add(over, winding_number(mesh, triangles, probe.under));
    }
    return vote.outward();
}

/// Sets of triangles that are connected by vertices, in the order of their first triangles.
std::vector<std::vector<std::uint32_t>> connected(const Mesh& mesh, const Topology& topology,
                                                  std::span<const std::uint32_t> triangles) {
    DisjointSets sets(mesh.positions.size());
    const auto vertex = [&](std::uint32_t t, std::size_t k) {
        return topology.vertex_of[mesh.triangles[t].at(k)];
    };
    for (const std::uint32_t t : triangles)
        sets.unite(vertex(t, 0), sets.unite(vertex(t, 1), vertex(t, 2)));
    std::map<std::uint32_t, std::size_t> number;
    std::vector<std::vector<std::uint32_t>> result;
    for (const std::uint32_t t : triangles) {
        const auto [at, is_new] = number.try_emplace(sets.root(vertex(t, 0)), result.size());
        if (is_new)
            result.emplace_back();
        result[at->second].push_back(t);
    }
    return result;
}

} // namespace

OpenSolids find_open_solids(const Mesh& mesh, const Topology& topology, const CleanSurface& clean) {
    using Numbers = std::vector<std::uint32_t>;
    OpenSolids result;
    const auto take = [&](const Numbers& set) {
        const int outward = outward_by_winding(mesh, set);
        if (outward != 0)
            result.solids.push_back({set, outward});
        return outward != 0;
    };
    const auto merge = [](const Numbers& a, const Numbers& b) {
        Numbers both;
        std::ranges::merge(a, b, std::back_inserter(both));
        return both;
    };
    const bool are_one = take(clean.open);
    const Numbers left = are_one ? clean.hanging : merge(clean.open, clean.hanging);
    const bool is_new = are_one || !clean.hanging.empty();
    if (left.empty() || (is_new && take(left)))
        return result;
    // A face that a solid shares with a closed one was dropped as a copy of that one's.
    const Numbers with_copies = merge(left, clean.copies);
    if (!clean.copies.empty() && take(with_copies))
        return result;
    for (const Numbers& set : connected(mesh, topology, with_copies)) {
        Numbers own;
        std::ranges::set_difference(set, clean.copies, std::back_inserter(own));
        if (take(own) || (own.size() < set.size() && !own.empty() && take(set)))
            continue;
        for (const std::uint32_t t : own) {
            const bool hangs = std::ranges::binary_search(clean.hanging, t);
            result.has_sheets = result.has_sheets || hangs;
            if (!hangs)
                result.rest.push_back(t);
        }
    }
    std::ranges::sort(result.rest);
    return result;
}

bool may_overlap(const Mesh& mesh, const Solid& solid, const std::vector<OpenSolid>& solids) {
    std::vector<bool> is_open(mesh.triangles.size());
    std::vector<Box3> boxes(solids.size() + 1);
    const auto add = [&](std::size_t box, std::uint32_t t) {
        for (const Vec3& p : corners_of(mesh, t))
            extend(boxes[box], p);
    };
    for (std::size_t i = 0; i < solids.size(); ++i)
        for (const std::uint32_t t : solids[i].triangles)
            is_open[t] = true, add(i + 1, t);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (!is_open[t] && solid.weight(t) != 0)
            add(0, t);
    // Boxes that share but a face do not overlap. The others are sorted along one axis.
    std::erase_if(boxes, [](const Box3& box) { return is_empty(box); });
    std::ranges::sort(boxes, {}, [](const Box3& box) { return box.lower.x; });
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lower.x < boxes[i].upper.x; ++j)
            if (boxes[j].lower.y < boxes[i].upper.y && boxes[i].lower.y < boxes[j].upper.y &&
                boxes[j].lower.z < boxes[i].upper.z && boxes[i].lower.z < boxes[j].upper.z)
                return true;
    return false;
}

} // namespace abut
