#pragma once

#include <abut/deformable.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

/// What a simulator makes of the features that a query finds: a direction along which to keep them
/// apart.
namespace abut::scenes {

/// A point of one feature and a point of another, each a weighted sum of vertices. The weights of
/// the first add up to 1, those of the second to -1, so that sum(weights[i] x[vertices[i]]) is the
/// offset from the second point to the first.
struct Contact {
    ElementaryKind kind = ElementaryKind::vertex_face; ///< says which vertices are the first's
    std::array<std::uint32_t, 4> vertices{};
    std::array<double, 4> weights{};
    Vec3 normal; ///< unit, from the second feature towards the first

    [[nodiscard]] Vec3 offset(std::span<const Vec3> positions) const;
    /// The vertices of the first feature come first: one, or two.
    [[nodiscard]] std::size_t first_count() const {
        return kind == ElementaryKind::vertex_face ? 1 : 2;
    }
};

/// The contact of two features near each other at these positions; nothing if they touch, since no
/// direction parts them then.
std::optional<Contact> contact_of(const Deformable& surface, const FeaturePair& pair,
                                  std::span<const Vec3> positions);
/// The contact of two features that meet; nothing if they have no normal.
std::optional<Contact> contact_of(const Deformable& surface, const FeatureImpact& impact);

} // namespace abut::scenes
