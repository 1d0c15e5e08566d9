#include "walk/probe.h"

#include "math/transform.h"
#include "rigid/shapes/shape_arguments.h"

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

} // namespace

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
