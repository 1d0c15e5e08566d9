// Drops bodies of three kinds into a container and writes frames (PLY) of the fall.
//
//     abut-drop [BODIES] [SECONDS] [FOLDER]      default: 1000 bodies, 5 seconds, no frames

#include <abut/frame.h>

#include "program.h"
#include "simulator/container.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

int run(int argc, char** argv) {
    const int bodies = argc > 1 ? std::atoi(argv[1]) : 1000;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 5;
    const std::string folder = argc > 3 ? argv[3] : "";

    simulation::Stage stage;
    simulation::fill_container(stage, bodies);
    constexpr int kStepsOfFrame = 2, kFramesOfSecond = 60;
    const int frames = static_cast<int>(seconds * kFramesOfSecond);
    const auto start = std::chrono::steady_clock::now();
    double writing = 0;
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    for (int frame = 0; frame < frames; ++frame) {
        for (int i = 0; i < kStepsOfFrame; ++i)
            stage.simulator.step(1.0 / (kStepsOfFrame * kFramesOfSecond));
        if (folder.empty())
            continue;
        const double begin = elapsed();
        char name[32];
        std::snprintf(name, sizeof name, "/frame-%05d.ply", frame);
        abut::write_frame(stage.surfaces.placed(stage.simulator), folder + name);
        writing += elapsed() - begin;
    }
    std::printf("%d bodies, %.1f s simulated in %.1f s (%d pairs of boxes at the end)\n", bodies,
                seconds, elapsed() - writing,
                static_cast<int>(stage.simulator.world().pairs().size()));
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-drop", run, argc, argv);
}
