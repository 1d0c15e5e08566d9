#include "world/narrow_phase/contact_rounding.h"

#include "convex/body/convex_data.h"
#include "math/vector.h"
#include "rigid/model/model_data.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <variant>

namespace abut {

namespace {

/// The numbers that distinguish bodies: those of the shape first, because they never change.
template <typename Solid>
auto order_of(const Solid& solid, const Transform& world_from_body) {
    const auto& [x, y, z] = solid.axis;
    return std::tie(solid.half, solid.radius, world_from_body.m, solid.centre.x, solid.centre.y,
                    solid.centre.z, x.x, x.y, x.z, z.x, z.y, z.z);
}

/// A deformable's model is only made when a query needs it.
double contact_share(const DeformableShape& deformable) {
    return contact_share(deformable.snapshot->model());
}

/// Surfaces and convex bodies.
template <typename Shape>
constexpr bool kIsExact = std::is_same_v<Shape, Model> || std::is_same_v<Shape, DeformableShape> ||
                          std::is_same_v<Shape, ConvexShape>;

} // namespace

double contact_share(const Model& model) {
    // The tree has about the size 1, and its frame is a scaled rotation.
    const auto& m = model.data().model_from_tree().m;
    return kContactRounding * 2 *
           std::max({max_abs({m[0], m[1], m[2]}), max_abs({m[3], m[4], m[5]}),
                     max_abs({m[6], m[7], m[8]})});
}

double contact_share(const ConvexShape& convex) {
    return kContactRounding * convex.solid.data().reach;
}

double contact_share(const CurvedShape& curved) {
    return kContactRounding * curved.solid.reach;
}

double contact_share(const PlaneShape& /*plane*/) {
    return 0; // its gaps are closed forms, rounded as the other body
}

double contact_share(const BodyShape& shape, const Box3& own_bounds) {
    if (is_deformable(shape)) // at least the share of a model with these bounds
        return kContactRounding * 4 * max_abs(own_bounds.upper - own_bounds.lower);
    return std::visit([](const auto& kind) { return contact_share(kind); }, shape);
}

double contact_rounding(const PlacedBody& a, const PlacedBody& b) {
    return std::visit(
        [](const auto& shape_a, const auto& shape_b) -> double {
            if constexpr (kIsExact<std::decay_t<decltype(shape_a)>> &&
                          kIsExact<std::decay_t<decltype(shape_b)>>)
                return 0;
            else
                return contact_share(shape_a) + contact_share(shape_b);
        },
        a.shape, b.shape);
}

bool comes_before(const RoundedBox& a, const Transform& world_from_a, const RoundedBox& b,
                  const Transform& world_from_b) {
    return order_of(a, world_from_a) < order_of(b, world_from_b);
}

bool comes_before(const CurvedShape& a, const Transform& world_from_a, const CurvedShape& b,
                  const Transform& world_from_b) {
    if (a.solid.kind != b.solid.kind)
        return a.solid.kind < b.solid.kind;
    return order_of(a.solid, world_from_a) < order_of(b.solid, world_from_b);
}

} // namespace abut
