#include "world/contacts/convex_faces.h"

#include "convex/body/convex_data.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

namespace abut {

namespace {

/// More faces cost more than triangles by pairs do.
constexpr std::size_t kMostFaces = 96;
/// A solid that is thinner than this share of its size has no inside for these contacts.
constexpr double kThin = 0x1p-20;

std::optional<ConvexFaces> faces_of(const RoundedBox& box, const Transform& world_from_body) {
    const auto [least, most] = std::minmax({box.half[0], box.half[1], box.half[2]});
    if (box.radius > 0 || !(least > kThin * most))
        return std::nullopt;
    const RoundedBox there = placed(box, world_from_body);
    ConvexFaces faces;
    auto& m = faces.world_from_solid.m;
    for (std::size_t k = 0; k < 3; ++k) {
        Vec3 axis;
        (k == 0 ? axis.x : k == 1 ? axis.y : axis.z) = 1;
        faces.planes.push_back({axis, box.half[k]});
        faces.planes.push_back({-axis, box.half[k]});
        m[3 * k] = there.axis[k].x, m[3 * k + 1] = there.axis[k].y;
        m[3 * k + 2] = there.axis[k].z;
    }
    m[9] = there.centre.x, m[10] = there.centre.y, m[11] = there.centre.z;
    for (unsigned i = 0; i < 8; ++i)
        faces.vertices.push_back({(i & 1U) != 0 ? box.half[0] : -box.half[0],
                                  (i & 2U) != 0 ? box.half[1] : -box.half[1],
                                  (i & 4U) != 0 ? box.half[2] : -box.half[2]});
    faces.numbers.assign({0, 1, 2, 3, 4, 5, 6, 7});
    faces.reach = length({box.half[0], box.half[1], box.half[2]});
    return faces;
}

std::optional<ConvexFaces> faces_of(const ConvexShape& convex, const Transform& world_from_body) {
    const Convex& body = convex.solid;
    const FaceTable& table = *convex.faces;
    if (body.dimension() < 3 || table.size() > kMostFaces)
        return std::nullopt;
    ConvexFaces faces;
    faces.world_from_solid = world_from_body;
    const auto& vertices = body.vertices();
    faces.vertices.assign(vertices.begin(), vertices.end());
    for (const Vec3& v : vertices)
        faces.middle = faces.middle + v;
    faces.middle = (1 / static_cast<double>(vertices.size())) * faces.middle;
    for (const Vec3& v : vertices)
        faces.reach = std::max(faces.reach, length(v - faces.middle));
    for (std::uint32_t f = 0; f < table.size(); ++f) {
        if (!(table.offset(f) - dot(table.normal(f), faces.middle) > kThin * faces.reach))
            return std::nullopt;
        faces.planes.push_back({table.normal(f), table.offset(f)});
    }
    faces.numbers.resize(vertices.size());
    std::iota(faces.numbers.begin(), faces.numbers.end(), 0U);
    return faces;
}

std::optional<ConvexFaces> faces_of(const Model& model, const Transform& world_from_body) {
    const ConvexSurface* surface = model.data().convex_surface();
    if (surface == nullptr)
        return std::nullopt;
    ConvexFaces faces;
    faces.world_from_solid = world_from_body;
    faces.planes.assign(surface->planes.begin(), surface->planes.end());
    faces.vertices.assign(surface->corners.begin(), surface->corners.end());
    faces.numbers.assign(surface->vertices.begin(), surface->vertices.end());
    faces.middle = surface->middle, faces.reach = surface->reach;
    faces.is_surface = true;
    return faces;
}

} // namespace

std::optional<ConvexFaces> convex_faces(const BodyShape& shape, const Transform& world_from_body) {
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return faces_of(*box, world_from_body);
    if (const auto* convex = std::get_if<ConvexShape>(&shape))
        return faces_of(*convex, world_from_body);
    if (const auto* model = std::get_if<Model>(&shape))
        return faces_of(*model, world_from_body);
    return std::nullopt;
}

} // namespace abut
