#pragma once

#include "rigid/manifold/region_frame.h"

#include <cstdint>
#include <vector>

namespace abut {

/// Rays along the normal of one region, against one side.
///
/// The triangles near the region's axis are found once. Each ray then looks among them only, and
/// finds what ManifoldSide::top_along finds in the whole model, except that another one of several
/// triangles at the same height may be taken. That function is used for rays that begin farther
/// away, and for regions with few rays or with many triangles near the axis.
class ParallelRays {
public:
    /// Begins with a region. The triangles are sought when the first ray is.
    ///
    /// In          side and frame, which outlive the rays; radius: of the rays around the axis;
    ///             many: more than about 20 rays follow. For fewer, the search does not pay.
    void begin(const ManifoldSide& side, const RegionFrame& frame, double radius, bool many);

    /// ManifoldSide::top_along.
    ///
    /// In          direction: the frame's normal or its opposite.
    [[nodiscard]] ManifoldSide::LineHit top_along(const Vec3& point, const Vec3& direction);

private:
    enum class State : std::uint8_t { not_sought, found, whole_model };
    /// Where a triangle lies in the frame, rounding included.
    struct Extent {
        double left, right, lower, upper, bottom, top;
    };
    void seek();
    [[nodiscard]] ManifoldSide::SurfaceHit first_hit(const Vec3& point,
                                                     const Vec3& direction) const;

    const ManifoldSide* side_ = nullptr;
    const RegionFrame* frame_ = nullptr;
    double radius_ = 0, far_ = 0; ///< of the rays' starts: from the axis, along it
    State state_ = State::not_sought;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> slots_; ///< of the triangles
    std::vector<Extent> extents_;
};

} // namespace abut
