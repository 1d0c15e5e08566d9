#include "walk/probe.h"

#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"
#include "world/narrow_phase/offset_surface.h"

namespace abut {

namespace {

bool is_rigid(const Transform& t) {
    constexpr double kRounding = 0x1p-40; // more than a rotation from a quaternion has
    const auto& m = t.m;
    const Vec3 x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]}, z{m[6], m[7], m[8]};
    const auto is = [](double value, double wanted) {
        return std::abs(value - wanted) <= kRounding;
    };
    return is(dot(x, x), 1) && is(dot(y, y), 1) && is(dot(z, z), 1) && is(dot(x, y), 0) &&
           is(dot(y, z), 0) && is(dot(z, x), 0);
}

/// The box, axis or centre of a rounded box.
Model core_surface(const RoundedBox& box) {
    const auto corner = [&](double x, double y, double z) {
        return box.centre + x * box.half[0] * box.axis[0] + y * box.half[1] * box.axis[1] +
               z * box.half[2] * box.axis[2];
    };
    if (box.half[0] == 0 && box.half[1] == 0)
        return Model(Mesh{{corner(0, 0, -1), corner(0, 0, 1)}, {{0, 1, 1}}});
    Mesh mesh = unit_cube().mesh();
    for (Vec3& p : mesh.positions)
        p = corner(p.x, p.y, p.z);
    return Model(std::move(mesh));
}

Model surface_of_probe(const BodyShape& shape) {
    if (const auto* box = std::get_if<RoundedBox>(&shape))
        return core_surface(*box);
    if (const auto* convex = std::get_if<ConvexShape>(&shape))
        return convex->surface;
    return std::get<Model>(shape);
}

} // namespace

ProbeData::ProbeData(BodyShape shape)
    : shape_(std::move(shape)), own_bounds_(bounds_of(shape_)), surface_(surface_of_probe(shape_)),
      has_inside_(!std::holds_alternative<Model>(shape_) && radius() == 0) {}

Probe::Probe(const Model& model) : data_(std::make_shared<const ProbeData>(model)) {}
Probe::Probe(const Convex& convex) : data_(std::make_shared<const ProbeData>(shape_of(convex))) {}
Probe::Probe(const Sphere& sphere) : data_(std::make_shared<const ProbeData>(shape_of(sphere))) {}
Probe::Probe(const Capsule& capsule)
    : data_(std::make_shared<const ProbeData>(shape_of(capsule))) {}
Probe::Probe(const Box3& box) : data_(std::make_shared<const ProbeData>(shape_of(box))) {}

PlacedProbe::PlacedProbe(const Probe& probe, const Transform& world_from_probe)
    : data_(probe.data()), world_from_probe_(world_from_probe) {
    require_finite(world_from_probe, "transform of the probe");
    require(std::holds_alternative<Model>(data_.shape()) || is_rigid(world_from_probe),
            "transform of a probe that is not a model must be a rotation and a translation");
    if (!is_empty(data_.own_bounds()))
        box_ = bounds_of(data_.shape(), data_.own_bounds(), world_from_probe);
}

} // namespace abut
