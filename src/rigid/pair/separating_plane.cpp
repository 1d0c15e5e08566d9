#include "rigid/pair/separating_plane.h"

#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr int kDirections = 4;
/// If models overlap by more than this share of their distance along a direction, further
/// directions hardly ever separate them.
constexpr double kHopeless = 0.125;
/// Values above this are not affected by products that underflow.
constexpr double kSmallest = 0x1p-900;

/// The support function of a placed model.
class PlacedSupport {
public:
    PlacedSupport(const SupportBound& support, const Transform& world)
        : support_(support), world_(world), middle_(apply(world, support.middle())) {}

    [[nodiscard]] const Vec3& middle() const { return middle_; }

    /// A world direction in the model's frame.
    [[nodiscard]] Vec3 seen(const Vec3& n) const { return pull_back(world_, n); }
    /// The height from the centre along a direction in the model's frame, as in SupportBound.
    [[nodiscard]] double height(const Vec3& seen) const { return support_.height(seen); }
    [[nodiscard]] Vec3 support(const Vec3& seen) const {
        return apply_linear(world_, support_.support(seen));
    }

    /// Bounds all world coordinates, and all sums on the way to them.
    [[nodiscard]] double reach() const {
        return sum_of_sizes(world_) * (support_.size() + sum_of_sizes(support_.middle())) +
               sum_of_sizes(Vec3{world_.m[9], world_.m[10], world_.m[11]});
    }

private:
    const SupportBound& support_;
    const Transform& world_;
    Vec3 middle_;
};

/// The position on a segment of its point nearest to the origin, as a share of its length.
double nearest_to_origin(const Vec3& p, const Vec3& along) {
    return std::clamp(-dot(p, along) / length_sq(along), 0.0, 1.0);
}

} // namespace

bool far_apart(const ModelData& model_a, const Transform& world_from_a, const ModelData& model_b,
               const Transform& world_from_b, double gap) {
    const PlacedSupport a(model_a.support(), world_from_a), b(model_b.support(), world_from_b);
    const Vec3 between = b.middle() - a.middle();
    const double margin = 0x1p-46 * (a.reach() + b.reach());
    Vec3 nearest = between;
    for (int i = 0; i < kDirections; ++i) {
        const Vec3 n = nearest, n_a = a.seen(n), n_b = b.seen(-n);
        const double apart =
            (dot(n, between) - margin * sum_of_sizes(n)) - (a.height(n_a) + b.height(n_b));
        const double n_sq = length_sq(n);
        if (!(apart > -kHopeless * n_sq) || !(n_sq > kSmallest))
            return false;
        if (apart > kSmallest && apart * apart > gap * gap * n_sq * (1 + 0x1p-40))
            return true;
        const Vec3 along = between + b.support(n_b) - a.support(n_a) - nearest;
        // Half the step from the centre: the first support point is far to one side.
        nearest = nearest + (i == 0 ? 0.5 : 1) * nearest_to_origin(nearest, along) * along;
    }
    return false;
}

SeparatingSlab separation(const ModelData& model_a, const Transform& world_from_a,
                          const ModelData& model_b, const Transform& world_from_b,
                          const Vec3& first) {
    constexpr int kMostDirections = 6;
    constexpr double kWideEnough = 0.75; // of the widest slab that there may be
    const PlacedSupport a(model_a.support(), world_from_a), b(model_b.support(), world_from_b);
    const Vec3 between = b.middle() - a.middle();
    const double margin = 0x1p-46 * (a.reach() + b.reach());
    SeparatingSlab best;
    // The first direction only finds a point of the difference of the sets; later ones point from
    // the origin to the nearest point found of it.
    Vec3 nearest = between, n = first == Vec3{} ? between : first;
    for (int i = 0; i < kMostDirections; ++i) {
        const double n_sq = length_sq(n);
        if (!(n_sq > kSmallest))
            return best;
        const Vec3 n_a = a.seen(n), n_b = b.seen(-n);
        const double apart =
            (dot(n, between) - margin * sum_of_sizes(n)) - (a.height(n_a) + b.height(n_b));
        if (!(apart > -kHopeless * n_sq) && i > 0)
            return best;
        const double size = std::sqrt(n_sq), gap = apart / size * (1 - 0x1p-40);
        if (apart > kSmallest && gap > best.gap)
            best = {gap, (1 / size) * n};
        const Vec3 corner = between + b.support(n_b) - a.support(n_a), along = corner - nearest;
        const bool known = first != Vec3{} && i == 0;
        nearest =
            nearest + (i == 0 && !known ? 0.5 : 1) * nearest_to_origin(nearest, along) * along;
        if (best.gap >= kWideEnough * length(nearest))
            return best;
        n = nearest;
    }
    return best;
}

} // namespace abut
