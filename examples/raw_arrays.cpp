// Makes models from the arrays of another program, without reading a file.
//
//     abut-raw-arrays

#include <abut/make_mesh.h>
#include <abut/model.h>
#include <abut/rigid.h>

#include "program.h"

#include <cstdint>
#include <vector>

namespace {

int run(int, char**) {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint32_t> indices{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const abut::Model tetrahedron(abut::make_mesh(positions, indices));

    const abut::Pose world_from_a;
    const abut::Pose world_from_b{.translation = {3, 0, 0}};
    const abut::Gap gap = abut::distance(tetrahedron, world_from_a, tetrahedron, world_from_b);
    std::printf("distance %g m\n", gap.distance);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-raw-arrays", run, argc, argv);
}
