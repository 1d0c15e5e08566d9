#include <abut/shape_queries.h>

#include "c/guard.h"

extern "C" {

abut_status abut_nearest(const abut_model* model, const abut_transform* world_from_model,
                         const abut_vec3* points, size_t count, int flags,
                         abut_nearest_point* nearest) {
    return abut::guarded([&] {
        const auto results = abut::needed(nearest, count, "nearest");
        const std::vector<abut::Nearest> found = abut::nearest(
            abut::needed(model, "model").model, abut::from_c(world_from_model, "world_from_model"),
            abut::from_c(points, count), {.signed_distance = abut::is_signed(flags)});
        for (std::size_t i = 0; i < count; ++i)
            results[i] = {found[i].distance, abut::to_c(found[i].point), found[i].triangle};
    });
}

abut_status abut_first_hit(const abut_model* model, const abut_transform* world_from_model,
                           const abut_ray* rays, size_t count, abut_ray_hit* hits) {
    return abut::guarded([&] {
        const auto results = abut::needed(hits, count, "hits");
        const auto given = abut::needed(rays, count, "rays");
        std::vector<abut::Ray> asked;
        asked.reserve(count);
        for (const abut_ray& ray : given)
            asked.push_back(
                {abut::from_c(ray.origin), abut::from_c(ray.direction), ray.t_min, ray.t_max});
        const std::vector<abut::RayHit> found =
            abut::first_hit(abut::needed(model, "model").model,
                            abut::from_c(world_from_model, "world_from_model"), asked);
        for (std::size_t i = 0; i < count; ++i)
            results[i] = {found[i].meet, found[i].t, abut::to_c(found[i].point), found[i].triangle};
    });
}

abut_status abut_contains(const abut_model* model, const abut_transform* world_from_model,
                          const abut_vec3* points, size_t count, abut_side* sides) {
    return abut::guarded([&] {
        const auto results = abut::needed(sides, count, "sides");
        const std::vector<abut::Containment> found = abut::contains(
            abut::needed(model, "model").model, abut::from_c(world_from_model, "world_from_model"),
            abut::from_c(points, count));
        for (std::size_t i = 0; i < count; ++i)
            results[i] = found[i].side == abut::Side::outside  ? ABUT_OUTSIDE
                         : found[i].side == abut::Side::inside ? ABUT_INSIDE
                                                               : ABUT_ON_SURFACE;
    });
}

} // extern "C"
