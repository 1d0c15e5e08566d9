#include <abut/walk.h>

#include "rigid/shapes/ray_candidate.h"
#include "rigid/shapes/shape_arguments.h"
#include "walk/near_entry.h"
#include "walk/walk_data.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace abut {

namespace {

/// Lengths along a ray instead of parameters, since multiples of the direction may be out of range.
class RayLengths {
public:
    explicit RayLengths(const Ray& ray) {
        const Vec3& d = ray.direction;
        std::frexp(max_abs(d), &exponent_);
        const Vec3 scaled{std::ldexp(d.x, -exponent_), std::ldexp(d.y, -exponent_),
                          std::ldexp(d.z, -exponent_)};
        scaled_length_ = length(scaled);
        unit_ = (1 / scaled_length_) * scaled;
    }

    [[nodiscard]] const Vec3& unit() const { return unit_; }
    [[nodiscard]] double length_at(double t) const {
        return std::ldexp(t, exponent_) * scaled_length_;
    }
    /// The parameter of a length, rounded down.
    [[nodiscard]] double parameter_before(double length) const {
        const double t = std::ldexp(length / scaled_length_, -exponent_);
        return t - kRounding * std::abs(t);
    }
    /// At least the length of any t that is precise to 2^-40.
    [[nodiscard]] double length_beyond(double t) const {
        const double length = length_at(t);
        return length + kRounding * std::abs(length);
    }
    [[nodiscard]] double length_before(double t) const {
        const double length = length_at(t);
        return length - kRounding * std::abs(length);
    }

    static constexpr double kRounding = 0x1p-38;

private:
    int exponent_ = 0;
    double scaled_length_ = 0;
    Vec3 unit_;
};

struct PartCandidate {
    WalkPart part;
    std::uint32_t triangle; ///< in the whole mesh
    RayCandidate candidate;
};

/// Orders hits by t, then by part, then by triangle.
bool is_before(const Ray& ray, const PartCandidate& a, const PartCandidate& b) {
    const int order = compare_hits(ray, a.candidate.corners, a.candidate.hit, b.candidate.corners,
                                   b.candidate.hit);
    return order != 0 ? order < 0
                      : std::pair(a.part.number, a.triangle) < std::pair(b.part.number, b.triangle);
}

} // namespace

HitPart Walk::first_hit(const Ray& ray, const WalkQuery& query) {
    require_ray(ray);
    const StopScope stopping(query.progress);
    HitPart answer;
    if (!(ray.t_min <= ray.t_max))
        return answer;
    const RayLengths lengths(ray);
    const BoxMotion moving{data_->table().narrow(Box3{ray.origin, ray.origin}), lengths.unit(),
                           lengths.length_before(ray.t_min), lengths.length_beyond(ray.t_max)};
    std::optional<PartCandidate> first;
    Ray rest = ray;
    double until = moving.end, least_skipped = HUGE_VAL;
    const EntryVisit visit_entry(*data_, query, false, answer);
    const auto measure = [&](const NearEntry& entry) {
        const auto found = first_candidate(PlacedModel(entry.model(), entry.world), rest);
        if (!found)
            return until;
        const PartCandidate candidate{entry.part, entry.triangle(found->triangle), *found};
        if (!first || is_before(ray, candidate, *first)) {
            first = candidate;
            const double t = found->hit.t;
            rest.t_max = std::min(ray.t_max, t + RayLengths::kRounding * std::abs(t));
            until = std::min(until, lengths.length_beyond(t));
        }
        return until;
    };
    data_->for_each_met({&moving, 1}, until, [&](std::uint32_t entry, float key) {
        return visit_entry(entry, until, measure,
                           [&] { least_skipped = std::min(least_skipped, double{key}); });
    });
    if (first) {
        const RayHit hit = describe(ray, first->candidate);
        answer.meet = true, answer.part = first->part, answer.t = hit.t;
        answer.point = hit.point, answer.triangle = first->triangle;
        answer.barycentric = hit.barycentric, answer.side = hit.side;
    }
    answer.at_least = answer.t;
    if (least_skipped < HUGE_VAL) {
        const double skipped = std::max(ray.t_min, lengths.parameter_before(least_skipped));
        answer.complete = skipped > answer.t;
        answer.at_least = std::min(answer.t, skipped);
    }
    return answer;
}

} // namespace abut
