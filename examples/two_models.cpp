// Finds contact, distance and depth of two models.
//
//     abut-two-models A B

#include <abut/model.h>
#include <abut/penetration.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "program.h"

namespace {

int run(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: abut-two-models A B\n", stderr);
        return 2;
    }
    const abut::Model a(abut::read_mesh(argv[1]));
    const abut::Model b(abut::read_mesh(argv[2]));
    const abut::Pose world_from_a;
    const abut::Pose world_from_b{.translation = {0.9, 0.2, 0.3}};

    if (abut::collide(a, world_from_a, b, world_from_b).meet())
        std::puts("contact");
    if (abut::within(a, world_from_a, b, world_from_b, 0.005))
        std::puts("at most 5 mm apart");
    const abut::Gap gap = abut::distance(a, world_from_a, b, world_from_b);
    std::printf("distance %g m, triangles %u and %u\n", gap.distance, gap.triangle_a,
                gap.triangle_b);
    const abut::Depth depth = abut::penetration(a, world_from_a, b, world_from_b);
    std::printf("depth %.3f m, apart when B moves by (%.3f, %.3f, %.3f) m\n", depth.depth,
                depth.separation.x, depth.separation.y, depth.separation.z);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-two-models", run, argc, argv);
}
