#include "rigid/model/open_solids.h"

#include "core/disjoint_sets.h"
#include "math/vector.h"
#include "rigid/model/winding_vote.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace abut {

namespace {

using Numbers = std::vector<std::uint32_t>;

Triangle corners_of(const Mesh& mesh, std::uint32_t i) {
    const auto& t = mesh.triangles[i];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

/// Sets of triangles that are connected by vertices, in the order of their first triangles.
std::vector<Numbers> connected(const Mesh& mesh, const Topology& topology,
                               std::span<const std::uint32_t> triangles) {
    DisjointSets sets(mesh.positions.size());
    const auto vertex = [&](std::uint32_t t, std::size_t k) {
        return topology.vertex_of[mesh.triangles[t].at(k)];
    };
    for (const std::uint32_t t : triangles)
        sets.unite(vertex(t, 0), sets.unite(vertex(t, 1), vertex(t, 2)));
    std::map<std::uint32_t, std::size_t> number;
    std::vector<Numbers> result;
    for (const std::uint32_t t : triangles) {
        const auto [at, is_new] = number.try_emplace(sets.root(vertex(t, 0)), result.size());
        if (is_new)
            result.emplace_back();
        result[at->second].push_back(t);
    }
    return result;
}

Numbers merged(const Numbers& a, const Numbers& b) {
    Numbers both;
    std::ranges::merge(a, b, std::back_inserter(both));
    return both;
}

class OpenSolidSearch {
public:
    OpenSolidSearch(const Mesh& mesh, const Topology& topology, const CleanSurface& clean)
        : mesh_(mesh), topology_(topology), clean_(clean) {}

    OpenSolids run() {
        const bool are_one = take(clean_.open, false);
        const Numbers left = are_one ? clean_.hanging : merged(clean_.open, clean_.hanging);
        const bool is_new = are_one || !clean_.hanging.empty();
        if (left.empty() || (is_new && take(left, false)))
            return std::move(result_);
        // A face that a solid shares with a closed one was dropped as a copy of that one's.
        const Numbers with_copies = merged(left, clean_.copies);
        if (!clean_.copies.empty() && take(with_copies, false))
            return std::move(result_);
        take_each(with_copies);
        return std::move(result_);
    }

private:
    /// Adds a solid if some triangles bound one.
    ///
    /// In          mixed: parts may face different ways.
    bool take(const Numbers& set, bool mixed) {
        std::optional<SetWinding> found = winding_of(mesh_, topology_, set);
        if (!found || (found->is_mixed && !mixed))
            return false;
        result_.solids.push_back({set, std::move(found->weights), found->may_overlap});
        return true;
    }

    void take_each(const Numbers& triangles) {
        const std::size_t before = result_.solids.size();
        for (const Numbers& set : connected(mesh_, topology_, triangles)) {
            Numbers own;
            std::ranges::set_difference(set, clean_.copies, std::back_inserter(own));
            if (own.empty())
                continue;
            const bool has_copies = own.size() < set.size();
            if (take(own, false) || (has_copies && take(set, false)) || take(own, true) ||
                (has_copies && take(set, true)))
                continue;
            if (!take_without_sheet(own, false) && !take_without_sheet(own, true))
                add_sheet(own);
        }
        std::ranges::sort(result_.rest);
        turn_cavities(std::span(result_.solids).subspan(before));
    }

    void add_sheet(const Numbers& sheet) {
        for (const std::uint32_t t : sheet) {
            const bool hangs = std::ranges::binary_search(clean_.hanging, t);
            result_.has_sheets = result_.has_sheets || hangs;
            if (!hangs)
                result_.rest.push_back(t);
        }
    }

    /// Adds the solid that a set bounds without one of its patches: a sheet that hangs by a vertex or an
    /// edge of it. The sheet is left out.
    ///
    /// In          flat: as patches_of(). A sheet may share an edge with one face only.
    bool take_without_sheet(const Numbers& set, bool flat) {
        constexpr std::size_t kLargestSet = 4096, kTriedPatches = 32;
        if (set.size() > kLargestSet)
            return false;
        const std::vector<std::uint32_t> patch_of = patches_of(mesh_, topology_, set, flat);
        Numbers patches = patch_of;
        std::ranges::sort(patches);
        patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
        for (const std::uint32_t patch : patches) {
            if (patches.size() < 2 || patches.size() > kTriedPatches)
                return false;
            Numbers solid, sheet;
            for (std::size_t i = 0; i < set.size(); ++i)
                (patch_of[i] == patch ? sheet : solid).push_back(set[i]);
            if (!take(solid, false))
                continue;
            add_sheet(sheet);
            return true;
        }
        return false;
    }

    /// Solids that were told each by itself are cavities if an odd number of others is around them.
    void turn_cavities(std::span<OpenSolid> solids) const {
        std::vector<Box3> boxes;
        for (const OpenSolid& solid : solids) {
            boxes.emplace_back();
            for (const std::uint32_t t : solid.triangles)
                for (const Vec3& p : corners_of(mesh_, t))
                    extend(boxes.back(), p);
        }
        std::vector<bool> is_cavity(solids.size());
        for (std::size_t i = 0; i < solids.size(); ++i)
            for (std::size_t k = 0; k < solids.size(); ++k)
                if (i != k && encloses(boxes[k], boxes[i]) && is_around(solids[k], solids[i]))
                    is_cavity[i] = !is_cavity[i];
        for (std::size_t i = 0; i < solids.size(); ++i)
            if (is_cavity[i])
                for (std::int8_t& weight : solids[i].weights)
                    weight = static_cast<std::int8_t>(-weight);
    }

    /// Returns whether the largest faces of a solid lie inside another one, with both their sides.
    [[nodiscard]] bool is_around(const OpenSolid& outer, const OpenSolid& inner) const {
        return std::ranges::all_of(
            largest_triangles(mesh_, inner.triangles, kProbes), [&](std::uint32_t t) {
                const FaceProbe probe = face_probe(corners_of(mesh_, t));
                const auto is_inside = [&](const Vec3& p) {
                    return std::round(winding_number(mesh_, outer.triangles, p)) != 0;
                };
                return is_inside(probe.over) && is_inside(probe.under);
            });
    }

    const Mesh& mesh_;
    const Topology& topology_;
    const CleanSurface& clean_;
    OpenSolids result_;
};

} // namespace

OpenSolids find_open_solids(const Mesh& mesh, const Topology& topology, const CleanSurface& clean) {
    return OpenSolidSearch(mesh, topology, clean).run();
}

bool may_overlap(const Mesh& mesh, const Solid& solid, const std::vector<OpenSolid>& solids) {
    if (std::ranges::any_of(solids, &OpenSolid::may_overlap))
        return true;
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
