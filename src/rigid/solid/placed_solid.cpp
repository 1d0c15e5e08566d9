#include "rigid/solid/placed_solid.h"

#include "math/transform.h"

namespace abut {

PlacedSolid::PlacedSolid(const Model& model, const Solid& solid, const Transform& world_from_model,
                         const std::optional<Vec3>& origin)
    : model_(model, world_from_model, origin), solid_(solid) {
    mirrored_ = is_mirroring(model_.world());
    if (solid.may_overlap || solid.has_sheets)
        boundary_ = PlacedBoundary(model.data().boundary(), world_from_model, origin);
}

std::vector<Vec3> PlacedSolid::component_points() const {
    std::vector<Vec3> points;
    points.reserve(solid_.components.size());
    for (const std::uint32_t triangle : solid_.components)
        points.push_back(model_.world_vertex(model_.data().mesh().triangles[triangle][0]));
    return points;
}

std::vector<EdgeFace> PlacedSolid::faces_around(std::uint32_t triangle, std::size_t edge) const {
    const auto& t = model_.data().mesh().triangles[triangle];
    const Topology& topology = solid_.topology;
    std::vector<EdgeFace> faces;
    for (const HalfEdge& h :
         topology.edge(topology.vertex_of[t[edge]], topology.vertex_of[t[(edge + 1) % 3]]))
        if (solid_.weights.empty() || solid_.weights[h.triangle] != 0)
            faces.push_back({model_.world_vertex(h.from), model_.world_vertex(h.to),
                             model_.world_vertex(h.apex)});
    return faces;
}

Box3 PlacedSolid::world_box() const {
    const Aabb& b = model_.data().tree().bounds;
    Box3 box;
    if (model_.data().tree().empty())
        return box;
    for (unsigned i = 0; i < 8; ++i)
        extend(box, apply(model_.world_from_tree(),
                          {i & 1U ? b.upper[0] : b.lower[0], i & 2U ? b.upper[1] : b.lower[1],
                           i & 4U ? b.upper[2] : b.lower[2]}));
    // The tree's frame is inexact by rounding.
    return grown(box, 0x1p-40 * (reach() + max_abs(middle())));
}

void PlacedSolid::for_each_block(const Box3& /*region*/,
                                 const std::function<bool(const Block&)>& visit) const {
    visit({model_, {}, world_box()});
}

std::optional<int> PlacedSolid::crossings(const Vec3& from, const Vec3& to) const {
    std::optional<int> count =
        abut::crossings(model_, from, to, boundary() == nullptr ? kept() : nullptr, solid_.weights);
    if (!count || !is_oriented())
        return count;
    const int side = solid_.weights.empty() ? solid_.outward : 1;
    return *count * (mirrored_ ? -side : side);
}

void PlacedSolid::for_each_surface_block(const Box3& region,
                                         const std::function<bool(const Block&)>& visit) const {
    if (boundary() == nullptr)
        for_each_block(region, visit);
    else
        visit({boundary_.placed(), boundary()->source, world_box()});
}

double PlacedSolid::winding(const Vec3& point) const {
    // The winding number does not change under an affine map that moves the mesh and the point; a
    // mirroring one turns the boundary, too, so that it still faces outwards.
    const Vec3 in_mesh = apply(inverse(model_.world()), point + model_.origin());
    const Mesh& mesh = model_.data().mesh();
    return is_oriented() ? winding_number(mesh, solid_, in_mesh) : winding_number(mesh, in_mesh);
}

} // namespace abut
