#include "rigid/model/convex_surface.h"

#include "rigid/model/model_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace abut {

namespace {

constexpr std::size_t kMostConvexPlanes = 96, kMostConvexTriangles = 1024;
constexpr double kConvexFlat = 0x1p-40; ///< of the size
/// A solid that is thinner than this share of its size counts as none.
constexpr double kThinSolid = 0x1p-20;

/// The corners of a surface, each once.
ConvexSurface corners_of(const ModelData& model) {
    ConvexSurface surface;
    const std::vector<std::uint32_t>& vertex_of = model.solid().topology.vertex_of;
    for (const auto& t : model.mesh().triangles)
        for (const std::uint32_t v : t)
            surface.vertices.push_back(vertex_of[v]);
    std::sort(surface.vertices.begin(), surface.vertices.end());
    surface.vertices.erase(std::unique(surface.vertices.begin(), surface.vertices.end()),
                           surface.vertices.end());
    for (const std::uint32_t v : surface.vertices)
        surface.corners.push_back(model.mesh().positions[v]);
    for (const Vec3& p : surface.corners)
        surface.middle = surface.middle + (1 / static_cast<double>(surface.corners.size())) * p;
    for (const Vec3& p : surface.corners)
        surface.reach = std::max(surface.reach, length(p - surface.middle));
    return surface;
}

/// Adds a plane for each triangle that lies in none of the others. Returns false if a corner lies beyond
/// one.
bool add_planes(const ModelData& model, ConvexSurface& surface) {
    const Mesh& mesh = model.mesh();
    const double flat = kConvexFlat * surface.reach, outward = model.solid().outward;
    std::vector<Vec3> areas;
    for (const auto& [i, j, k] : mesh.triangles)
        areas.push_back(outward * cross(mesh.positions[j] - mesh.positions[i],
                                        mesh.positions[k] - mesh.positions[i]));
    std::vector<std::uint32_t> order(areas.size());
    std::iota(order.begin(), order.end(), 0U);
    // The planes of large triangles are known best.
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t s, std::uint32_t t) {
        return length_sq(areas[s]) > length_sq(areas[t]);
    });
    for (const std::uint32_t t : order) {
        const auto lies_in = [&](const ConvexSurface::Plane& plane) {
            return std::all_of(
                mesh.triangles[t].begin(), mesh.triangles[t].end(), [&](std::uint32_t v) {
                    return dot(plane.normal, mesh.positions[v]) >= plane.offset - flat;
                });
        };
        if (std::any_of(surface.planes.begin(), surface.planes.end(), lies_in))
            continue;
        const Vec3 normal = normalized_or_zero(areas[t]);
        double offset = -HUGE_VAL, lowest = HUGE_VAL;
        for (const Vec3& p : surface.corners) {
            offset = std::max(offset, dot(normal, p));
            lowest = std::min(lowest, dot(normal, p));
        }
        const double here = dot(normal, mesh.positions[mesh.triangles[t][0]]);
        if (normal == Vec3{} || offset > here + flat ||
            surface.planes.size() == kMostConvexPlanes ||
            !(offset - lowest > kThinSolid * surface.reach))
            return false;
        surface.planes.push_back({normal, offset});
    }
    return true;
}

std::optional<ConvexSurface> convex_surface(const ModelData& model) {
    const std::size_t triangles = model.mesh().triangles.size();
    if (triangles < 4 || triangles > kMostConvexTriangles)
        return std::nullopt;
    const Solid& solid = model.solid();
    if (!solid.closed || solid.outward == 0 || solid.components.size() != 1 ||
        !solid.weights.empty() || !solid.copies.empty() || !is_closed(solid.topology))
        return std::nullopt;
    ConvexSurface surface = corners_of(model);
    if (!add_planes(model, surface))
        return std::nullopt;
    return surface;
}

} // namespace

const ConvexSurface* LazyConvexSurface::of(const ModelData& model) const {
    std::call_once(once_, [&] { surface_ = convex_surface(model); });
    return surface_ ? &*surface_ : nullptr;
}

} // namespace abut
