#include "io/polygon/polygon_scene.h"

#include "core/large_pages.h"
#include "io/file/fault.h"
#include "io/file/read_watch.h"
#include "io/polygon/triangulate.h"
#include "io/scene/collect_scene.h"
#include "math/rounding.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace abut {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

void require_countable(std::uint64_t number) {
    if (number >= kNone)
        throw Fault(ErrorCode::unsupported, "has a part with more than 4 billion vertices");
}

} // namespace

template <typename Value>
void PolygonScene::push(std::vector<Value>& values, Value value) {
    if (values.size() == values.capacity()) {
        constexpr std::size_t kFirst = 256;
        const std::size_t more = std::max(kFirst, values.capacity());
        require(more * sizeof(Value));
        reserve_in_large_pages(values, values.capacity() + more);
    }
    values.push_back(value);
}

void PolygonScene::require(std::uint64_t more_bytes) {
    bytes_ += more_bytes;
    watch_.require_memory(bytes_);
}

void PolygonScene::vertex(const Vec3& p) {
    require_countable(pool_.size() + 1);
    push(pool_, FloatPosition{to_float(p.x), to_float(p.y), to_float(p.z)});
}

std::size_t PolygonScene::add_part(std::string id) {
    parts_.push_back({std::move(id), {}, {}});
    return parts_.size() - 1;
}

void PolygonScene::face(std::size_t part, std::span<const std::uint64_t> corners) {
    if (corners.size() < 3)
        return;
    Faces& faces = parts_[part];
    require_countable(faces.corners.size() + corners.size());
    if (corners.size() != 3 && faces.sizes.empty()) {
        require(faces.corners.size() / 3 * sizeof(std::uint32_t));
        faces.sizes.assign(faces.corners.size() / 3, 3);
    }
    if (corners.size() != 3 || !faces.sizes.empty())
        push(faces.sizes, static_cast<std::uint32_t>(corners.size()));
    for (const std::uint64_t corner : corners)
        push(faces.corners, static_cast<std::uint32_t>(std::min<std::uint64_t>(corner, kNone)));
}

void PolygonScene::add_positions(Faces& faces, Vertices vertices, Mesh& mesh) {
    const auto position = [&](std::uint32_t vertex) {
        const FloatPosition& p = pool_[vertex];
        return Vec3{p.x, p.y, p.z};
    };
    for (const std::uint32_t corner : faces.corners)
        if (corner >= pool_.size())
            throw Fault(ErrorCode::bad_mesh, "a face refers to vertex " + std::to_string(corner) +
                                                 " of " + std::to_string(pool_.size()));
    if (vertices == Vertices::all) {
        reserve_in_large_pages(mesh.positions, pool_.size());
        for (std::uint32_t i = 0; i < pool_.size(); ++i)
            mesh.positions.push_back(position(i));
        return;
    }
    number_of_.resize(pool_.size(), kNone);
    reserve_in_large_pages(mesh.positions, std::min(pool_.size(), faces.corners.size()));
    const std::vector<std::uint32_t> used = faces.corners;
    for (std::uint32_t& corner : faces.corners) {
        std::uint32_t& number = number_of_[corner];
        if (number == kNone) {
            number = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(position(corner));
        }
        corner = number;
    }
    for (const std::uint32_t corner : used)
        number_of_[corner] = kNone;
}

void PolygonScene::add_triangles(const Faces& faces, Mesh& mesh) {
    std::span<const std::uint32_t> rest = faces.corners;
    if (faces.sizes.empty()) {
        reserve_in_large_pages(mesh.triangles, rest.size() / 3);
        for (; !rest.empty(); rest = rest.subspan(3))
            mesh.triangles.push_back({rest[0], rest[1], rest[2]});
        return;
    }
    reserve_in_large_pages(mesh.triangles, rest.size() - 2 * faces.sizes.size());
    for (const std::uint32_t size : faces.sizes) {
        triangulate(rest.first(size), mesh.positions.data(), mesh.triangles);
        rest = rest.subspan(size);
    }
}

Scene PolygonScene::finish(Vertices vertices) {
    Scene scene;
    for (Faces& faces : parts_) {
        if (faces.corners.empty())
            continue;
        watch_.check();
        const std::uint64_t count =
            vertices == Vertices::all ? pool_.size() : std::min(pool_.size(), faces.corners.size());
        // The mesh, the table that joins its vertices, and their numbers.
        require((sizeof(Vec3) + 20) * count + 8 * faces.corners.size());
        Mesh& mesh = scene.meshes.emplace_back();
        add_positions(faces, vertices, mesh);
        add_triangles(faces, mesh);
        faces.corners = {};
        faces.sizes = {};
        join_vertices(mesh);
        Part part;
        part.id = std::move(faces.id);
        part.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        scene.parts.push_back(std::move(part));
    }
    return scene;
}

} // namespace abut
