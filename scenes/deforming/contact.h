#pragma once

#include <abut/deformable.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

/// Contacts for a simulator: features that a query has found, with a direction along which to keep
/// them apart.
namespace abut::scenes {

/// A point of one feature and a point of another, each a weighted sum of vertices. The weights of
/// the first sum to 1, those of the second to -1. So sum(weights[i] x[vertices[i]]) is the offset
/// from the second point to the first.
struct Contact {
    ElementaryKind kind = ElementaryKind::vertex_face; ///< determines which vertices belong to the
                                                       ///< first feature
    std::array<std::uint32_t, 4> vertices{};
    std::array<double, 4> weights{};
    Vec3 normal; ///< unit vector from the second feature towards the first

    [[nodiscard]] Vec3 offset(std::span<const Vec3> positions) const;
    /// The number of vertices of the first feature, one or two. They come first.
    [[nodiscard]] std::size_t first_count() const {
        return kind == ElementaryKind::vertex_face ? 1 : 2;
    }
};

/// The contact of two features near each other at these positions. Nothing if they touch, since no
/// direction separates them then.
std::optional<Contact> contact_of(const Deformable& surface, const FeaturePair& pair,
                                  std::span<const Vec3> positions);
/// The contact of two features that meet. Nothing if the impact has no normal.
std::optional<Contact> contact_of(const Deformable& surface, const FeatureImpact& impact);

} // namespace abut::scenes
