#include "world/contacts/solid_regions.h"

#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "math/transform.h"
#include "rigid/manifold/region_names.h"
#include "rigid/model/placed_model.h"
#include "world/contacts/solid_on_surface.h"
#include "world/curved/curved_on_surface.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <span>
#include <variant>

namespace abut {

namespace {

/// Where the bodies of a pair are nearest.
class NearestOfBodies final : public NearestOfPair {
public:
    NearestOfBodies(const PlacedBody& a, const PlacedBody& b, const SolidOfPair& solid,
                    double margin, PairWarmStart& warm_start)
        : a_(a), b_(b), solid_(solid), margin_(margin), warm_start_(warm_start) {}

    [[nodiscard]] SolidPlace of_pair() const override {
        if (!of_pair_)
            of_pair_ = find();
        return *of_pair_;
    }
    [[nodiscard]] SolidPlace of_triangle(const Triangle& triangle, double bound) const override {
        if (!faces_) {
            const PlacedBody& body = solid_.is_a ? a_ : b_;
            const OffsetSurface surface = *triangles_of(body.shape);
            // The frame of a box is that of its axes, not of the body.
            faces_.emplace(surface.surface,
                           compose(inverse(solid_.faces->world_from_solid),
                                   compose(body.world_from_body, surface.body_from_surface)));
        }
        SolidPlace nearest;
        nearest.distance = bound;
        faces_->for_each_near_hull(triangle, bound, [&](std::uint32_t slot) {
            const ClosestPoints here =
                triangle_triangle_distance(triangle, faces_->world_slot(slot));
            if (const double distance = std::sqrt(here.distance_sq); distance < nearest.distance)
                nearest = {here.a, here.b, normalized_or_zero(here.b - here.a), distance};
        });
        return nearest;
    }

private:
    [[nodiscard]] SolidPlace find() const {
        const BodyGap gap =
            signed_gap_between(a_, b_, std::nextafter(margin_, HUGE_VAL), warm_start_);
        if (gap.distance > margin_) { // then it has no points
            SolidPlace none;
            none.distance = HUGE_VAL;
            return none;
        }
        const Transform& frame = solid_.faces->world_from_solid;
        const auto to_solid = [&](const Vec3& p) {
            return pull_back(frame, p - Vec3{frame.m[9], frame.m[10], frame.m[11]});
        };
        const Vec3 up = pull_back(frame, solid_.is_a ? -gap.normal : gap.normal);
        return {to_solid(solid_.is_a ? gap.point_b : gap.point_a),
                to_solid(solid_.is_a ? gap.point_a : gap.point_b), up, gap.distance};
    }

    const PlacedBody &a_, &b_;
    const SolidOfPair& solid_;
    double margin_;
    PairWarmStart& warm_start_;
    // Both once they are needed.
    mutable std::optional<SolidPlace> of_pair_;
    mutable std::optional<PlacedModel> faces_; ///< of the solid, in its frame
};

boost::container::small_vector<std::uint64_t, 8>
names_of(const std::vector<ModelManifold>& manifolds) {
    boost::container::small_vector<std::uint64_t, 8> names;
    for (const ModelManifold& m : manifolds)
        for (std::uint32_t i = 0; i < m.count; ++i)
            names.push_back(m.points[i].feature);
    return names;
}

/// Sets the triangle of a convex model on which each point lies.
void set_triangles(const PlacedModel& model, bool is_a, std::vector<ModelManifold>& manifolds) {
    for (ModelManifold& m : manifolds)
        for (std::uint32_t i = 0; i < m.count; ++i) {
            ContactPoint& point = m.points[i];
            const Vec3& at = is_a ? point.point_a : point.point_b;
            double nearest_sq = HUGE_VAL;
            std::uint32_t& triangle = is_a ? point.triangle_a : point.triangle_b;
            model.for_each_near(at, nearest_sq, [&](std::uint32_t slot) {
                const double sq = nearest_on_triangle(at, model.world_slot(slot)).distance_sq;
                const std::uint32_t index = model.data().triangle_at(slot);
                if (sq < nearest_sq || (sq == nearest_sq && index < triangle))
                    nearest_sq = sq, triangle = index;
                return nearest_sq;
            });
        }
}

} // namespace

std::optional<OffsetSurface> triangles_of(const BodyShape& shape) {
    if (const auto* deformable = std::get_if<DeformableShape>(&shape))
        return OffsetSurface{deformable->snapshot->model(), {}, 0};
    if (const auto* box = std::get_if<RoundedBox>(&shape);
        box != nullptr && std::count(box->half.begin(), box->half.end(), 0.0) > 1)
        return std::nullopt;
    if (std::holds_alternative<CurvedShape>(shape) || is_half_space(shape))
        return std::nullopt;
    return offset_surface_of(shape);
}

SolidOfPair solid_of(const PlacedBody& a, const PlacedBody& b) {
    SolidOfPair of_a, of_b;
    if (is_surface(b.shape))
        of_a = {convex_faces(a.shape, a.world_from_body), true};
    if (is_surface(a.shape))
        of_b = {convex_faces(b.shape, b.world_from_body), false};
    return of_a.faces && (!of_b.faces || of_a.faces->reach <= of_b.faces->reach) ? of_a : of_b;
}

std::optional<double> add_solid_regions(const PlacedBody& a, const PlacedBody& b,
                                        const SolidOfPair& solid, double margin,
                                        PairWarmStart& warm_start,
                                        std::vector<ModelManifold>& regions) {
    const std::vector<ModelManifold>& last = warm_start.regions.manifolds;
    const PlacedBody& ground = solid.is_a ? b : a;
    const auto names = names_of(last);
    const OffsetSurface surface = *triangles_of(ground.shape);
    const auto rounding = add_solid_on_surface(
        *solid.faces, surface.surface, compose(ground.world_from_body, surface.body_from_surface),
        solid.is_a, margin, std::span(names.data(), names.size()),
        NearestOfBodies(a, b, solid, margin, warm_start), regions);
    if (!rounding)
        return rounding;
    name_regions(regions, &last);
    if (const auto* model = std::get_if<Model>(solid.is_a ? &a.shape : &b.shape))
        set_triangles(PlacedModel(*model, (solid.is_a ? a : b).world_from_body), solid.is_a,
                      regions);
    return rounding;
}

std::optional<double> add_curved_regions(const PlacedBody& a, const PlacedBody& b, double margin,
                                         PairWarmStart& warm_start,
                                         std::vector<ModelManifold>& regions) {
    const std::vector<ModelManifold>& last = warm_start.regions.manifolds;
    const bool solid_is_a = is_surface(b.shape);
    const PlacedBody &body = solid_is_a ? a : b, &ground = solid_is_a ? b : a;
    const OffsetSurface surface = *triangles_of(ground.shape);
    const auto names = names_of(last);
    const auto rounding = add_curved_on_surface(
        placed(std::get<CurvedShape>(body.shape), body.world_from_body), surface.surface,
        compose(ground.world_from_body, surface.body_from_surface), solid_is_a, margin,
        std::span(names.data(), names.size()), regions);
    if (rounding)
        name_regions(regions, &last);
    return rounding;
}

} // namespace abut
