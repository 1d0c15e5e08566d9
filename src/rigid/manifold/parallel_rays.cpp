#include "rigid/manifold/parallel_rays.h"

#include "tree/traverse_one.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// More triangles cost more to place than a few rays through the whole model.
constexpr std::size_t kMostTriangles = 192;

} // namespace

void ParallelRays::begin(const ManifoldSide& side, const RegionFrame& frame, double radius,
                         bool many) {
    side_ = &side, frame_ = &frame, radius_ = radius;
    state_ = many ? State::not_sought : State::whole_model;
}

void ParallelRays::seek() {
    state_ = State::whole_model;
    triangles_.clear(), slots_.clear(), extents_.clear();
    const PlacedModel& model = side_->model();
    const Vec3 &centre = frame_->centre, &normal = frame_->normal;
    const double far = length(model.middle() - centre) + model.reach() + 2 * radius_;
    // Bounds the rounding of places in the frame, and of lines along the normal there.
    const double rounding = 0x1p-44 * (magnitude(centre) + far);
    far_ = far;
    const auto clipped =
        model.tree_segment(centre - far * normal, centre + far * normal, radius_ + rounding);
    if (clipped)
        for_each_along_segment(model.data().tree(), clipped->segment, [&](std::uint32_t slot) {
            if (triangles_.size() == kMostTriangles + 1)
                return -2.0F; // before the segment: no further triangle is visited
            triangles_.push_back(model.world_slot(slot)), slots_.push_back(slot);
            return 1.0F;
        });
    if (triangles_.size() > kMostTriangles)
        return;
    state_ = State::found;
    for (const Triangle& t : triangles_) {
        const auto range = [&](const Vec3& way) {
            const double u = dot(way, t[0] - centre), v = dot(way, t[1] - centre),
                         w = dot(way, t[2] - centre);
            return std::pair(std::min({u, v, w}) - rounding, std::max({u, v, w}) + rounding);
        };
        const auto [left, right] = range(frame_->across);
        const auto [lower, upper] = range(frame_->upwards);
        const auto [bottom, top] = range(normal);
        extents_.push_back({left, right, lower, upper, bottom, top});
    }
}

ManifoldSide::SurfaceHit ParallelRays::first_hit(const Vec3& point, const Vec3& direction) const {
    ManifoldSide::SurfaceHit first;
    const bool forward = dot(direction, frame_->normal) > 0;
    const double x = frame_->right(point), y = frame_->up(point),
                 z = dot(frame_->normal, point - frame_->centre);
    for (std::size_t i = 0; i < extents_.size(); ++i) {
        const Extent& e = extents_[i];
        const bool may_meet = bool((e.left <= x) & (x <= e.right) & (e.lower <= y) &
                                   (y <= e.upper) & (forward ? e.top >= z : e.bottom <= z));
        if (!may_meet)
            continue;
        side_->take_earlier(slots_[i], triangles_[i], point, direction, first);
    }
    return first;
}

ManifoldSide::LineHit ParallelRays::top_along(const Vec3& point, const Vec3& direction) {
    if (state_ == State::not_sought)
        seek();
    const double x = frame_->right(point), y = frame_->up(point),
                 z = dot(frame_->normal, point - frame_->centre);
    if (state_ == State::whole_model || !(x * x + y * y <= radius_ * radius_) ||
        !(std::abs(z) <= far_))
        return side_->top_along(point, direction);
    return side_->top_along(point, direction,
                            [this](const Vec3& p, const Vec3& way) { return first_hit(p, way); });
}

} // namespace abut
