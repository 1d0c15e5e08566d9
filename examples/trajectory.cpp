// Checks a path of a tool: how near each pose comes to an obstacle, and whether the motions between
// the poses are free.
//
//     abut-trajectory TOOL OBSTACLE

#include <abut/batch.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/scene.h>

#include "program.h"

#include <vector>

namespace {

int run(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: abut-trajectory TOOL OBSTACLE\n", stderr);
        return 2;
    }
    const abut::Model tool(abut::read_mesh(argv[1]));
    const abut::Model obstacle(abut::read_mesh(argv[2]));
    const std::vector<abut::Pose> path{{.translation = {-3, 0, 0}},
                                       {.translation = {-3, 0, 2}},
                                       {.translation = {3, 0, 2}},
                                       {.translation = {3, 0, 0}}};

    // How near is each pose? All of them in parallel.
    std::vector<abut::Placement> placements;
    placements.reserve(path.size());
    for (const abut::Pose& pose : path)
        placements.push_back({.world_from_a = pose, .world_from_b = {}});
    for (const abut::Gap& gap : abut::distance(tool, obstacle, placements))
        std::printf("%.3f m\n", gap.distance);

    // Are the motions between them free? No contact is missed between two poses.
    const abut::Motion rest = abut::Motion::fixed({});
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const abut::Motion motion = abut::Motion::screw(path[i], path[i + 1]);
        const abut::Impact impact = abut::time_of_impact(tool, motion, obstacle, rest);
        std::printf("motion %zu: free for %.1f %%\n", i, 100 * impact.time);
    }
    const abut::Motion direct = abut::Motion::screw(path.front(), path.back());
    const abut::Impact blocked = abut::time_of_impact(tool, direct, obstacle, rest);
    std::printf("the direct way: free for %.1f %%\n", 100 * blocked.time);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-trajectory", run, argc, argv);
}
