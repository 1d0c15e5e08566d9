#include <abut/motion.h>

#include "core/arguments.h"
#include "core/stop.h"
#include "rigid/motion/first_impact.h"

namespace abut {

Impact time_of_impact(const Model& a, const Motion& motion_a, const Model& b,
                      const Motion& motion_b, const ImpactOptions& options) {
    require_not_negative(options.absolute_error.value_or(0), "absolute error");
    const StopScope stopping(options.progress);
    return first_impact({a, Trajectory(motion_a)}, {b, Trajectory(motion_b)}, 0, 1, options);
}

} // namespace abut
