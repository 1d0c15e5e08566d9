#ifndef ABUT_C_H
#define ABUT_C_H

#include <stddef.h>
#include <stdint.h>

/* NOLINTBEGIN(readability-identifier-naming): names in C carry the prefix of the library. */

/**
 * The core queries for C, and for languages that call C. docs/c.md shows them in use.
 *
 * A function that can fail returns ABUT_OK or the kind of fault, and abut_error_message() then says
 * what happened. After a fault, results are not set. No function throws or ends the program.
 *
 * Handles (abut_model and others) are made by one function and released by abut_NAME_free, which
 * accepts NULL. They never change after they are made, except an abut_scene to which parts are
 * added; any number of threads may query a model.
 *
 * A transform that is NULL leaves the model where it is. Lengths are in the caller's units; files
 * are read in metres. Each function has the accuracy and cost of the C++ function that its comment
 * names.
 *
 * Every argument is checked: a pointer that is NULL where a comment does not allow it, a number
 * that is not finite or outside its domain, an unknown flag, an array that no memory can hold, and a
 * name that is taken give ABUT_BAD_ARGUMENT. (A mesh whose coordinates are not finite or whose
 * indices are out of range gives ABUT_BAD_MESH.)
 *
 * Structures and functions of one ABUT_C_VERSION keep their form. A later one may add functions.
 */
#define ABUT_C_VERSION 1

#ifdef __cplusplus
extern "C" {
#endif

typedef enum abut_status {
    ABUT_OK = 0,
    ABUT_BAD_ARGUMENT = 1, /**< a parameter outside its domain, or a pointer that is NULL */
    ABUT_FILE_NOT_FOUND = 2,
    ABUT_UNREADABLE = 3,
    ABUT_MALFORMED = 4,
    ABUT_UNSUPPORTED = 5,
    ABUT_BAD_MESH = 6,
    ABUT_READER_FAILED = 7,
    ABUT_CANNOT_WRITE = 8,
    ABUT_INTERRUPTED = 9, /**< an abut_progress asked to stop */
    ABUT_OUT_OF_MEMORY = 10,
    ABUT_INTERNAL = 11 /**< a fault of the library */
} abut_status;

/** Returns what the last function of this thread that failed reports: one line, which names the
 * file at fault. The text is valid until the next failure in this thread. Empty if none failed. */
const char* abut_error_message(void);

/** Returns ABUT_C_VERSION of the library that runs. */
int abut_c_version(void);

/** Returns the version of the library that runs, such as "0.2.0". */
const char* abut_version(void);

typedef struct abut_vec3 {
    double x, y, z;
} abut_vec3;

/** An affine map: the upper three rows of a matrix in column-major order, as abut::Transform. */
typedef struct abut_transform {
    double m[12];
} abut_transform;

/** A rigid pose. The quaternion (w, x, y, z) need not have unit length. */
typedef struct abut_pose {
    abut_vec3 translation;
    double rotation[4];
} abut_pose;

/** Converts a pose. */
abut_status abut_transform_of(const abut_pose* pose, abut_transform* transform);

/** Called with the name of a stage and the fraction of it that is done, from any thread, but never
 * from two at once. A result other than 0, also that of the last call, ends the work with
 * ABUT_INTERRUPTED. A job on a store that had finished by then stays in the store. */
typedef int (*abut_progress)(void* user, const char* stage, double fraction);

/* ------------------------------------------------------------------------------------ models -- */

/** Triangles with the hierarchy that queries need: abut::Model. */
typedef struct abut_model abut_model;

/** Makes a model from 3 * vertex_count coordinates and 3 * triangle_count indices, which are
 * copied. */
abut_status abut_model_from_arrays(const double* vertices, size_t vertex_count,
                                   const uint32_t* triangles, size_t triangle_count,
                                   abut_model** model);
/** As above, from coordinates in single precision. */
abut_status abut_model_from_floats(const float* vertices, size_t vertex_count,
                                   const uint32_t* triangles, size_t triangle_count,
                                   abut_model** model);
/** Makes one model of all parts of a file: abut::read_mesh. */
abut_status abut_model_from_file(const char* path, abut_model** model);
void abut_model_free(abut_model* model);
size_t abut_model_vertex_count(const abut_model* model);
size_t abut_model_triangle_count(const abut_model* model);

/* --------------------------------------------------------------------------------- two models -- */

/** Sets *meet to 1 if the surfaces share a point, else to 0: abut::collide. */
abut_status abut_collide(const abut_model* a, const abut_transform* world_from_a,
                         const abut_model* b, const abut_transform* world_from_b, int* meet);

typedef struct abut_triangle_pair {
    uint32_t a, b;
} abut_triangle_pair;

/** Finds all pairs of triangles that share a point, sorted. Writes the first `capacity` of them and
 * sets *count to the number of all. `pairs` may be NULL if `capacity` is 0. */
abut_status abut_contacts(const abut_model* a, const abut_transform* world_from_a,
                          const abut_model* b, const abut_transform* world_from_b,
                          abut_triangle_pair* pairs, size_t capacity, size_t* count);

/** Closest points: abut::Gap. */
typedef struct abut_gap {
    double
        distance; /**< 0 if the surfaces meet; negative if ABUT_SIGNED is set and they penetrate */
    double at_least; /**< a proven lower bound */
    abut_vec3 point_a, point_b;
    uint32_t triangle_a, triangle_b;
} abut_gap;

enum {
    ABUT_SIGNED = 1 /**< negative distances inside of solids */
};

/** Computes the distance of two models: abut::distance. `flags` is 0 or ABUT_SIGNED, here and
 * below. */
abut_status abut_distance(const abut_model* a, const abut_transform* world_from_a,
                          const abut_model* b, const abut_transform* world_from_b, int flags,
                          abut_gap* gap);

/** Sets *near to 1 if the models are at most `distance` apart, else to 0: abut::within. */
abut_status abut_within(const abut_model* a, const abut_transform* world_from_a,
                        const abut_model* b, const abut_transform* world_from_b, double distance,
                        int* near);

/** How deep two models penetrate each other: abut::Depth. */
typedef struct abut_depth {
    int meet;
    int interpenetrate;
    double depth, depth_at_most;
    abut_vec3 direction, point_a, point_b; /**< of the deepest region */
    abut_vec3 separation; /**< a translation of b after which the models are apart */
    size_t regions;
} abut_depth;

abut_status abut_penetration(const abut_model* a, const abut_transform* world_from_a,
                             const abut_model* b, const abut_transform* world_from_b,
                             abut_depth* depth);

/** A rigid motion over the time from 0 to 1: abut::Motion. */
typedef struct abut_motion {
    abut_pose start;
    abut_vec3 centre, velocity, angular_velocity;
} abut_motion;

/** The motion from one pose to another, with the body's point `about` on a straight line. */
abut_status abut_motion_between(const abut_pose* start, const abut_pose* end,
                                const abut_vec3* about, abut_motion* motion);
/** A body at rest. */
abut_status abut_motion_fixed(const abut_pose* pose, abut_motion* motion);

/** When two moving models meet: abut::Impact. */
typedef struct abut_impact {
    int meet;
    double time;         /**< never later than the first contact; 1 if they do not meet */
    double contact_time; /**< a time at which they are in contact; infinite if none was found */
    double gap;          /**< at most this far apart at `time` */
    abut_vec3 point_a, point_b, normal;
    uint32_t triangle_a, triangle_b;
} abut_impact;

/** Finds the first contact of two moving models: abut::time_of_impact. The gap at the time found is
 * at most `absolute_error`; a negative one stands for the default. */
abut_status abut_time_of_impact(const abut_model* a, const abut_motion* motion_a,
                                const abut_model* b, const abut_motion* motion_b,
                                double absolute_error, abut_impact* impact);

/* ---------------------------------------------------------------------------------- one model -- */

/** The nearest point of a surface: abut::Nearest. */
typedef struct abut_nearest_point {
    double distance; /**< negative inside of a closed model if ABUT_SIGNED is set */
    abut_vec3 point;
    uint32_t triangle;
} abut_nearest_point;

/** Finds the nearest point of the model to each of `count` points, on all cores. */
abut_status abut_nearest(const abut_model* model, const abut_transform* world_from_model,
                         const abut_vec3* points, size_t count, int flags,
                         abut_nearest_point* nearest);

typedef struct abut_ray {
    abut_vec3 origin, direction; /**< the direction need not have unit length */
    double t_min, t_max;         /**< may be infinite */
} abut_ray;

/** The point where a ray meets a triangle: abut::RayHit. */
typedef struct abut_ray_hit {
    int meet; /**< if 0, nothing else is set */
    double t;
    abut_vec3 point;
    uint32_t triangle;
} abut_ray_hit;

/** Finds the first triangle that each of `count` rays meets, on all cores. */
abut_status abut_first_hit(const abut_model* model, const abut_transform* world_from_model,
                           const abut_ray* rays, size_t count, abut_ray_hit* hits);

typedef enum abut_side { ABUT_OUTSIDE = 0, ABUT_INSIDE = 1, ABUT_ON_SURFACE = 2 } abut_side;

/** Finds the side of the model that each of `count` points is on: abut::contains. */
abut_status abut_contains(const abut_model* model, const abut_transform* world_from_model,
                          const abut_vec3* points, size_t count, abut_side* sides);

/* ------------------------------------------------------------------------------------ clashes -- */

/** The parts of a model file: abut::Scene. */
typedef struct abut_scene abut_scene;

/** Reads a model file. The path may be followed by a unit and an up axis: "pump.stl:mm". */
abut_status abut_scene_from_file(const char* path, abut_scene** scene);
/** Makes a scene without parts. `name` stands for a file's name in reports. */
abut_status abut_scene_new(const char* name, abut_scene** scene);
/** Adds a mesh, and sets *mesh to its number. */
abut_status abut_scene_add_mesh(abut_scene* scene, const double* vertices, size_t vertex_count,
                                const uint32_t* triangles, size_t triangle_count, uint32_t* mesh);
/** Adds a part: a mesh in its place. The name is also its id: ABUT_BAD_ARGUMENT if another part of
 * the scene has it. `type` may be NULL. */
abut_status abut_scene_add_part(abut_scene* scene, const char* name, const char* type,
                                uint32_t mesh, const abut_transform* world_from_part);
size_t abut_scene_part_count(const abut_scene* scene);
void abut_scene_free(abut_scene* scene);

/** A touch tolerance: what the files of each pair tell apart. */
#define ABUT_TOUCH_OF_FILES (-1.0)

typedef struct abut_clash_options {
    double clearance,
        touch_tolerance;    /**< metres, not negative; the latter or ABUT_TOUCH_OF_FILES */
    int self;               /**< not 0: also within each of several models */
    const char* rules;      /**< path of a file of rules; NULL: none */
    abut_progress progress; /**< NULL: none */
    void* user;             /**< handed to `progress` */
} abut_clash_options;

/** The result of a search for clashes, as text. */
typedef struct abut_report abut_report;

/** Finds all clashes between parts of different scenes; of one scene, between its parts:
 * abut::find_clashes. `options` may be NULL: no clearance, and ABUT_TOUCH_OF_FILES.
 * ABUT_BAD_ARGUMENT if two scenes have the same name. */
abut_status abut_find_clashes(const abut_scene* const* scenes, size_t count,
                              const abut_clash_options* options, abut_report** report);
/** The same of a store, in `memory` bytes; 0: 512 MiB. */
abut_status abut_find_clashes_in_store(const char* store, const abut_clash_options* options,
                                       uint64_t memory, abut_report** report);
/** Imports model files into a store: abut::import_models. */
abut_status abut_import(const char* const* paths, size_t count, const char* store);

/** The report as JSON; docs/clash.md has its keys. Valid as long as the report. */
const char* abut_report_json(const abut_report* report);
/** The number of clashes of all kinds. */
size_t abut_report_clash_count(const abut_report* report);
/** Writes the report: a path ending in .json, .csv or .html says in which form. */
abut_status abut_report_write(const abut_report* report, const char* path);
void abut_report_free(abut_report* report);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
