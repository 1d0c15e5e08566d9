#include "scenes/deforming/contact.h"

#include "scenes/deforming/frame.h"

namespace abut::scenes {

namespace {

/// The contact of a FeaturePair or a FeatureImpact, without the normal.
template <class Pair>
Contact without_normal(const Deformable& surface, const Pair& pair) {
    Contact contact;
    contact.kind = pair.kind;
    const auto& [u, v, w] = pair.barycentric;
    if (pair.kind == ElementaryKind::vertex_face) {
        const auto& face = surface.triangles()[pair.b];
        contact.vertices = {pair.a, face[0], face[1], face[2]};
        contact.weights = {1, -u, -v, -w};
    } else {
        const auto &a = surface.edges()[pair.a], &b = surface.edges()[pair.b];
        contact.vertices = {a[0], a[1], b[0], b[1]};
        contact.weights = {1 - u, u, v - 1, -v};
    }
    return contact;
}

} // namespace

Vec3 Contact::offset(std::span<const Vec3> positions) const {
    Vec3 sum;
    for (std::size_t i = 0; i < 4; ++i)
        sum = add(sum, scaled(positions[vertices[i]], weights[i]));
    return sum;
}

std::optional<Contact> contact_of(const Deformable& surface, const FeaturePair& pair,
                                  std::span<const Vec3> positions) {
    Contact contact = without_normal(surface, pair);
    const Vec3 offset = contact.offset(positions);
    const double distance = norm(offset);
    if (distance == 0)
        return std::nullopt;
    contact.normal = scaled(offset, 1 / distance);
    return contact;
}

std::optional<Contact> contact_of(const Deformable& surface, const FeatureImpact& impact) {
    Contact contact = without_normal(surface, impact);
    if (impact.normal == Vec3{})
        return std::nullopt;
    contact.normal = impact.normal;
    return contact;
}

} // namespace abut::scenes
