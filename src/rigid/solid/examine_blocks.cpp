#include "core/external_sort.h"
#include "core/paged_array.h"
#include "core/parallel.h"
#include "core/temporary_file.h"
#include "mesh/equal_positions.h"
#include "rigid/model/model_blocks.h"
#include "rigid/model/model_data.h"
#include "rigid/model/solid.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <tuple>

namespace abut {

namespace {

/// A vertex of a block, sorted by position: vertices at equal positions are neighbours.
struct VertexByPosition {
    std::array<std::uint64_t, 3> bits{};
    std::uint32_t block = 0, vertex = 0;
    friend bool operator<(const VertexByPosition& a, const VertexByPosition& b) {
        return std::tie(a.bits, a.block, a.vertex) < std::tie(b.bits, b.block, b.vertex);
    }
};

/// The number of a block's vertex after equal positions are merged.
struct MergedVertex {
    std::uint32_t block = 0, vertex = 0, merged = 0;
    friend bool operator<(const MergedVertex& a, const MergedVertex& b) {
        return std::tie(a.block, a.vertex) < std::tie(b.block, b.vertex);
    }
};

/// An edge of a triangle, between merged vertices.
struct EdgeUse {
    std::uint32_t lower = 0, upper = 0, triangle = 0, upwards = 0;
    [[nodiscard]] bool same_edge(const EdgeUse& e) const {
        return lower == e.lower && upper == e.upper;
    }
    friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.lower, a.upper, a.triangle) < std::tie(b.lower, b.upper, b.triangle);
    }
};

/// Disjoint sets of merged vertices. Unlike DisjointSets they go to disk if memory is short.
class VertexSets {
public:
    VertexSets(const std::string& folder, std::uint64_t count, std::size_t memory)
        : below_(folder, count, memory) {}

    std::uint32_t root(std::uint32_t v) {
        while (const std::uint32_t below = below_.get(v)) {
            if (const std::uint32_t next = below_.get(v - below))
                below_.set(v, below + next);
            v -= below;
        }
        return v;
    }
    void join(std::uint32_t v, std::uint32_t w) {
        const auto [low, high] = std::minmax({root(v), root(w)});
        if (low != high)
            below_.set(high, high - low);
    }

private:
    PagedArray<std::uint32_t> below_; ///< a vertex's number less that of its parent; 0 for a root
};

class BlocksExamination {
public:
    BlocksExamination(const ModelBlocks& blocks, const std::string& folder, std::size_t memory)
        : blocks_(blocks), folder_(folder), share_(memory / 3), merged_(folder) {}

    BlocksSolid run() {
        merge_vertices();
        connect();
        measure();
        if (!result_.closed)
            result_.outward = outward_by_winding();
        result_.has_parity_only =
            result_.closed && (result_.outward == 0 || result_.component_points.size() > 1);
        result_.solid = result_.closed || result_.outward != 0;
        result_.boundary.is_known = result_.component_points.size() <= 1;
        return std::move(result_);
    }

private:
    void merge_vertices() {
        ExternalSort<VertexByPosition> by_position(folder_, share_);
        std::uint64_t vertices = 0;
        for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
            first_.push_back(vertices);
            if (is_empty(blocks_.box(i)))
                continue;
            const auto block = blocks_.block(i);
            const std::vector<Vec3>& positions = block->model.mesh().positions;
            for (std::uint32_t v = 0; v < positions.size(); ++v)
                by_position.push({{detail::coordinate_bits(positions[v].x),
                                   detail::coordinate_bits(positions[v].y),
                                   detail::coordinate_bits(positions[v].z)},
                                  i,
                                  v});
            vertices += positions.size();
        }
        ExternalSort<MergedVertex> by_block(folder_, share_);
        std::optional<VertexByPosition> last;
        by_position.drain([&](const VertexByPosition& vertex) {
            count_ += !last || last->bits != vertex.bits ? 1 : 0;
            last = vertex;
            by_block.push({vertex.block, vertex.vertex, count_ - 1});
        });
        TemporaryWriter writer(merged_);
        by_block.drain([&](const MergedVertex& vertex) {
            writer.append(&vertex.merged, sizeof vertex.merged);
        });
        writer.flush();
    }

    /// Calls visit(block, its merged vertices) for each block in order.
    template <typename Visit>
    void for_each(const Visit& visit) {
        for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
            if (is_empty(blocks_.box(i)))
                continue;
            const auto block = blocks_.block(i);
            std::vector<std::uint32_t> merged(block->model.mesh().positions.size());
            merged_.read(first_[i] * sizeof merged[0], std::as_writable_bytes(std::span(merged)));
            visit(*block, merged);
        }
    }

    /// Counts the uses of edges, and joins components.
    void connect() {
        ExternalSort<EdgeUse> edges(folder_, share_);
        sets_.emplace(folder_, count_, share_);
        for_each([&](const ModelBlock& block, const std::vector<std::uint32_t>& merged) {
            const Mesh& mesh = block.model.mesh();
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                const auto& corners = mesh.triangles[t];
                const std::array<std::uint32_t, 3> m{merged[corners[0]], merged[corners[1]],
                                                     merged[corners[2]]};
                sets_->join(m[0], m[1]), sets_->join(m[1], m[2]);
                if (m[0] != m[1] && m[1] != m[2] && m[2] != m[0])
                    for (std::size_t k = 0; k < 3; ++k) {
                        const std::uint32_t from = m.at(k), to = m.at((k + 1) % 3);
                        edges.push({std::min(from, to), std::max(from, to), block.numbers[t],
                                    from < to ? 1U : 0U});
                    }
                consider(mesh, t, block.numbers[t]);
            }
        });
        std::uint64_t uses = 0; // of the current edge
        EdgeUse last;
        bool any = false, all_twice = true;
        edges.drain([&](const EdgeUse& edge) {
            const bool same = any && edge.same_edge(last);
            all_twice = all_twice && (!any || (same ? uses == 1 : uses == 2));
            alternate_ = alternate_ && (!same || edge.upwards != last.upwards);
            uses = same ? uses + 1 : 1;
            last = edge;
            any = true;
        });
        result_.closed = any && all_twice && uses == 2;
    }

    /// Finds the largest triangles; among equals, those of the least numbers.
    void consider(const Mesh& mesh, std::size_t t, std::uint32_t number) {
        const auto& c = mesh.triangles[t];
        const Triangle triangle{mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]};
        const Large large{-doubled_area_sq(triangle), number, triangle};
        if (largest_.size() == kProbes && !large.before(largest_.back()))
            return;
        if (largest_.size() == kProbes)
            largest_.pop_back();
        largest_.insert(std::find_if(largest_.begin(), largest_.end(),
                                     [&](const Large& other) { return large.before(other); }),
                        large);
    }

    /// Finds a point of each component, and the sign of the volume if it tells inside from outside.
    void measure() {
        std::vector<bool> seen(count_);
        std::optional<Vec3> origin;
        double volume = 0;
        for_each([&](const ModelBlock& block, const std::vector<std::uint32_t>& merged) {
            const Mesh& mesh = block.model.mesh();
            for (const auto& corners : mesh.triangles) {
                const Triangle t{mesh.positions[corners[0]], mesh.positions[corners[1]],
                                 mesh.positions[corners[2]]};
                const std::uint32_t root = sets_->root(merged[corners[0]]);
                if (!seen[root])
                    result_.component_points.push_back(t[0]);
                seen[root] = true;
                if (!origin)
                    origin = t[0];
                volume += dot(t[0] - *origin, cross(t[1] - *origin, t[2] - *origin));
            }
        });
        if (result_.closed && alternate_)
            result_.outward = (volume > 0) - (volume < 0);
    }

    int outward_by_winding() {
        std::vector<Vec3> points;
        for (const Large& large : largest_) {
            const FaceProbe probe = face_probe(large.triangle);
            points.insert(points.end(), {probe.over, probe.under});
        }
        std::vector<double> sums(points.size());
        for (std::size_t i = 0; i < blocks_.size(); ++i) {
            if (is_empty(blocks_.box(i)))
                continue;
            const auto block = blocks_.block(i);
            parallel_for(points.size(), 1, [&](std::size_t k) {
                sums[k] += winding_number(block->model.mesh(), points[k]);
            });
        }
        OutwardVote vote;
        for (std::size_t k = 0; k < sums.size(); k += 2)
            vote.add(sums[k], sums[k + 1]);
        return vote.outward();
    }

    struct Large {
        double minus_area = 0;
        std::uint32_t number = 0;
        Triangle triangle;
        [[nodiscard]] bool before(const Large& other) const {
            return minus_area != other.minus_area ? minus_area < other.minus_area
                                                  : number < other.number;
        }
    };

    const ModelBlocks& blocks_;
    const std::string& folder_;
    std::size_t share_;
    TemporaryFile merged_;             ///< number of each vertex of each block
    std::vector<std::uint64_t> first_; ///< of each block: where it begins in merged_
    std::uint32_t count_ = 0;          ///< number of merged vertices
    std::optional<VertexSets> sets_;
    bool alternate_ = true; ///< the two uses of each edge run in opposite directions
    std::vector<Large> largest_;
    BlocksSolid result_;
};

/// Bytes for the examination of a mesh in memory, with the mesh, a position for each corner, and two
/// models for its boundary.
std::uint64_t bytes_in_memory(std::uint64_t triangles) {
    return (3 * sizeof(Vec3) + 3 * sizeof(std::uint32_t)) * triangles +
           most_solid_bytes(triangles, 3 * triangles) + most_examination_bytes(triangles) +
           2 * most_model_bytes(triangles, 3 * triangles);
}

BlocksSolid examine_in_memory(const ModelBlocks& blocks) {
    Mesh mesh;
    mesh.triangles.resize(blocks.triangles());
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        if (is_empty(blocks.box(i)))
            continue;
        const auto block = blocks.block(i);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const Mesh& part = block->model.mesh();
        mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
        for (std::size_t t = 0; t < part.triangles.size(); ++t) {
            const auto& v = part.triangles[t];
            mesh.triangles[block->numbers[t]] = {first + v[0], first + v[1], first + v[2]};
        }
    }
    BlocksSolid result;
    if (mesh.positions.empty())
        return result;
    Solid solid = examine_solid(mesh);
    for (const std::uint32_t t : solid.components)
        result.component_points.push_back(mesh.positions[mesh.triangles[t][0]]);
    result.closed = solid.closed, result.solid = solid.solid;
    result.outward = solid.outward;
    if (solid.may_overlap || solid.has_sheets)
        result.boundary =
            solid.is_oriented() ? find_boundary(mesh, solid) : BoundarySearch{nullptr, false};
    result.weights = std::move(solid.weights);
    result.has_parity_only = solid.has_parity_only;
    return result;
}

} // namespace

BlocksSolid examine_solid(const ModelBlocks& blocks, const std::string& folder,
                          std::size_t memory) {
    if (bytes_in_memory(blocks.triangles()) <= memory)
        return examine_in_memory(blocks);
    return BlocksExamination(blocks, folder, memory).run();
}

} // namespace abut
