#include <abut/convex.h>
#include <abut/error.h>

#include "convex/body/convex_data.h"
#include "convex/mesh_convexity.h"
#include "core/arguments.h"
#include "mesh/topology.h"

namespace abut {

namespace {

std::shared_ptr<const ConvexData> make_data(std::span<const Vec3> points) {
    if (points.empty())
        throw Error(ErrorCode::bad_mesh, "a convex body needs at least one point");
    require_valid_positions(points);
    return std::make_shared<const ConvexData>(points);
}

std::vector<Vec3> used_positions(const Mesh& mesh, std::vector<std::uint32_t>& source) {
    std::vector<bool> used(mesh.positions.size());
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t)
            used[v] = true;
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (used[v]) {
            positions.push_back(mesh.positions[v]);
            source.push_back(v);
        }
    return positions;
}

} // namespace

Convex::Convex(std::span<const Vec3> points) : data_(make_data(points)) {}

Convex::Convex(const Mesh& mesh, const ConvexOptions& options) {
    require_not_negative(options.relative_dent, "relative dent");
    require_valid(mesh);
    std::vector<std::uint32_t> source;
    const std::vector<Vec3> positions = used_positions(mesh, source);
    const auto data = std::make_shared<ConvexData>(*make_data(positions));
    for (std::uint32_t& v : data->source)
        v = source[v];
    Box3 box;
    for (const Vec3& p : positions)
        extend(box, p);
    require_convex(mesh, *data, options.relative_dent * length(box.upper - box.lower));
    data_ = data;
}

const std::vector<Vec3>& Convex::vertices() const noexcept {
    return data_->vertices;
}

const std::vector<std::array<std::uint32_t, 2>>& Convex::edges() const noexcept {
    return data_->edges;
}

std::size_t Convex::face_count() const noexcept {
    return data_->face_begin.size() - 1;
}

std::span<const std::uint32_t> Convex::face(std::size_t index) const {
    const auto& begin = data_->face_begin;
    return std::span(data_->face_vertices).subspan(begin[index], begin[index + 1] - begin[index]);
}

const std::vector<std::uint32_t>& Convex::source() const noexcept {
    return data_->source;
}

int Convex::dimension() const noexcept {
    return data_->dimension;
}

Mesh Convex::mesh() const {
    Mesh mesh{data_->vertices, data_->triangles};
    if (mesh.triangles.empty())
        mesh.triangles.push_back({0, static_cast<std::uint32_t>(mesh.positions.size() - 1), 0});
    return mesh;
}

std::size_t Convex::bytes() const noexcept {
    return data_->bytes();
}

} // namespace abut
