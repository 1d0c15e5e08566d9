#include "world/schedule/core_impact.h"

#include "rigid/motion/first_impact.h"
#include "world/narrow_phase/offset_surface.h"

namespace abut {

namespace {

MovingModel moving(const OffsetSurface& core, const Motion& motion) {
    return {core.surface, Trajectory(compose(motion.start, core.body_from_surface), motion.centre,
                                     motion.velocity, motion.angular_velocity)};
}

bool has_triangles(const MovingBody& body) {
    return std::holds_alternative<Model>(body.shape);
}

} // namespace

Impact core_impact(const MovingBody& a, const MovingBody& b, double tolerance,
                   const ImpactOptions& options) {
    const OffsetSurface core_a = offset_surface_of(a.shape), core_b = offset_surface_of(b.shape);
    ImpactOptions asked = options;
    asked.absolute_error = tolerance;
    Impact impact = first_impact(moving(core_a, a.motion), moving(core_b, b.motion),
                                 core_a.radius + core_b.radius, 1, asked);
    impact.point_a = impact.point_a + core_a.radius * impact.normal;
    impact.point_b = impact.point_b - core_b.radius * impact.normal;
    if (!has_triangles(a))
        impact.triangle_a = 0;
    if (!has_triangles(b))
        impact.triangle_b = 0;
    return impact;
}

} // namespace abut
