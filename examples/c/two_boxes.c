/* Two boxes: contact, distance, depth, time of impact, a ray, and the clashes of a scene. */
#include <abut/c.h>

#include <stdio.h>
#include <stdlib.h>

/* Ends the program if a function failed. */
static void check(abut_status status) {
    if (status != ABUT_OK) {
        fprintf(stderr, "error %d: %s\n", (int)status, abut_error_message());
        exit(1);
    }
}

/* The box from (0, 0, 0) to (1, 1, 1). */
static const double vertices[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                  0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const uint32_t triangles[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                     1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/* A transform that moves along x. */
static abut_transform along_x(double x) {
    const abut_pose pose = {{x, 0, 0}, {1, 0, 0, 0}};
    abut_transform transform;
    check(abut_transform_of(&pose, &transform));
    return transform;
}

static void show_queries(const abut_model* box) {
    const abut_transform apart = along_x(3), across = along_x(0.75);
    abut_gap gap;
    check(abut_distance(box, NULL, box, &apart, 0, &gap));
    printf("distance %g, from (%g, ...) to (%g, ...)\n", gap.distance, gap.point_a.x,
           gap.point_b.x);

    int meet = 0;
    check(abut_collide(box, NULL, box, &across, &meet));
    abut_depth depth;
    check(abut_penetration(box, NULL, box, &across, &depth));
    printf("contact %d, depth %g\n", meet, depth.depth);

    abut_motion still, moving;
    const abut_pose start = {{3, 0, 0}, {1, 0, 0, 0}}, end = {{-1, 0, 0}, {1, 0, 0, 0}};
    const abut_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};
    check(abut_motion_fixed(&origin, &still));
    check(abut_motion_between(&start, &end, NULL, &moving));
    abut_impact impact;
    check(abut_time_of_impact(box, &still, box, &moving, -1, &impact));
    printf("they meet %d, at time %.3f\n", impact.meet, impact.time);

    const abut_ray ray = {{-1, 0.5, 0.25}, {1, 0, 0}, 0, 10};
    abut_ray_hit hit;
    check(abut_first_hit(box, NULL, &ray, 1, &hit));
    printf("the ray meets triangle %u at t = %g\n", (unsigned)hit.triangle, hit.t);
}

static void show_clashes(void) {
    abut_scene* scene = NULL;
    uint32_t mesh = 0;
    const abut_transform across = along_x(0.75);
    check(abut_scene_new("boxes", &scene));
    check(abut_scene_add_mesh(scene, vertices, 8, triangles, 12, &mesh));
    check(abut_scene_add_part(scene, "tank", "IfcTank", mesh, NULL));
    check(abut_scene_add_part(scene, "pipe", "IfcPipeSegment", mesh, &across));
    abut_report* report = NULL;
    check(abut_find_clashes((const abut_scene* const*)&scene, 1, NULL, &report));
    printf("%zu clash of %zu parts\n", abut_report_clash_count(report),
           abut_scene_part_count(scene));
    abut_report_free(report);
    abut_scene_free(scene);
}

int main(void) {
    abut_model* box = NULL;
    check(abut_model_from_arrays(vertices, 8, triangles, 12, &box));
    show_queries(box);
    show_clashes();
    abut_model* missing = NULL;
    const abut_status status = abut_model_from_file("missing.stl", &missing);
    printf("status %d: %s\n", (int)status, abut_error_message());
    abut_model_free(box);
    return 0;
}
