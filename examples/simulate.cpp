// Runs a scene of the simulator, and prints its figures once a second.
//
//     abut-simulate SCENE [SECONDS] [--frames FOLDER] [--figures FILE.csv] [--mesh FILE]
//
// --frames writes 30 files a second (GLB), which `abut picture` draws. --figures writes the figures
// of every step. --mesh is the bunny of the scene "meshes".

#include <abut/scene.h>

#include "program.h"
#include "simulator/scenes.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

constexpr int kStepsOfSecond = 60, kStepsOfFrame = 2;

struct Arguments {
    std::string scene, frames, figures, mesh;
    double seconds = 0; ///< 0: as the scene says
};

double parse_seconds(const std::string& text) {
    char* end = nullptr;
    const double seconds = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !(seconds > 0 && seconds < 1e6))
        throw std::runtime_error("'" + text + "' is no time in seconds");
    return seconds;
}

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string text = argv[i];
        const auto value = [&]() -> std::string {
            if (i + 1 == argc)
                throw std::runtime_error(text + " needs a value");
            return argv[++i];
        };
        if (text == "--frames")
            arguments.frames = value();
        else if (text == "--figures")
            arguments.figures = value();
        else if (text == "--mesh")
            arguments.mesh = value();
        else if (text.starts_with("--"))
            throw std::runtime_error("unknown option " + text);
        else if (arguments.scene.empty())
            arguments.scene = text;
        else
            arguments.seconds = parse_seconds(text);
    }
    return arguments;
}

/// The figures of one step.
struct Figures {
    double time = 0; ///< simulated, in seconds
    std::size_t awake = 0, points = 0;
    double energy = 0, depth = 0, milliseconds = 0;
};

Figures timed_step(simulation::Stage& stage, double time) {
    using Clock = std::chrono::steady_clock;
    if (stage.act)
        stage.act(stage.simulator, time);
    const auto start = Clock::now();
    stage.simulator.step(1.0 / kStepsOfSecond);
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
    const simulation::Simulator& simulator = stage.simulator;
    return {time + 1.0 / kStepsOfSecond,
            simulator.awake(),
            simulator.contacts().touching_points(),
            simulator.energy(),
            simulator.contacts().deepest(),
            elapsed.count()};
}

void print_usage() {
    std::printf("abut-simulate SCENE [SECONDS] [--frames FOLDER] [--figures FILE.csv] "
                "[--mesh FILE]\nscenes:");
    for (const std::string& name : simulation::stage_names())
        std::printf(" %s", name.c_str());
    std::printf("\n");
}

int run(int argc, char** argv) {
    const Arguments arguments = parse(argc, argv);
    if (arguments.scene.empty()) {
        print_usage();
        return 1;
    }
    simulation::Stage stage = simulation::make_stage(arguments.scene, {}, arguments.mesh);
    const double seconds = arguments.seconds > 0 ? arguments.seconds : stage.seconds;
    std::ofstream table;
    if (!arguments.figures.empty()) {
        table.open(arguments.figures);
        if (!table)
            throw std::runtime_error(arguments.figures + " cannot be written");
        table << "seconds,awake,points,energy_J,depth_m,step_ms\n";
    }
    std::printf("%8s %6s %8s %14s %12s %10s\n", "seconds", "awake", "points", "energy, J",
                "depth, mm", "ms/step");
    if (!arguments.frames.empty())
        std::filesystem::create_directories(arguments.frames);
    double spent = 0;
    const int steps = static_cast<int>(seconds * kStepsOfSecond);
    for (int step = 0; step < steps; ++step) {
        const Figures f = timed_step(stage, static_cast<double>(step) / kStepsOfSecond);
        spent += f.milliseconds;
        if (table.is_open())
            table << f.time << ',' << f.awake << ',' << f.points << ',' << f.energy << ','
                  << f.depth << ',' << f.milliseconds << '\n';
        if ((step + 1) % kStepsOfSecond == 0) {
            std::printf("%8.2f %6zu %8zu %14.3f %12.4f %10.3f\n", f.time, f.awake, f.points,
                        f.energy, 1e3 * f.depth, spent / kStepsOfSecond);
            spent = 0;
        }
        if (!arguments.frames.empty() && step % kStepsOfFrame == 0) {
            char name[32];
            std::snprintf(name, sizeof name, "/frame-%05d.glb", step / kStepsOfFrame);
            abut::write_glb(stage.surfaces.scene(stage.simulator), arguments.frames + name);
        }
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-simulate", run, argc, argv);
}
