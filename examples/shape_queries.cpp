// Queries one model with simple shapes: a point, a ray, a ball.
//
//     abut-shape-queries MODEL

#include <abut/model.h>
#include <abut/scene.h>
#include <abut/shape_queries.h>

#include "program.h"

namespace {

int run(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: abut-shape-queries MODEL\n", stderr);
        return 2;
    }
    const abut::Model model(abut::read_mesh(argv[1]));
    const abut::Transform world_from_model; // identity
    const abut::Vec3 point{0.5, 0.5, 3};

    const abut::Nearest nearest = abut::nearest(model, world_from_model, point);
    std::printf("nearest %g m, on triangle %u\n", nearest.distance, nearest.triangle);

    const abut::Ray down{.origin = point, .direction = {0, 0, -1}};
    if (const abut::RayHit hit = abut::first_hit(model, world_from_model, down); hit.meet)
        std::printf("below at z = %g m\n", hit.point.z);

    const abut::Sphere ball{.centre = point, .radius = 2.5};
    std::printf("%zu triangles meet the ball\n",
                abut::overlapping_triangles(model, world_from_model, ball).size());

    const bool inside = abut::contains(model, world_from_model, point).side == abut::Side::inside;
    std::puts(inside ? "inside" : "not inside");
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-shape-queries", run, argc, argv);
}
