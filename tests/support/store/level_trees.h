#pragma once

#include "tests/support/random.h"
#include "view/levels/level_tree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace abut::test {

/// A tree of levels with its chunks in memory.
struct LevelModel {
    LevelTree tree;
    std::vector<ViewChunk> chunks;
};

/// Makes trees of random boxes. The chunk of a node shows triangles in its box; the geometry of
/// different nodes has nothing in common.
class LevelModelMaker {
public:
    struct Options {
        int depth = 4, least_children = 2, most_children = 5;
        double instances = 0.3; ///< share of the leaves
        int meshes = 4, most_levels = 3;
        double half = 50;
        int most_triangles = 40; ///< of a chunk
    };
    LevelModelMaker(Random& random, const Options& options) : random_(random), options_(options) {}

    LevelModel make() {
        LevelTree& tree = model_.tree;
        tree.origin = random_.in_cube(1000);
        for (int i = 0; i < options_.meshes; ++i)
            add_mesh();
        const auto h = static_cast<float>(options_.half);
        tree.nodes.push_back({{-h, -h, -h}, {h, h, h}});
        add_children(0, options_.depth);
        for (std::uint32_t part = 0; part < parts_; ++part)
            tree.parts.push_back(std::int64_t{10} + 2 * part);
        return std::move(model_);
    }

private:
    std::uint32_t add_chunk(const std::array<float, 3>& lower, const std::array<float, 3>& upper,
                            std::uint32_t part, std::uint32_t parts) {
        ViewChunk chunk;
        chunk.lower = lower;
        for (std::size_t axis = 0; axis < 3; ++axis)
            chunk.step.at(axis) = (upper.at(axis) - lower.at(axis)) / 65535;
        const int triangles = random_.integer(1, options_.most_triangles);
        for (int i = 0; i < 3 * triangles; ++i) {
            ChunkVertex vertex;
            for (std::uint16_t& x : vertex.position)
                x = static_cast<std::uint16_t>(random_.integer(0, 65535));
            vertex.part =
                part + static_cast<std::uint32_t>(random_.integer(0, static_cast<int>(parts) - 1));
            chunk.vertices.push_back(vertex);
            chunk.indices.push_back(static_cast<std::uint16_t>(i));
        }
        model_.tree.chunks.push_back(
            {static_cast<std::uint32_t>(triangles), static_cast<std::uint32_t>(3 * triangles)});
        model_.chunks.push_back(std::move(chunk));
        return static_cast<std::uint32_t>(model_.chunks.size() - 1);
    }

    void add_mesh() {
        LevelTree& tree = model_.tree;
        const int levels = random_.integer(1, options_.most_levels);
        tree.meshes.push_back({static_cast<std::uint32_t>(tree.mesh_levels.size()),
                               static_cast<std::uint32_t>(levels)});
        for (int level = 0; level < levels; ++level)
            tree.mesh_levels.push_back({static_cast<float>(levels - 1 - level) * 0.01F,
                                        add_chunk({-1, -1, -1}, {1, 1, 1}, 0, 1)});
    }

    void add_children(std::uint32_t at, int depth) {
        LevelTree& tree = model_.tree;
        const LevelNode parent = tree.nodes[at];
        const auto first = static_cast<std::uint32_t>(tree.nodes.size());
        const int count = random_.integer(options_.least_children, options_.most_children);
        for (int i = 0; i < count; ++i) {
            LevelNode node;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double size = double{parent.upper.at(axis)} - parent.lower.at(axis);
                const double low = random_.uniform(0, 0.5), high = low + random_.uniform(0.1, 0.5);
                node.lower.at(axis) = static_cast<float>(parent.lower.at(axis) + low * size);
                node.upper.at(axis) = static_cast<float>(parent.lower.at(axis) + high * size);
            }
            tree.nodes.push_back(node);
        }
        const std::uint32_t first_part = parts_;
        for (int i = 0; i < count; ++i) {
            const std::uint32_t child = first + static_cast<std::uint32_t>(i);
            if (depth > 1 && random_.chance(0.9))
                add_children(child, depth - 1);
            else
                add_leaf(child);
        }
        LevelNode& node = tree.nodes[at];
        node.first_child = first;
        node.children = static_cast<std::uint32_t>(count);
        for (int i = 0; i < count; ++i)
            node.error =
                std::max(node.error, tree.nodes[first + static_cast<std::uint32_t>(i)].error);
        node.error += static_cast<float>(random_.uniform(0.001, 0.05));
        const auto lower = node.lower, upper = node.upper;
        const std::uint32_t chunk = add_chunk(lower, upper, first_part, parts_ - first_part);
        tree.nodes[at].chunk = chunk;
    }

    void add_leaf(std::uint32_t at) {
        LevelTree& tree = model_.tree;
        const std::uint32_t part = parts_++;
        LevelNode& node = tree.nodes[at];
        if (!random_.chance(options_.instances)) {
            node.chunk = add_chunk(node.lower, node.upper, part, 1);
            return;
        }
        LevelInstance instance;
        instance.mesh = static_cast<std::uint32_t>(random_.integer(0, options_.meshes - 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float half = 0.5F * (node.upper.at(axis) - node.lower.at(axis));
            instance.placed.rows.at(4 * axis + axis) = half;
            instance.placed.rows.at(4 * axis + 3) = node.lower.at(axis) + half;
            instance.scale = std::max(axis == 0 ? 0 : instance.scale, half);
        }
        instance.placed.part = part;
        node.instance = static_cast<std::uint32_t>(tree.instances.size());
        const LevelMesh& mesh = tree.meshes[instance.mesh];
        node.error = instance.scale * tree.mesh_levels[mesh.first_level].error;
        tree.instances.push_back(instance);
    }

    Random& random_;
    Options options_;
    LevelModel model_;
    std::uint32_t parts_ = 0;
};

/// A camera somewhere in or around a tree of this half size.
inline Camera random_camera(Random& random, const Vec3& origin, double half) {
    Camera camera;
    camera.eye = origin + random.in_cube(1.5 * half);
    camera.forward = random.uniform(0.1, 10) * random.direction();
    if (random.chance(0.7)) // most cameras look at something
        camera.forward = origin + random.in_cube(0.5 * half) - camera.eye;
    do
        camera.up = random.uniform(0.1, 10) * random.direction();
    while (length(cross(normalized_or_zero(camera.forward), normalized_or_zero(camera.up))) < 0.01);
    camera.field_of_view = random.uniform(0.3, 2);
    camera.width = static_cast<std::uint32_t>(random.integer(200, 1600));
    camera.height = static_cast<std::uint32_t>(random.integer(200, 1200));
    return camera;
}

} // namespace abut::test
