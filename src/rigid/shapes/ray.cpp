#include <abut/shape_queries.h>

#include "core/parallel.h"
#include "rigid/shapes/ray_candidate.h"
#include "rigid/shapes/shape_arguments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace abut {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The part of a ray that may meet a model, by its lengths from the ray's origin.
class RaySpan {
public:
    RaySpan(const Ray& ray, const PlacedModel& model) {
        // Lengths are used, since squares of multiples of the direction may be out of range.
        const Vec3& d = ray.direction;
        std::frexp(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), &exponent_);
        const Vec3 scaled{std::ldexp(d.x, -exponent_), std::ldexp(d.y, -exponent_),
                          std::ldexp(d.z, -exponent_)};
        scaled_length_ = length(scaled);
        const Vec3 unit = (1 / scaled_length_) * scaled;
        const Vec3 to_middle = model.middle() - ray.origin;
        // Bounds the error of every length and every point below.
        const double error =
            64 * 0x1p-53 * (magnitude(ray.origin) + magnitude(model.middle()) + model.reach());
        const double nearest = dot(to_middle, unit), reach = model.reach() + error;
        const auto widened = [&](double length, double direction) {
            return length + direction * (0x1p-48 * std::abs(length) + error);
        };
        begin_ = std::max(nearest - reach, widened(length_at(ray.t_min), -1));
        end_ = std::min(nearest + reach, widened(length_at(ray.t_max), 1));
        if (begin_ <= end_)
            clipped_ =
                model.tree_segment(ray.origin + begin_ * unit, ray.origin + end_ * unit, error);
    }

    [[nodiscard]] const std::optional<ClippedSegment>& clipped() const { return clipped_; }

    /// A parameter of the clipped segment (middle + s half) that is not before the ray's t, which
    /// is as precise as ray_triangle_intersect computes it.
    [[nodiscard]] float segment_parameter(double t) const {
        const double length = length_at(t) + 0x1p-39 * std::abs(length_at(t));
        const double fraction = (length - begin_) / (end_ - begin_);
        const double s = 2 * (fraction - clipped_->begin) / (clipped_->end - clipped_->begin) - 1;
        // Returns 1 also if a length is zero and s is not a number.
        return s < 1 ? round_up(std::max(s, -1.0)) : 1;
    }

private:
    [[nodiscard]] double length_at(double t) const {
        return std::ldexp(t, exponent_) * scaled_length_;
    }

    int exponent_ = 0;
    double scaled_length_ = 0, begin_ = 0, end_ = 0;
    std::optional<ClippedSegment> clipped_;
};

/// Orders hits by t, then by triangle index.
bool before(const Ray& ray, const RayCandidate& a, const RayCandidate& b) {
    const int order = compare_hits(ray, a.corners, a.hit, b.corners, b.hit);
    return order != 0 ? order < 0 : a.triangle < b.triangle;
}

bool may_meet(const Ray& ray) {
    return ray.t_min <= ray.t_max && ray.t_min < kInfinity && ray.t_max > -kInfinity;
}

RayHit find_first(const PlacedModel& model, const Ray& ray) {
    const auto first = first_candidate(model, ray);
    return first ? describe(ray, *first) : RayHit();
}

} // namespace

std::optional<RayCandidate> first_candidate(const PlacedModel& model, const Ray& ray) {
    if (!may_meet(ray))
        return std::nullopt;
    const RaySpan span(ray, model);
    if (!span.clipped())
        return std::nullopt;
    std::optional<RayCandidate> first;
    float bound = 1;
    for_each_along_segment(model.data().tree(), span.clipped()->segment, [&](std::uint32_t slot) {
        const Triangle corners = model.world_slot(slot);
        if (const auto hit = ray_triangle_intersect(ray, corners)) {
            const RayCandidate candidate{model.data().triangle_at(slot), corners, *hit};
            if (!first || before(ray, candidate, *first)) {
                first = candidate;
                bound = span.segment_parameter(hit->t);
            }
        }
        return bound;
    });
    return first;
}

RayHit describe(const Ray& ray, const RayCandidate& c) {
    const auto w = hit_weights(ray, c.corners, c.hit);
    RayHit result;
    result.meet = true;
    result.t = c.hit.t;
    result.point = w[0] * c.corners[0] + w[1] * c.corners[1] + w[2] * c.corners[2];
    result.triangle = c.triangle;
    result.barycentric = w;
    result.side = c.hit.side > 0 ? HitSide::front : c.hit.side < 0 ? HitSide::back : HitSide::along;
    return result;
}

RayHit first_hit(const Model& model, const Transform& world_from_model, const Ray& ray,
                 const Progress& progress) {
    require_ray(ray);
    const StopScope stopping(progress);
    return find_first(PlacedModel(model, world_from_model), ray);
}

std::vector<RayHit> first_hit(const Model& model, const Transform& world_from_model,
                              std::span<const Ray> rays, const Progress& progress) {
    for (const Ray& ray : rays)
        require_ray(ray);
    const StopScope stopping(progress);
    const PlacedModel placed(model, world_from_model);
    std::vector<RayHit> results(rays.size());
    parallel_for(rays.size(), kShapesPerTask,
                 [&](std::size_t i) { results[i] = find_first(placed, rays[i]); });
    return results;
}

std::vector<RayHit> all_hits(const Model& model, const Transform& world_from_model, const Ray& ray,
                             const Progress& progress) {
    require_ray(ray);
    const StopScope stopping(progress);
    const PlacedModel placed(model, world_from_model);
    if (!may_meet(ray))
        return {};
    const RaySpan span(ray, placed);
    if (!span.clipped())
        return {};
    std::vector<RayCandidate> candidates;
    for_each_on_segment(placed.data().tree(), span.clipped()->segment, [&](std::uint32_t slot) {
        const Triangle corners = placed.world_slot(slot);
        if (const auto hit = ray_triangle_intersect(ray, corners))
            candidates.push_back({placed.data().triangle_at(slot), corners, *hit});
    });
    std::sort(candidates.begin(), candidates.end(),
              [&](const RayCandidate& a, const RayCandidate& b) { return before(ray, a, b); });
    std::vector<RayHit> results;
    results.reserve(candidates.size());
    for (const RayCandidate& c : candidates) {
        results.push_back(describe(ray, c));
        // Keeps the order where rounding, within its bound, would break it.
        if (results.size() > 1)
            results.back().t = std::max(results.back().t, results[results.size() - 2].t);
    }
    return results;
}

} // namespace abut
