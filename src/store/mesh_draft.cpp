#include "store/mesh_draft.h"

#include "io/fault.h"
#include "math/vector.h"
#include "mesh/equal_positions.h"
#include "mesh/topology.h"
#include "mesh/used_positions.h"
#include "store/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

class Collector : public MeshSink {
public:
    Collector(Mesh& mesh, const SceneSource::Size& size) : mesh_(mesh) {
        mesh.positions.reserve(size.vertices);
        mesh.triangles.reserve(size.triangles);
    }
    void vertices(std::span<const Vec3> positions) override {
        mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
    }
    void triangles(std::span<const std::array<std::uint32_t, 3>> indices) override {
        mesh_.triangles.insert(mesh_.triangles.end(), indices.begin(), indices.end());
    }

private:
    Mesh& mesh_;
};

/// As the isolated readers join them: in the order of their first occurrence.
void join_vertices(Mesh& mesh) {
    std::vector<std::uint32_t> number_of = first_equal_positions(std::span(mesh.positions));
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < number_of.size(); ++i) {
        const std::uint32_t first = number_of[i];
        if (first < i) {
            number_of[i] = number_of[first];
            continue;
        }
        mesh.positions[count] = mesh.positions[i];
        number_of[i] = count++;
    }
    if (count == mesh.positions.size())
        return;
    mesh.positions.resize(count);
    mesh.positions.shrink_to_fit();
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle)
            corner = number_of[corner];
}

} // namespace

Hash128 mesh_hash(std::uint64_t vertices, const Hash128& positions, std::uint64_t triangles,
                  const Hash128& corners) {
    const std::array<std::uint64_t, 6> words{vertices,  positions.low, positions.high,
                                             triangles, corners.low,   corners.high};
    return hash_128(std::as_bytes(std::span(words)));
}

void check_coordinate(const Vec3& p, std::uint64_t vertex) {
    constexpr double kLargestFloat = std::numeric_limits<float>::max();
    const auto all_below = [&](double limit) {
        return std::fabs(p.x) <= limit && std::fabs(p.y) <= limit && std::fabs(p.z) <= limit;
    };
    if (!all_below(kLargestFloat))
        throw Fault(ErrorCode::bad_mesh, "vertex " + std::to_string(vertex) +
                                             " has a coordinate that is not a finite number");
    if (!all_below(kLargestCoordinate))
        throw Fault(ErrorCode::bad_mesh,
                    "vertex " + std::to_string(vertex) + " has a coordinate beyond 1e18");
}

MeshDraft load_mesh(const SceneSource& source, std::uint32_t number) {
    MeshDraft draft;
    Mesh& mesh = draft.mesh;
    Collector collector(mesh, source.size(number));
    source.read(number, collector);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= mesh.positions.size())
                throw Fault(ErrorCode::bad_mesh,
                            "a triangle refers to a vertex that does not exist");
    join_vertices(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        check_coordinate(mesh.positions[i], i);
    draft.hash = mesh_hash(
        mesh.positions.size(), hash_128(std::as_bytes(std::span<const Vec3>(mesh.positions))),
        mesh.triangles.size(),
        hash_128(std::as_bytes(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles))));
    draft.closed = is_closed_joined(mesh);
    draft.box = world_box(UsedPositions(mesh).get(), Transform());
    return draft;
}

std::uint64_t loading_bytes(const SceneSource::Size& size) {
    // Positions, the table that joins them and their numbers; triangles, their edges, a block.
    return 96 * size.vertices + 72 * size.triangles + 4096;
}

BlockDraft encode_draft(const MeshBlock& block) {
    EncodedBlock encoded = encode_block(block);
    BlockDraft draft;
    draft.row.vertices = block.mesh.positions.size();
    draft.row.triangles = block.mesh.triangles.size();
    draft.row.raw_bytes = encoded.raw_bytes;
    draft.row.box = without_negative_zero(world_box(UsedPositions(block.mesh).get(), Transform()));
    draft.data = std::move(encoded.data);
    return draft;
}

std::vector<BlockDraft> encode_mesh(const Mesh& mesh) {
    std::vector<BlockDraft> blocks;
    cut_mesh(mesh, [&](const MeshBlock& block) { blocks.push_back(encode_draft(block)); });
    return blocks;
}

bool is_closed_joined(const Mesh& mesh) {
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        if (a == b || b == c || c == a)
            continue; // such a triangle has no edges
        for (const auto& [v, w] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            edges.push_back(std::uint64_t{std::min(v, w)} << 32 | std::max(v, w));
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); i += 2)
        if (i + 1 == edges.size() || edges[i] != edges[i + 1] ||
            (i + 2 < edges.size() && edges[i + 2] == edges[i]))
            return false;
    return !edges.empty();
}

} // namespace abut
