#include "world/schedule/model_impact.h"

#include "rigid/motion/first_impact.h"
#include "world/narrow_phase/offset_surface.h"

namespace abut {

Impact model_impact(const MovingBody& model, const MovingBody& solid, double tolerance,
                    const ImpactOptions& options) {
    const OffsetSurface core = offset_surface_of(solid.shape);
    const Motion& motion = solid.motion;
    const Trajectory of_core(compose(motion.start, core.body_from_surface), motion.centre,
                             motion.velocity, motion.angular_velocity);
    ImpactOptions asked = options;
    asked.absolute_error = tolerance;
    Impact impact = first_impact({std::get<Model>(model.shape), Trajectory(model.motion)},
                                 {core.surface, of_core}, core.radius, 1, asked);
    impact.point_b = impact.point_b - core.radius * impact.normal;
    impact.triangle_b = 0;
    return impact;
}

} // namespace abut
