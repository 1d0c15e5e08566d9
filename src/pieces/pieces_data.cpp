#include "pieces/pieces_data.h"

#include <abut/error.h>

#include "core/parallel.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "pieces/decomposition/decompose.h"
#include "rigid/model/model_data.h"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>

namespace abut {

namespace {

/// In pieces of at most this many triangles, each is compared.
constexpr std::size_t kFewTriangles = 4;

std::uint64_t next_id() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

Triangle corners(const Mesh& mesh, std::uint32_t t) {
    const auto& v = mesh.triangles[t];
    return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

/// Returns whether the surface winds around a point just below a triangle.
bool has_inside_below(const Mesh& mesh, std::uint32_t triangle) {
    const Triangle t = corners(mesh, triangle);
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
    const Vec3 step = (1e-3 * std::sqrt(length(n))) * normalized_or_zero(n);
    return winding_number(mesh, middle - step) > 0.5;
}

/// Returns whether the triangles of a flat piece cover its hull: no border edge of the piece runs
/// inside it.
bool is_sheet(const SurfaceGraph& surface, const Polytope& hull,
              std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> piece_of) {
    const Triangle first = surface.triangle(triangles[0]);
    const int axis = projection_axis(first);
    if (axis < 0)
        return false;
    const int turn = orient2d(first[0], first[1], first[2], axis);
    for (const std::uint32_t t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t beyond = surface.across[t][k];
            if (beyond != kNoEdge && piece_of[beyond] == piece_of[t])
                continue;
            const Triangle c = surface.triangle(t);
            for (const HullVertex& v : hull.vertices)
                if (turn * orient2d(c[k], c[(k + 1) % 3], v.at, axis) < 0)
                    return false;
        }
    return true;
}

/// Errors      Error{bad_mesh} if a component is turned inside out and bounds no cavity.
void require_outward(const Mesh& mesh, const SurfaceGraph& surface) {
    struct Component {
        double volume = 0, largest = -1;
        std::uint32_t triangle = 0;
    };
    const std::vector<std::uint32_t> number = vertex_components(mesh, make_topology(mesh));
    std::vector<Component> components(number.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (surface.across[i][0] == kNoEdge)
            continue; // it bounds nothing
        Component& c = components[number[mesh.triangles[i][0]]];
        const Vec3& origin = mesh.positions[number[mesh.triangles[i][0]]];
        const Triangle t = corners(mesh, i);
        c.volume += dot(t[0] - origin, cross(t[1] - origin, t[2] - origin));
        if (const double area = length_sq(cross(t[1] - t[0], t[2] - t[0])); area > c.largest)
            c.largest = area, c.triangle = i;
    }
    for (const Component& c : components)
        if (c.volume < 0 && !has_inside_below(mesh, c.triangle))
            throw Error(ErrorCode::bad_mesh,
                        fmt::format("not a solid: the surface around triangle {} is turned inside "
                                    "out",
                                    c.triangle));
}

} // namespace

ConvexPiecesData::ConvexPiecesData(const Model& solid) : model(solid), id(next_id()) {
    const SurfaceGraph surface(mesh(), model.data().solid());
    require_outward(mesh(), surface);
    const Pieces pieces = decompose(model, surface);
    std::vector<std::vector<std::uint32_t>> vertices(pieces.size());
    piece_of.resize(mesh().triangles.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        triangles.insert(triangles.end(), pieces[i].begin(), pieces[i].end());
        begin.push_back(static_cast<std::uint32_t>(triangles.size()));
        auto& v = vertices[i];
        for (const std::uint32_t t : pieces[i]) {
            piece_of[t] = static_cast<std::uint32_t>(i);
            v.insert(v.end(), surface.corners[t].begin(), surface.corners[t].end());
        }
        std::sort(v.begin(), v.end());
        v.erase(std::unique(v.begin(), v.end()), v.end());
    }
    tree = build_hull_tree(mesh().positions, vertices);
    faces.resize(pieces.size());
    parallel_for(pieces.size(), 64, [&](std::size_t i) {
        if (pieces[i].size() > kFewTriangles)
            faces[i] = find_piece_faces(surface, tree.nodes[tree.leaf_of[i]].hull, tree.sources[i],
                                        pieces[i]);
    });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        HullNode& leaf = tree.nodes[tree.leaf_of[i]];
        leaf.is_sheet = leaf.is_flat && is_sheet(surface, leaf.hull, pieces[i], piece_of);
    }
    triangle_at.resize(mesh().positions.size());
    for (std::uint32_t t = 0; t < surface.corners.size(); ++t)
        for (const std::uint32_t v : surface.corners[t]) {
            triangle_at[v] = t;
            reach = std::max(reach, sum_of_sizes(surface.positions[v]));
        }
    for (const std::uint32_t t : model.data().solid().components)
        components.push_back(mesh().triangles[t][0]);
}

std::size_t ConvexPiecesData::bytes() const {
    const auto bytes_of = [](const std::vector<std::uint32_t>& v) {
        return v.capacity() * sizeof(std::uint32_t);
    };
    std::size_t sum = sizeof(*this) + bytes_of(begin) + bytes_of(triangles) + bytes_of(piece_of) +
                      tree.bytes() + bytes_of(triangle_at) + bytes_of(components) +
                      faces.capacity() * sizeof(PieceFaces);
    for (const PieceFaces& f : faces)
        sum += bytes_of(f.face_of_edge) + bytes_of(f.begin) + bytes_of(f.triangles);
    return sum;
}

} // namespace abut
