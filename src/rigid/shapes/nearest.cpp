#include <abut/shape_queries.h>

#include "core/parallel.h"
#include "geometry/point_triangle_distance.h"
#include "rigid/shapes/shape_arguments.h"
#include "rigid/solid/placed_solid.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

Nearest on_triangle(const Vec3& point, const PlacedModel& model, std::uint32_t triangle) {
    const NearestOnTriangle n = nearest_on_triangle(point, model.world_triangle(triangle));
    Nearest result;
    result.distance = std::sqrt(n.distance_sq);
    result.point = n.point;
    result.triangle = triangle;
    result.feature = n.dimension == 0   ? Feature::vertex
                     : n.dimension == 1 ? Feature::edge
                                        : Feature::face;
    result.index = n.index;
    result.barycentric = n.weights;
    return result;
}

/// The nearest point by unsigned distance.
Nearest find_nearest(const PlacedModel& model, const Vec3& point, double upper_bound) {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    double best_sq = upper_bound * upper_bound;
    std::uint32_t best = kNone;
    model.for_each_near(point, best_sq, [&](std::uint32_t slot) {
        const double sq = nearest_on_triangle(point, model.world_slot(slot)).distance_sq;
        const std::uint32_t triangle = model.data().triangle_at(slot);
        if (sq < best_sq || (sq == best_sq && best != kNone && triangle < best))
            best_sq = sq, best = triangle;
        return best_sq;
    });
    Nearest result;
    if (best == kNone) {
        result.distance = upper_bound;
        result.status = Status::bound_only;
        return result;
    }
    result = on_triangle(point, model, best);
    // Rounding may give a gap where there is none, or hide one, by far less than this.
    constexpr double kRounding = 0x1p-30;
    if (result.distance <= kRounding * (magnitude(point) + magnitude(result.point))) {
        if (const auto triangle = model.triangle_at(point)) {
            result = on_triangle(point, model, *triangle);
            result.distance = 0;
            result.point = point;
        } else {
            result.distance = std::max(result.distance, std::numeric_limits<double>::min());
        }
    }
    return result;
}

class NearestQuery {
public:
    NearestQuery(const Model& model, const Transform& world_from_model,
                 const NearestOptions& options)
        : options_(options), placed_(model, solid_of(model, options), world_from_model) {}

    [[nodiscard]] Nearest operator()(const Vec3& point) const {
        Nearest result = find_nearest(placed_.model(), point, options_.upper_bound);
        if (!options_.signed_distance)
            return result;
        if (placed_.boundary() != nullptr && placed_.contains(point))
            result = find_on_boundary(point);
        else if (result.distance == 0 || !placed_.contains_off_surface(point))
            return result;
        result.distance = -result.distance;
        return result;
    }

private:
    /// The nearest point of the solid's boundary, for a point inside.
    [[nodiscard]] Nearest find_on_boundary(const Vec3& point) const {
        Nearest found = find_nearest(placed_.surface(), point, options_.upper_bound);
        if (found.status != Status::exact)
            return found;
        const double distance = found.distance;
        const Vec3 at = found.point;
        found = on_triangle(at, placed_.model(), placed_.boundary()->source[found.triangle]);
        found.distance = distance, found.point = at;
        return found;
    }

    static const Solid& solid_of(const Model& model, const NearestOptions& options) {
        static const Solid unexamined;
        require_bound(options.upper_bound);
        if (!options.signed_distance)
            return unexamined;
        const Solid& solid = model.data().solid();
        require(solid.closed && solid.open.empty(), "a signed distance needs a closed model");
        return solid;
    }

    NearestOptions options_;
    PlacedSolid placed_;
};

} // namespace

Nearest nearest(const Model& model, const Transform& world_from_model, const Vec3& point,
                const NearestOptions& options) {
    require_point(point, "point");
    const StopScope stopping(options.progress);
    return NearestQuery(model, world_from_model, options)(point);
}

std::vector<Nearest> nearest(const Model& model, const Transform& world_from_model,
                             std::span<const Vec3> points, const NearestOptions& options) {
    for (const Vec3& point : points)
        require_point(point, "point");
    const StopScope stopping(options.progress);
    const NearestQuery query(model, world_from_model, options);
    std::vector<Nearest> results(points.size());
    parallel_for(points.size(), kShapesPerTask,
                 [&](std::size_t i) { results[i] = query(points[i]); });
    return results;
}

} // namespace abut
