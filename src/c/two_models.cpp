#include <abut/make_mesh.h>
#include <abut/motion.h>
#include <abut/penetration.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "c/guard.h"

#include <algorithm>

namespace abut {

namespace {

/// Two models in their places, as a query in C names them.
struct PairInC {
    const Model& a;
    Transform world_from_a;
    const Model& b;
    Transform world_from_b;

    PairInC(const abut_model* first, const abut_transform* world_from_first,
            const abut_model* second, const abut_transform* world_from_second)
        : a(needed(first, "a").model), world_from_a(from_c(world_from_first, "world_from_a")),
          b(needed(second, "b").model), world_from_b(from_c(world_from_second, "world_from_b")) {}
};

abut_motion motion_to_c(const Motion& motion) {
    return {.start = to_c(motion.start),
            .centre = to_c(motion.centre),
            .velocity = to_c(motion.velocity),
            .angular_velocity = to_c(motion.angular_velocity)};
}

/// Returns the motion. Throws Error{bad_argument} unless it is valid.
const Motion& valid(const Motion& motion) {
    static_cast<void>(at(motion, 1));
    return motion;
}

Motion motion_from_c(const abut_motion& motion) {
    return {.start = from_c(motion.start),
            .centre = from_c(motion.centre),
            .velocity = from_c(motion.velocity),
            .angular_velocity = from_c(motion.angular_velocity)};
}

abut_depth depth_to_c(const Depth& depth) {
    return {.meet = depth.meet,
            .interpenetrate = depth.interpenetrate,
            .depth = depth.depth,
            .depth_at_most = depth.depth_at_most,
            .direction = to_c(depth.direction),
            .point_a = to_c(depth.point_a),
            .point_b = to_c(depth.point_b),
            .separation = to_c(depth.separation),
            .regions = depth.regions.size()};
}

abut_impact impact_to_c(const Impact& impact) {
    return {.meet = impact.meet,
            .time = impact.time,
            .contact_time = impact.contact_time,
            .gap = impact.gap,
            .point_a = to_c(impact.point_a),
            .point_b = to_c(impact.point_b),
            .normal = to_c(impact.normal),
            .triangle_a = impact.triangle_a,
            .triangle_b = impact.triangle_b};
}

template <class Number>
abut_status model_from_numbers(const Number* vertices, std::size_t vertex_count,
                               const std::uint32_t* triangles, std::size_t triangle_count,
                               abut_model** model) {
    return guarded([&] {
        abut_model*& result = needed(model, "model");
        result =
            new abut_model{Model(make_mesh(needed(vertices, vertex_count, "vertices", 3),
                                           needed(triangles, triangle_count, "triangles", 3)))};
    });
}

} // namespace

} // namespace abut

using namespace abut; // NOLINT(google-build-using-namespace): the functions of C are global

extern "C" {

abut_status abut_model_from_arrays(const double* vertices, size_t vertex_count,
                                   const uint32_t* triangles, size_t triangle_count,
                                   abut_model** model) {
    return model_from_numbers(vertices, vertex_count, triangles, triangle_count, model);
}

abut_status abut_model_from_floats(const float* vertices, size_t vertex_count,
                                   const uint32_t* triangles, size_t triangle_count,
                                   abut_model** model) {
    return model_from_numbers(vertices, vertex_count, triangles, triangle_count, model);
}

abut_status abut_model_from_file(const char* path, abut_model** model) {
    return guarded([&] {
        abut_model*& result = needed(model, "model");
        result = new abut_model{Model(read_mesh(&needed(path, "path")))};
    });
}

void abut_model_free(abut_model* model) {
    delete model;
}

size_t abut_model_vertex_count(const abut_model* model) {
    return model == nullptr ? 0 : model->model.mesh().positions.size();
}

size_t abut_model_triangle_count(const abut_model* model) {
    return model == nullptr ? 0 : model->model.mesh().triangles.size();
}

abut_status abut_collide(const abut_model* a, const abut_transform* world_from_a,
                         const abut_model* b, const abut_transform* world_from_b, int* meet) {
    return guarded([&] {
        int& result = needed(meet, "meet");
        const PairInC pair(a, world_from_a, b, world_from_b);
        result = collide(pair.a, pair.world_from_a, pair.b, pair.world_from_b).meet();
    });
}

abut_status abut_contacts(const abut_model* a, const abut_transform* world_from_a,
                          const abut_model* b, const abut_transform* world_from_b,
                          abut_triangle_pair* pairs, size_t capacity, size_t* count) {
    return guarded([&] {
        std::size_t& found = needed(count, "count");
        const std::span<abut_triangle_pair> results = needed(pairs, capacity, "pairs");
        const PairInC pair(a, world_from_a, b, world_from_b);
        const Contacts contacts = collide(pair.a, pair.world_from_a, pair.b, pair.world_from_b,
                                          {.mode = ContactMode::all});
        found = contacts.pairs.size();
        for (std::size_t i = 0; i < std::min(found, results.size()); ++i)
            results[i] = {contacts.pairs[i].a, contacts.pairs[i].b};
    });
}

abut_status abut_distance(const abut_model* a, const abut_transform* world_from_a,
                          const abut_model* b, const abut_transform* world_from_b, int flags,
                          abut_gap* gap) {
    return guarded([&] {
        abut_gap& result = needed(gap, "gap");
        const PairInC pair(a, world_from_a, b, world_from_b);
        const Gap found = distance(pair.a, pair.world_from_a, pair.b, pair.world_from_b,
                                   {.signed_distance = is_signed(flags)});
        result = {.distance = found.distance,
                  .at_least = found.at_least,
                  .point_a = to_c(found.point_a),
                  .point_b = to_c(found.point_b),
                  .triangle_a = found.triangle_a,
                  .triangle_b = found.triangle_b};
    });
}

abut_status abut_within(const abut_model* a, const abut_transform* world_from_a,
                        const abut_model* b, const abut_transform* world_from_b, double distance,
                        int* near) {
    return guarded([&] {
        int& result = needed(near, "near");
        const PairInC pair(a, world_from_a, b, world_from_b);
        result = within(pair.a, pair.world_from_a, pair.b, pair.world_from_b, distance);
    });
}

abut_status abut_penetration(const abut_model* a, const abut_transform* world_from_a,
                             const abut_model* b, const abut_transform* world_from_b,
                             abut_depth* depth) {
    return guarded([&] {
        abut_depth& result = needed(depth, "depth");
        const PairInC pair(a, world_from_a, b, world_from_b);
        result = depth_to_c(penetration(pair.a, pair.world_from_a, pair.b, pair.world_from_b));
    });
}

abut_status abut_motion_between(const abut_pose* start, const abut_pose* end,
                                const abut_vec3* about, abut_motion* motion) {
    return guarded([&] {
        abut_motion& result = needed(motion, "motion");
        const Vec3 point = about == nullptr ? Vec3{} : from_c(*about);
        result = motion_to_c(valid(
            Motion::between(from_c(needed(start, "start")), from_c(needed(end, "end")), point)));
    });
}

abut_status abut_motion_fixed(const abut_pose* pose, abut_motion* motion) {
    return guarded([&] {
        abut_motion& result = needed(motion, "motion");
        result = motion_to_c(valid(Motion::fixed(from_c(needed(pose, "pose")))));
    });
}

abut_status abut_time_of_impact(const abut_model* a, const abut_motion* motion_a,
                                const abut_model* b, const abut_motion* motion_b,
                                double absolute_error, abut_impact* impact) {
    return guarded([&] {
        abut_impact& result = needed(impact, "impact");
        ImpactOptions options;
        if (!(absolute_error < 0))
            options.absolute_error = absolute_error;
        result = impact_to_c(time_of_impact(
            needed(a, "a").model, motion_from_c(needed(motion_a, "motion_a")), needed(b, "b").model,
            motion_from_c(needed(motion_b, "motion_b")), options));
    });
}

} // extern "C"
