#include "view/levels/tree_writer.h"

#include "math/rounding.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The nearest float that is not smaller.
float float_above(double v) {
    const float f = to_float(v);
    return double{f} < v ? std::nextafter(f, kInfinity) : f;
}
float float_below(double v) {
    const float f = to_float(v);
    return double{f} > v ? std::nextafter(f, -kInfinity) : f;
}

class TreeWriter {
public:
    TreeWriter(StoreFile& store, const LevelItems& items, const std::vector<PlannedNode>& nodes,
               const std::vector<LevelChunkRow>& rows)
        : store_(store), items_(items), plan_(nodes), rows_(rows) {
        tree_.origin = items.origin;
        tree_.parts = items.parts;
    }

    LevelTree run(const std::vector<std::vector<LevelChunkRow>>& mesh_rows) {
        for (const auto& levels : mesh_rows)
            add_mesh(levels);
        tree_.nodes.resize(std::max<std::size_t>(plan_.size(), 1));
        for (std::size_t i = plan_.size(); i-- > 0;)
            add_node(static_cast<std::uint32_t>(i));
        return std::move(tree_);
    }

private:
    std::uint32_t add_chunk(const LevelChunkRow& row) {
        tree_.chunks.push_back({row.triangles, row.vertices});
        tree_.chunk_rows.push_back(row.chunk);
        return static_cast<std::uint32_t>(tree_.chunks.size() - 1);
    }

    void add_mesh(const std::vector<LevelChunkRow>& levels) {
        tree_.meshes.push_back({static_cast<std::uint32_t>(tree_.mesh_levels.size()),
                                static_cast<std::uint32_t>(levels.size())});
        for (std::size_t i = levels.size(); i-- > 0;) // coarsest first
            tree_.mesh_levels.push_back(
                {i == 0 ? 0 : float_above(levels[i].error), add_chunk(levels[i])});
    }

    void add_node(std::uint32_t i) {
        const PlannedNode& planned = plan_[i];
        LevelNode& node = tree_.nodes[i];
        node.first_child = planned.first_child, node.children = planned.children;
        Box3 box;
        if (planned.is_leaf() && items_.items[planned.begin].is_instance()) {
            box = add_instance(items_.items[planned.begin], node);
        } else {
            const LevelChunkRow& row = rows_[i];
            if (row.triangles > 0 || planned.is_leaf())
                node.chunk = add_chunk(row);
            node.error = planned.is_leaf() ? 0 : float_above(row.error);
            box = row.box;
        }
        node.lower = {float_below(box.lower.x), float_below(box.lower.y), float_below(box.lower.z)};
        node.upper = {float_above(box.upper.x), float_above(box.upper.y), float_above(box.upper.z)};
        for (std::uint32_t k = 0; k < node.children; ++k) {
            const LevelNode& child = tree_.nodes[node.first_child + k];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.lower.at(axis) = std::min(node.lower.at(axis), child.lower.at(axis));
                node.upper.at(axis) = std::max(node.upper.at(axis), child.upper.at(axis));
            }
            node.error = std::max(node.error, child.error);
        }
    }

    Box3 add_instance(const LevelItem& item, LevelNode& node) {
        const PartRow part = store_.part(item.part);
        const Vec3& centre = items_.shared[item.shared].centre;
        // The frame of the mesh's chunks has its origin at the centre, so that the translation is
        // rounded near the part.
        Transform place = part.world_from_mesh;
        const Vec3 at = apply(place, centre) - items_.origin;
        place.m[9] = at.x, place.m[10] = at.y, place.m[11] = at.z;
        LevelInstance instance;
        instance.mesh = item.shared;
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 4; ++column)
                instance.placed.rows.at(4 * row + column) = to_float(place.m.at(3 * column + row));
        instance.placed.part = static_cast<std::uint32_t>(
            std::lower_bound(tree_.parts.begin(), tree_.parts.end(), item.part) -
            tree_.parts.begin());
        instance.scale = float_above(stretch_of(part.world_from_mesh).most);
        node.instance = static_cast<std::uint32_t>(tree_.instances.size());
        tree_.instances.push_back(instance);
        // Levels stay in the box of the mesh, to their error; single precision moves them a little.
        const Box3 box{part.box.lower - items_.origin, part.box.upper - items_.origin};
        const MeshLevel& coarsest = tree_.mesh_levels[tree_.meshes[item.shared].first_level];
        return grown(box, double{instance.scale} * coarsest.error +
                              1e-6 * std::max(max_abs(box.lower), max_abs(box.upper)));
    }

    StoreFile& store_;
    const LevelItems& items_;
    const std::vector<PlannedNode>& plan_;
    const std::vector<LevelChunkRow>& rows_;
    LevelTree tree_;
};

} // namespace

LevelTree make_tree(StoreFile& store, const LevelItems& items,
                    const std::vector<PlannedNode>& nodes, const std::vector<LevelChunkRow>& rows,
                    const std::vector<std::vector<LevelChunkRow>>& mesh_rows) {
    return TreeWriter(store, items, nodes, rows).run(mesh_rows);
}

} // namespace abut
