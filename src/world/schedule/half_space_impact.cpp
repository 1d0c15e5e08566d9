#include "world/schedule/half_space_impact.h"

#include "deform/deformable_data.h"
#include "math/transform.h"
#include "rigid/motion/impact_steps.h"
#include "rigid/motion/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace abut {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Rounding error of a length, relative to the quantities it was computed from.
constexpr double kVertexRounding = 0x1p-44;

Vec3 vertex_at(const MovingVertex& vertex, double time) {
    return (1 - time) * vertex.start + time * vertex.end;
}

class VertexAdvancement {
public:
    VertexAdvancement(const Deformable& surface, const MovingBody& half_space,
                      const ImpactOptions& options)
        : data_(surface.data()), plane_(std::get<PlaneShape>(half_space.shape)),
          motion_(half_space.motion), steps_(options) {
        find_used();
        Box3 step, start;
        for (const std::uint32_t i : used_) {
            const MovingVertex& vertex = data_.vertices[i];
            extend(start, vertex.start), extend(step, vertex.start), extend(step, vertex.end);
            // The distance from the centre is largest at the start or at the end.
            lever_ = std::max({lever_, length(vertex.start - motion_.centre),
                               length(vertex.end - motion_.centre - motion_.velocity)});
        }
        margin_ = kVertexRounding *
                  (max_abs(step.lower) + max_abs(step.upper) + max_abs(plane_.point) +
                   max_abs(motion_.start.translation) + max_abs(motion_.velocity) + lever_);
        asked_tolerance_ = options.absolute_error.value_or(0.5 * kImpactTolerance *
                                                           length(start.upper - start.lower));
        tolerance_ = std::max(asked_tolerance_, 4 * margin_);
    }

    Impact run() {
        constexpr std::uint64_t kMostSteps = 1000;
        Impact impact;
        Lowest lowest = at_time(0);
        while (lowest.height > tolerance_ && steps_.count() < kMostSteps) {
            if (!steps_.take(lowest.time)) {
                impact = out_of_steps(lowest.time);
                break;
            }
            const double next = lowest.time + lowest.free * (1 - kVertexRounding);
            if (!(next <= 1))
                break;
            lowest = at_time(next);
        }
        if (!impact.meet && (lowest.height <= tolerance_ || steps_.count() >= kMostSteps))
            impact = hit(lowest);
        impact.steps = steps_.count();
        return impact;
    }

private:
    /// Lists the vertices of triangles. Others are no part of the surface.
    void find_used() {
        std::vector<bool> is_used(data_.vertices.size());
        for (const IndexTriangle& triangle : data_.triangles)
            for (const std::uint32_t i : triangle)
                is_used[i] = true;
        for (std::uint32_t i = 0; i < is_used.size(); ++i)
            if (is_used[i])
                used_.push_back(i);
    }

    /// The vertex nearest to the plane at a time, and how long no vertex reaches the plane.
    struct Lowest {
        double time = 0, height = kNever, free = kNever, speed = 0;
        std::uint32_t vertex = 0;
        Vec3 point, normal;
    };

    [[nodiscard]] Lowest at_time(double time) const {
        const Transform now = at(motion_, time);
        const PlaneShape plane = placed(plane_, now);
        const double turn = length(motion_.angular_velocity);
        Lowest lowest;
        lowest.time = time, lowest.normal = plane.normal;
        for (const std::uint32_t i : used_) {
            const MovingVertex& vertex = data_.vertices[i];
            const Vec3 point = vertex_at(vertex, time),
                       way = vertex.end - vertex.start - motion_.velocity;
            const double height = dot(plane.normal, point - plane.point);
            const double speed =
                (turn > 0 ? length(way) + turn * lever_ : -dot(plane.normal, way)) + margin_;
            if (height < lowest.height) {
                lowest.height = height, lowest.vertex = i, lowest.point = point;
                lowest.speed = speed;
            }
            if (speed > 0)
                lowest.free = std::min(lowest.free, (height - margin_ - 0.5 * tolerance_) / speed);
        }
        lowest.free = std::max(lowest.free, 0.0);
        return lowest;
    }

    [[nodiscard]] Impact hit(const Lowest& lowest) const {
        Impact impact;
        impact.meet = true, impact.time = lowest.time, impact.gap = std::max(lowest.height, 0.0);
        impact.point_a = lowest.point;
        impact.point_b = lowest.point - lowest.height * lowest.normal;
        impact.normal = -lowest.normal;
        const auto has_vertex = [&](const IndexTriangle& t) {
            return std::find(t.begin(), t.end(), lowest.vertex) != t.end();
        };
        impact.triangle_a = static_cast<std::uint32_t>(
            std::find_if(data_.triangles.begin(), data_.triangles.end(), has_vertex) -
            data_.triangles.begin());
        impact.status = Status::bound_only;
        const double wait = lowest.speed > 0 ? 2 * tolerance_ / lowest.speed : 0;
        for (const double time : {lowest.time, std::min(1.0, lowest.time + wait)})
            if (at_time(time).height <= 0) {
                impact.contact_time = time;
                impact.status = impact.gap <= asked_tolerance_ ? Status::exact : Status::converged;
                break;
            }
        return impact;
    }

    const DeformableData& data_;
    const PlaneShape& plane_;
    const Motion& motion_;
    ImpactSteps steps_;
    std::vector<std::uint32_t> used_;
    double lever_ = 0;  ///< no vertex is ever farther from the centre of the half-space's motion
    double margin_ = 0; ///< rounding error of lengths
    double asked_tolerance_ = 0, tolerance_ = 0;
};

} // namespace

Impact half_space_impact(const Deformable& surface, const MovingBody& half_space,
                         const ImpactOptions& options) {
    return VertexAdvancement(surface, half_space, options).run();
}

} // namespace abut
