#include "rigid/pair/gap_frame.h"

namespace abut {

GapFrame::GapFrame(const Vec3& from, const Vec3& to) : origin_(from) {
    const Vec3 across = to - from;
    const double size = max_abs(across);
    if (!(size > 0) || !is_finite(across))
        return;
    // Divided by the largest coordinate first, so that no square underflows.
    axes_[2] = normalized_or_zero({across.x / size, across.y / size, across.z / size});
    axes_[0] = perpendicular(axes_[2]);
    axes_[1] = cross(axes_[2], axes_[0]);
}

} // namespace abut
